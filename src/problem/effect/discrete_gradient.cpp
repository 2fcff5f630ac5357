#include "problem/effect/discrete_gradient.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "hbvm/error.hpp"
#include "problem/effect/execution.hpp"
#include "problem/effect/trace.hpp"

namespace hbvm::core {
namespace {

/// The operations of U, recorded at x0 and at x1.
template <Scalar S>
class PairedTrace {
 public:
  using Id = typename Trace<S>::Id;

  PairedTrace(const Program<S>& program, std::size_t inputs)
      : program_(program),
        input_count_(inputs),
        parameters_(0),
        half_(trace_.constant(S(S(1) / 2))),
        minus_(trace_.constant(S(-1))) {
    for (std::size_t j = 0; j < inputs; ++j) add_leaf(trace_.input(j), trace_.input(inputs + j), true);
    std::vector<std::size_t> registers(program.temporaries());
    for (const Instruction& i : program.instructions()) {
      const std::size_t a = place_of(i.a, registers), b = is_binary(i.op) ? place_of(i.b, registers) : a;
      Node node{i.op, a, b, record(i.op, nodes_[a].at0, nodes_[b].at0), 0, nodes_[a].varies || nodes_[b].varies};
      node.at1 = node.varies ? record(i.op, nodes_[a].at1, nodes_[b].at1) : node.at0;
      registers[i.result] = nodes_.size();
      nodes_.push_back(node);
    }
    output_ = place_of(program.output_operands().front(), registers);
  }

  typename Trace<S>::Compiled compile() {
    std::vector<std::optional<Id>> adjoint(nodes_.size());
    adjoint[output_] = trace_.constant(S(1));
    for (std::size_t n = output_ + 1; n-- > 0;) {
      const Node& node = nodes_[n];
      if (!adjoint[n] || !node.varies || node.is_leaf) continue;
      differentiate(node, *adjoint[n], [&](std::size_t operand, Id share) {
        if (!nodes_[operand].varies) return;
        adjoint[operand] = adjoint[operand] ? trace_.add(*adjoint[operand], share) : share;
      });
    }
    std::vector<Id> outputs;
    for (std::size_t j = 0; j < input_count_; ++j) outputs.push_back(adjoint[j] ? *adjoint[j] : trace_.constant(S(0)));
    return trace_.compile(outputs, 2 * input_count_, parameters_);
  }

 private:
  struct Node {
    Op op;
    std::size_t a, b;  ///< nodes
    Id at0, at1;
    bool varies, is_leaf = false;
  };

  void add_leaf(Id at0, Id at1, bool varies) { nodes_.push_back({Op::add, 0, 0, at0, at1, varies, true}); }

  std::size_t place_of(const Operand& x, const std::vector<std::size_t>& registers) {
    if (x.bank == Bank::temporary) return registers[x.index];
    if (x.bank == Bank::input && x.index < input_count_) return x.index;
    Id id;
    if (x.bank == Bank::constant) {
      id = trace_.constant(program_.constants()[x.index]);
    } else {
      const std::size_t parameter = x.index - input_count_;
      parameters_ = std::max(parameters_, parameter + 1);
      id = trace_.parameter(parameter);
    }
    add_leaf(id, id, false);
    return nodes_.size() - 1;
  }

  Id record(Op op, Id a, Id b) {
    if (op == Op::add) return trace_.add(a, b);
    if (op == Op::subtract) return trace_.subtract(a, b);
    if (op == Op::multiply) return trace_.multiply(a, b);
    return op == Op::negate ? negative(a) : trace_.apply(op, a);
  }

  Id negative(Id a) { return trace_.multiply(minus_, a); }
  Id mean(const Node& x) { return x.varies ? trace_.multiply(half_, trace_.add(x.at0, x.at1)) : x.at0; }
  Id half_difference(const Node& x) { return trace_.multiply(half_, trace_.subtract(x.at1, x.at0)); }

  /// pass(operand, its share of the quotient y of what the node is).
  template <class Pass>
  void differentiate(const Node& node, Id y, Pass pass) {
    const Node a = nodes_[node.a], b = nodes_[node.b];
    switch (node.op) {
      case Op::add:
        pass(node.a, y);
        pass(node.b, y);
        break;
      case Op::subtract:
        pass(node.a, y);
        pass(node.b, negative(y));
        break;
      case Op::multiply:
        if (node.a == node.b) {
          pass(node.a, trace_.multiply(y, trace_.add(a.at0, a.at1)));
        } else {
          pass(node.a, trace_.multiply(y, mean(b)));
          pass(node.b, trace_.multiply(y, mean(a)));
        }
        break;
      default:
        pass(node.a, trace_.multiply(y, quotient(node, a)));
        break;
    }
  }

  /// (f(a1) - f(a0)) / (a1 - a0).
  Id quotient(const Node& f, const Node& a) {
    switch (f.op) {
      case Op::negate:
        return minus_;
      case Op::abs:
        return trace_.multiply(trace_.add(a.at0, a.at1), reciprocal(trace_.add(f.at0, f.at1)));
      case Op::reciprocal:
        return negative(trace_.multiply(f.at0, f.at1));
      case Op::sqrt:
        return reciprocal(trace_.add(f.at0, f.at1));
      case Op::sin:
        return trace_.multiply(trace_.apply(Op::cos, mean(a)), trace_.apply(Op::sinc, half_difference(a)));
      case Op::cos:
        return negative(trace_.multiply(trace_.apply(Op::sin, mean(a)), trace_.apply(Op::sinc, half_difference(a))));
      case Op::exp:
        return trace_.multiply(trace_.apply(Op::exp, mean(a)), trace_.apply(Op::sinhc, half_difference(a)));
      case Op::log: {
        const Id over = reciprocal(mean(a));
        return trace_.multiply(over, trace_.apply(Op::atanhc, trace_.multiply(half_difference(a), over)));
      }
      case Op::sinh:
        return trace_.multiply(trace_.apply(Op::cosh, mean(a)), trace_.apply(Op::sinhc, half_difference(a)));
      case Op::cosh:
        return trace_.multiply(trace_.apply(Op::sinh, mean(a)), trace_.apply(Op::sinhc, half_difference(a)));
      case Op::tanh: {
        const Id ends = trace_.multiply(trace_.apply(Op::cosh, a.at0), trace_.apply(Op::cosh, a.at1));
        return trace_.multiply(reciprocal(ends), trace_.apply(Op::sinhc, trace_.subtract(a.at1, a.at0)));
      }
      case Op::atan: {
        // Half of the angle has the tangent b = a c, c = 1/(1 + sqrt(1 + a^2)), below 1: b0 b1 is not -1.
        const Id one = trace_.constant(S(1));
        const auto half_angle = [&](Id x) {
          return reciprocal(trace_.add(one, trace_.apply(Op::sqrt, trace_.add(one, trace_.multiply(x, x)))));
        };
        const Id c0 = half_angle(a.at0), c1 = half_angle(a.at1);
        const Id b0 = trace_.multiply(a.at0, c0), b1 = trace_.multiply(a.at1, c1);
        const Id over = reciprocal(trace_.add(one, trace_.multiply(b0, b1)));
        const Id tangent = trace_.multiply(trace_.subtract(b1, b0), over);
        const Id slope = trace_.multiply(trace_.multiply(c0, c1), trace_.multiply(over, over));
        return trace_.multiply(trace_.constant(S(4)), trace_.multiply(slope, trace_.apply(Op::atanc, tangent)));
      }
      default:
        throw Error(std::string("the difference quotient of ") + name_of(f.op) + " is not known");
    }
  }

  Id reciprocal(Id a) { return trace_.apply(Op::reciprocal, a); }

  const Program<S>& program_;
  std::size_t input_count_, parameters_, output_ = 0;
  Trace<S> trace_;
  Id half_, minus_;
  std::vector<Node> nodes_;
};

}  // namespace

template <Scalar S>
DiscreteGradient<S> discrete_gradient(const EffectTerm<S>& term, Index inputs) {
  auto compiled = PairedTrace<S>(term.value, static_cast<std::size_t>(inputs)).compile();
  return {std::move(compiled.program), outputs_of(compiled.coefficients, Matrix<S>(), term.value_coefficients)};
}

#define HBVM_DEFINE(S) template DiscreteGradient<S> discrete_gradient<S>(const EffectTerm<S>&, Index);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
