#include "problem/effect/trace.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "hbvm/error.hpp"

namespace hbvm::core {

template <Scalar S>
typename Trace<S>::Id Trace<S>::leaf(Kind kind, std::size_t index) {
  const auto key = std::tuple(static_cast<int>(kind), 0, index, Id{0});
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  const bool varies = kind == Kind::input;
  nodes_.push_back({kind, Op::add, index, 0, S(0), varies ? 1 : 0, varies});
  return known_[key] = nodes_.size() - 1;
}

template <Scalar S>
typename Trace<S>::Id Trace<S>::constant(const S& value) {
  for (const Id i : constants_)
    if (nodes_[i].value == value) return i;
  nodes_.push_back({Kind::constant, Op::add, 0, 0, value, 0, false});
  constants_.push_back(nodes_.size() - 1);
  return nodes_.size() - 1;
}

template <Scalar S>
typename Trace<S>::Id Trace<S>::operation(Op op, Id a, Id b, int degree) {
  const auto key = std::tuple(static_cast<int>(Kind::operation), static_cast<int>(op), a, b);
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  const bool varies = nodes_[a].varies || (is_binary(op) && nodes_[b].varies);
  nodes_.push_back({Kind::operation, op, a, b, S(0), degree, varies});
  return known_[key] = nodes_.size() - 1;
}

template <Scalar S>
typename Trace<S>::Id Trace<S>::add(Id a, Id b) {
  if (is_constant(a, 0)) return b;
  if (is_constant(b, 0)) return a;
  if (is_constant(a) && is_constant(b)) return constant(nodes_[a].value + nodes_[b].value);
  if (has_coefficient(b) && is_constant(nodes_[b].a, -1)) return subtract(a, nodes_[b].b);
  if (has_coefficient(a) && is_constant(nodes_[a].a, -1)) return subtract(b, nodes_[a].b);
  const int degree =
      nodes_[a].degree < 0 || nodes_[b].degree < 0 ? not_polynomial : std::max(nodes_[a].degree, nodes_[b].degree);
  return operation(Op::add, std::min(a, b), std::max(a, b), degree);
}

template <Scalar S>
typename Trace<S>::Id Trace<S>::subtract(Id a, Id b) {
  if (a == b) return constant(S(0));
  if (is_constant(b)) return add(a, constant(S(-nodes_[b].value)));
  if (is_constant(a, 0)) return multiply(constant(S(-1)), b);
  if (has_coefficient(b) && is_constant(nodes_[b].a, -1)) return add(a, nodes_[b].b);
  const int degree =
      nodes_[a].degree < 0 || nodes_[b].degree < 0 ? not_polynomial : std::max(nodes_[a].degree, nodes_[b].degree);
  return operation(Op::subtract, a, b, degree);
}

template <Scalar S>
typename Trace<S>::Id Trace<S>::multiply(Id a, Id b) {
  if (is_constant(a, 0) || is_constant(b, 0)) return constant(S(0));
  if (is_constant(a, 1)) return b;
  if (is_constant(b, 1)) return a;
  if (is_constant(a) && is_constant(b)) return constant(nodes_[a].value * nodes_[b].value);
  if (nodes_[a].varies && !nodes_[b].varies) std::swap(a, b);
  if (!nodes_[a].varies) {
    // c (d x) = (c d) x, and -1 (x - y) = y - x
    if (has_coefficient(b)) return multiply(multiply(a, nodes_[b].a), nodes_[b].b);
    if (is_constant(a, -1) && is(Op::subtract, b)) return subtract(nodes_[b].b, nodes_[b].a);
  } else {
    // (c x) y = c (x y), so that coefficients meet. It is left as it is where y is affine in the inputs. Those are the
    // last products of a gradient, one for each component of a displacement, which share the factor c x.
    if (has_coefficient(a) && (nodes_[b].degree > 1 || nodes_[b].degree < 0))
      return multiply(nodes_[a].a, multiply(nodes_[a].b, b));
    if (has_coefficient(b) && (nodes_[a].degree > 1 || nodes_[a].degree < 0))
      return multiply(nodes_[b].a, multiply(a, nodes_[b].b));
  }
  constexpr int most_degree = 1'000'000;  // sums of two of them do not overflow
  const int sum = nodes_[a].degree < 0 || nodes_[b].degree < 0 ? not_polynomial : nodes_[a].degree + nodes_[b].degree;
  const int degree = sum > most_degree ? not_polynomial : sum;
  // A coefficient stands on the left; otherwise the order does not matter and is fixed, to find equal products.
  const bool ordered = !nodes_[a].varies || a <= b;
  return operation(Op::multiply, ordered ? a : b, ordered ? b : a, degree);
}

template <Scalar S>
typename Trace<S>::Id Trace<S>::apply(Op function, Id a) {
  if (is_constant(a)) {
    Matrix<S> result(1, 1);
    Program<S>({nodes_[a].value}, {{function, {Bank::constant, 0}, {}, 0}}, {}, 1).run(result, {});
    return constant(result(0, 0));
  }
  return operation(function, a, 0, nodes_[a].varies ? not_polynomial : 0);
}

template <Scalar S>
std::vector<typename Trace<S>::Id> Trace<S>::gradient(Id output, std::size_t inputs) {
  const Id zero = constant(S(0));
  std::vector<Id> adjoint(output + 1, zero);
  adjoint[output] = constant(S(1));
  // What operation i passes on to its operands of its adjoint y.
  const auto differentiate = [&](Id i, Id y) {
    const Node node = nodes_[i];
    const auto pass = [&](Id operand, Id contribution) {
      if (nodes_[operand].varies) adjoint[operand] = add(adjoint[operand], contribution);
    };
    switch (node.op) {
      case Op::add:
        pass(node.a, y);
        return pass(node.b, y);
      case Op::subtract:
        pass(node.a, y);
        return pass(node.b, multiply(constant(S(-1)), y));
      case Op::multiply:
        if (node.a == node.b) return pass(node.a, multiply(multiply(constant(S(2)), y), node.a));
        pass(node.a, multiply(y, node.b));
        return pass(node.b, multiply(y, node.a));
      case Op::negate:
        return pass(node.a, multiply(constant(S(-1)), y));
      case Op::abs:
        return pass(node.a, multiply(y, apply(Op::sign, node.a)));
      case Op::sign:
        return;               // constant but at 0
      case Op::reciprocal: {  // d(1/x) = -(1/x)^2 dx
        const Id square = multiply(i, i);
        return pass(node.a, multiply(multiply(constant(S(-1)), y), square));
      }
      case Op::sqrt: {  // d sqrt(x) = dx / (2 sqrt(x))
        const Id over = apply(Op::reciprocal, i);
        return pass(node.a, multiply(multiply(constant(S(S(1) / 2)), y), over));
      }
      case Op::sin:
        return pass(node.a, multiply(y, apply(Op::cos, node.a)));
      case Op::cos: {
        const Id sine = apply(Op::sin, node.a);
        return pass(node.a, multiply(multiply(constant(S(-1)), y), sine));
      }
      case Op::exp:
        return pass(node.a, multiply(y, i));
      case Op::log:
        return pass(node.a, multiply(y, apply(Op::reciprocal, node.a)));
      case Op::sinh:
        return pass(node.a, multiply(y, apply(Op::cosh, node.a)));
      case Op::cosh:
        return pass(node.a, multiply(y, apply(Op::sinh, node.a)));
      case Op::tanh: {  // d tanh(x) = dx / cosh(x)^2: 1 - tanh(x)^2 cancels
        const Id sech = apply(Op::reciprocal, apply(Op::cosh, node.a));
        return pass(node.a, multiply(y, multiply(sech, sech)));
      }
      case Op::atan: {  // d atan(x) = dx / (1 + x^2)
        const Id square = multiply(node.a, node.a);
        return pass(node.a, multiply(y, apply(Op::reciprocal, add(constant(S(1)), square))));
      }
      case Op::sinc:
      case Op::sinhc:
      case Op::atanhc:
      case Op::atanc:
        throw Error(std::string("the derivative of ") + name_of(node.op) + " is not known");
    }
  };
  // Nodes are numbered in the order of their computation; new ones, made on the way, come after `output`.
  for (Id i = output + 1; i-- > 0;)
    if (nodes_[i].kind == Kind::operation && nodes_[i].varies && adjoint[i] != zero) differentiate(i, adjoint[i]);
  std::vector<Id> result;
  for (std::size_t i = 0; i < inputs; ++i) {
    const Id leaf_id = input(i);
    result.push_back(leaf_id <= output ? adjoint[leaf_id] : zero);
  }
  return result;
}

/// Turns nodes into two programs: the coefficients, once, from the parameters; and the outputs, at every point, from
/// the inputs and the coefficients.
template <Scalar S>
class Trace<S>::Compiler {
 public:
  Compiler(const Trace& trace, const std::vector<Id>& outputs)
      : nodes_(trace.nodes_),
        trace_(trace),
        needed_(nodes_.size(), false),
        coefficient_(nodes_.size(), false),
        place_(nodes_.size()) {
    find_needed(outputs);
    find_order();
  }

  Compiled compile(const std::vector<Id>& outputs, std::size_t inputs, std::size_t parameters) {
    Compiled result;
    std::vector<Id> exits;
    for (Id i = 0; i < nodes_.size(); ++i)
      if (coefficient_[i]) exits.push_back(i);
    place_leaves(Kind::parameter, parameters);
    result.coefficients = emit(inside_coefficients(), false, exits);

    std::fill(place_.begin(), place_.end(), std::nullopt);
    place_leaves(Kind::input, inputs);
    for (std::size_t i = 0; i < exits.size(); ++i)
      place_[exits[i]] = Operand{Bank::input, static_cast<std::uint32_t>(inputs + i)};
    result.program = emit(needed_, true, outputs);
    return result;
  }

 private:
  bool is_operation(Id x) const { return nodes_[x].kind == Kind::operation; }
  template <class F>
  void for_each_operand(Id x, F f) const {
    f(nodes_[x].a);
    if (is_binary(nodes_[x].op)) f(nodes_[x].b);
  }

  /// What the outputs need, and of that what does not vary where a varying operation uses it: the coefficients.
  void find_needed(const std::vector<Id>& outputs) {
    const auto need = [&](Id x) {
      needed_[x] = true;
      if (!nodes_[x].varies && !trace_.is_constant(x)) coefficient_[x] = true;
    };
    for (const Id x : outputs) need(x);
    for (Id i = nodes_.size(); i-- > 0;)
      if (needed_[i] && is_operation(i) && nodes_[i].varies) for_each_operand(i, need);
  }

  /// What the coefficients need.
  std::vector<bool> inside_coefficients() const {
    std::vector<bool> inside = coefficient_;
    for (Id i = nodes_.size(); i-- > 0;)
      if (inside[i] && is_operation(i)) for_each_operand(i, [&](Id x) { inside[x] = true; });
    return inside;
  }

  /// The order of the code. What does not wait for a transcendental function comes before it, so that in double a
  /// division, say, overlaps the call.
  void find_order() {
    std::vector<int> calls(nodes_.size(), 0);
    for (Id i = 0; i < nodes_.size(); ++i) {
      if (!is_operation(i)) continue;
      for_each_operand(i, [&](Id x) { calls[i] = std::max(calls[i], calls[x]); });
      if (nodes_[i].op > Op::sqrt) ++calls[i];
    }
    order_.resize(nodes_.size());
    std::iota(order_.begin(), order_.end(), Id{0});
    std::stable_sort(order_.begin(), order_.end(), [&](Id x, Id y) { return calls[x] < calls[y]; });
  }

  void place_leaves(Kind kind, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto found = trace_.known_.find(std::tuple(static_cast<int>(kind), 0, i, Id{0}));
      if (found != trace_.known_.end()) place_[found->second] = Operand{Bank::input, static_cast<std::uint32_t>(i)};
    }
  }

  /// The program of the wanted operations that vary, or of those that do not.
  Program<S> emit(const std::vector<bool>& wanted, bool varying, const std::vector<Id>& exits) {
    std::vector<Id> operations;
    for (const Id i : order_)
      if (wanted[i] && is_operation(i) && nodes_[i].varies == varying) operations.push_back(i);
    std::vector<S> constants;
    const auto operand = [&](Id x) {
      if (trace_.is_constant(x) && !place_[x]) {
        constants.push_back(nodes_[x].value);
        place_[x] = Operand{Bank::constant, static_cast<std::uint32_t>(constants.size() - 1)};
      }
      return *place_[x];
    };
    std::vector<Instruction> code;
    for (const Id i : operations) {
      const Node& node = nodes_[i];
      const bool negation = node.op == Op::multiply && trace_.is_constant(node.a, -1);
      const Operand a = operand(negation ? node.b : node.a);
      const Operand b = is_binary(node.op) && !negation ? operand(node.b) : Operand{};
      const auto next = static_cast<std::uint32_t>(code.size());
      place_[i] = Operand{Bank::temporary, next};
      code.push_back({negation ? Op::negate : node.op, a, b, next});
    }
    std::vector<Operand> ends;
    for (const Id x : exits) ends.push_back(operand(x));
    const std::uint32_t registers = reuse_registers(code, ends);
    return {std::move(constants), std::move(code), std::move(ends), registers};
  }

  const std::vector<Node>& nodes_;
  const Trace& trace_;
  std::vector<bool> needed_, coefficient_;
  std::vector<Id> order_;
  std::vector<std::optional<Operand>> place_;
};

template <Scalar S>
typename Trace<S>::Compiled Trace<S>::compile(const std::vector<Id>& outputs, std::size_t inputs,
                                              std::size_t parameters) const {
  return Compiler(*this, outputs).compile(outputs, inputs, parameters);
}

#define HBVM_DEFINE(S) template class Trace<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
