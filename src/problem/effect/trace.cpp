#include "hbvm/problem/effect/trace.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace hbvm {

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
  for (Id i = 0; i < nodes_.size(); ++i)
    if (is_constant(i) && nodes_[i].value == value) return i;
  nodes_.push_back({Kind::constant, Op::add, 0, 0, value, 0, false});
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
    // (c x) y = c (x y), so that coefficients meet; but not where y is affine in the inputs: those are the last
    // products of a gradient, one for each component of a displacement, which share the factor c x.
    if (has_coefficient(a) && (nodes_[b].degree > 1 || nodes_[b].degree < 0))
      return multiply(nodes_[a].a, multiply(nodes_[a].b, b));
    if (has_coefficient(b) && (nodes_[a].degree > 1 || nodes_[a].degree < 0))
      return multiply(nodes_[b].a, multiply(a, nodes_[b].b));
  }
  const int degree =
      nodes_[a].degree < 0 || nodes_[b].degree < 0 ? not_polynomial : nodes_[a].degree + nodes_[b].degree;
  // A coefficient stands on the left; otherwise the order does not matter and is fixed, to find equal products.
  const bool ordered = !nodes_[a].varies || a <= b;
  return operation(Op::multiply, ordered ? a : b, ordered ? b : a, degree);
}

template <Scalar S>
typename Trace<S>::Id Trace<S>::apply(Op function, Id a) {
  using std::cos, std::exp, std::log, std::sin, std::sqrt;
  if (is_constant(a)) {
    const S x = nodes_[a].value;
    switch (function) {
      case Op::abs:
        return constant(magnitude(x));
      case Op::reciprocal:
        return constant(S(1 / x));
      case Op::sqrt:
        return constant(S(sqrt(x)));
      case Op::sin:
        return constant(S(sin(x)));
      case Op::cos:
        return constant(S(cos(x)));
      case Op::exp:
        return constant(S(exp(x)));
      case Op::log:
        return constant(S(log(x)));
      default:
        break;
    }
  }
  return operation(function, a, 0, nodes_[a].varies ? not_polynomial : 0);
}

template <Scalar S>
std::vector<typename Trace<S>::Id> Trace<S>::gradient(Id output, std::size_t inputs) {
  const Id zero = constant(S(0));
  std::vector<Id> adjoint(output + 1, zero);
  adjoint[output] = constant(S(1));
  // Nodes are numbered in the order of their computation; new ones, made on the way, come after `output`.
  for (Id i = output + 1; i-- > 0;) {
    const Node node = nodes_[i];
    const Id y = adjoint[i];
    if (node.kind != Kind::operation || !node.varies || y == zero) continue;
    const auto pass = [&](Id operand, Id contribution) {
      if (nodes_[operand].varies) adjoint[operand] = add(adjoint[operand], contribution);
    };
    switch (node.op) {
      case Op::add:
        pass(node.a, y);
        pass(node.b, y);
        break;
      case Op::subtract:
        pass(node.a, y);
        pass(node.b, multiply(constant(S(-1)), y));
        break;
      case Op::multiply:
        if (node.a == node.b) {
          pass(node.a, multiply(multiply(constant(S(2)), y), node.a));
        } else {
          pass(node.a, multiply(y, node.b));
          pass(node.b, multiply(y, node.a));
        }
        break;
      case Op::negate:
        pass(node.a, multiply(constant(S(-1)), y));
        break;
      case Op::abs:
        pass(node.a, multiply(y, apply(Op::sign, node.a)));
        break;
      case Op::sign:
        break;              // constant but at 0
      case Op::reciprocal:  // d(1/x) = -(1/x)^2 dx
        pass(node.a, multiply(multiply(constant(S(-1)), y), multiply(i, i)));
        break;
      case Op::sqrt:  // d sqrt(x) = dx / (2 sqrt(x))
        pass(node.a, multiply(multiply(constant(S(S(1) / 2)), y), apply(Op::reciprocal, i)));
        break;
      case Op::sin:
        pass(node.a, multiply(y, apply(Op::cos, node.a)));
        break;
      case Op::cos:
        pass(node.a, multiply(multiply(constant(S(-1)), y), apply(Op::sin, node.a)));
        break;
      case Op::exp:
        pass(node.a, multiply(y, i));
        break;
      case Op::log:
        pass(node.a, multiply(y, apply(Op::reciprocal, node.a)));
        break;
    }
  }
  std::vector<Id> result;
  for (std::size_t i = 0; i < inputs; ++i) {
    const Id leaf_id = input(i);
    result.push_back(leaf_id <= output ? adjoint[leaf_id] : zero);
  }
  return result;
}

template <Scalar S>
typename Trace<S>::Compiled Trace<S>::compile(const std::vector<Id>& outputs, std::size_t inputs,
                                              std::size_t parameters) const {
  // The use of node x by a varying operation (or as an output): what does not vary there is a coefficient.
  std::vector<bool> needed(nodes_.size(), false), coefficient(nodes_.size(), false);
  const auto need = [&](Id x) {
    needed[x] = true;
    if (!nodes_[x].varies && !is_constant(x)) coefficient[x] = true;
  };
  for (const Id x : outputs) need(x);
  for (Id i = nodes_.size(); i-- > 0;) {
    if (!needed[i] || nodes_[i].kind != Kind::operation || !nodes_[i].varies) continue;
    need(nodes_[i].a);
    if (is_binary(nodes_[i].op)) need(nodes_[i].b);
  }

  Compiled result;
  std::vector<std::optional<Operand>> place(nodes_.size());

  // The order of the code: what does not wait for a transcendental function comes before it, so that in double a
  // division, say, overlaps the call.
  std::vector<int> calls(nodes_.size(), 0);
  for (Id i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].kind != Kind::operation) continue;
    calls[i] = calls[nodes_[i].a] + (nodes_[i].op > Op::sqrt ? 1 : 0);
    if (is_binary(nodes_[i].op)) calls[i] = std::max(calls[i], calls[nodes_[i].b]);
  }
  std::vector<Id> order(nodes_.size());
  std::iota(order.begin(), order.end(), Id{0});
  std::stable_sort(order.begin(), order.end(), [&](Id x, Id y) { return calls[x] < calls[y]; });

  // First the coefficients, from the parameters alone.
  std::vector<bool> inside = coefficient;
  for (Id i = nodes_.size(); i-- > 0;) {
    if (!inside[i] || nodes_[i].kind != Kind::operation) continue;
    inside[nodes_[i].a] = true;
    if (is_binary(nodes_[i].op)) inside[nodes_[i].b] = true;
  }
  const auto emit = [&](const std::vector<bool>& wanted, bool varying, const std::vector<Id>& exits) {
    std::vector<S> constants;
    std::vector<Instruction> code;
    std::vector<Operand> ends;
    // Registers are reused as soon as their last reader has run.
    std::vector<Id> last_use(nodes_.size(), 0);
    for (const Id i : order) {
      if (!wanted[i] || nodes_[i].kind != Kind::operation || nodes_[i].varies != varying) continue;
      last_use[nodes_[i].a] = i;
      if (is_binary(nodes_[i].op)) last_use[nodes_[i].b] = i;
    }
    for (const Id x : exits) last_use[x] = nodes_.size();
    std::vector<std::uint32_t> free_registers;
    std::uint32_t registers = 0;
    const auto operand = [&](Id x) {
      if (is_constant(x) && !place[x]) {
        constants.push_back(nodes_[x].value);
        place[x] = Operand{Bank::constant, static_cast<std::uint32_t>(constants.size() - 1)};
      }
      return *place[x];
    };
    for (const Id i : order) {
      const Node& node = nodes_[i];
      if (!wanted[i] || node.kind != Kind::operation || node.varies != varying) continue;
      const bool two = is_binary(node.op);
      const bool negation = node.op == Op::multiply && is_constant(node.a, -1);
      const Operand a = operand(negation ? node.b : node.a);
      const Operand b = two && !negation ? operand(node.b) : Operand{};
      const auto release = [&](Id x) {
        if (last_use[x] == i && place[x] && place[x]->bank == Bank::temporary) {
          free_registers.push_back(place[x]->index);
          last_use[x] = nodes_.size() + 1;
        }
      };
      release(node.a);
      if (two) release(node.b);
      std::uint32_t target = registers;
      if (free_registers.empty()) {
        ++registers;
      } else {
        target = free_registers.back();
        free_registers.pop_back();
      }
      place[i] = Operand{Bank::temporary, target};
      code.push_back({negation ? Op::negate : node.op, a, b, target});
    }
    for (const Id x : exits) ends.push_back(operand(x));
    return Program<S>(std::move(constants), std::move(code), std::move(ends), registers);
  };

  for (std::size_t i = 0; i < parameters; ++i) {
    const auto found = known_.find(std::tuple(static_cast<int>(Kind::parameter), 0, i, Id{0}));
    if (found != known_.end()) place[found->second] = Operand{Bank::input, static_cast<std::uint32_t>(i)};
  }
  std::vector<Id> exits;
  for (Id i = 0; i < nodes_.size(); ++i)
    if (coefficient[i]) exits.push_back(i);
  result.coefficients = emit(inside, false, exits);

  std::fill(place.begin(), place.end(), std::nullopt);
  for (std::size_t i = 0; i < inputs; ++i) {
    const auto found = known_.find(std::tuple(static_cast<int>(Kind::input), 0, i, Id{0}));
    if (found != known_.end()) place[found->second] = Operand{Bank::input, static_cast<std::uint32_t>(i)};
  }
  for (std::size_t i = 0; i < exits.size(); ++i)
    place[exits[i]] = Operand{Bank::input, static_cast<std::uint32_t>(inputs + i)};
  result.program = emit(needed, true, outputs);
  return result;
}

#define HBVM_DEFINE(S) template class Trace<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
