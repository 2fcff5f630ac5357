#include "problem/formula/input.hpp"

#include "hbvm/error.hpp"
#include "problem/effect/compile.hpp"
#include "problem/effect/execution.hpp"
#include "problem/formula/evaluation.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
class Recording : public FormulaEvaluation<Recording<S>, S, Traced<S>> {
 public:
  Recording(const FormulaInput<S>& input, Trace<S>& trace)
      : FormulaEvaluation<Recording<S>, S, Traced<S>>(input, leaves(input.inputs(), trace, &Trace<S>::input),
                                                      leaves(input.parameters, trace, &Trace<S>::parameter)),
        trace_(trace) {}

  Traced<S> constant(const S& value) { return {trace_, trace_.constant(value)}; }
  void check(const Expression::Node&, const Traced<S>&) const {}

 private:
  static std::vector<Traced<S>> leaves(std::size_t count, Trace<S>& trace,
                                       typename Trace<S>::Id (Trace<S>::*leaf)(std::size_t)) {
    std::vector<Traced<S>> result;
    for (std::size_t i = 0; i < count; ++i) result.emplace_back(trace, (trace.*leaf)(i));
    return result;
  }

  Trace<S>& trace_;
};

/// Refuses the first operation that has no value.
template <Scalar S>
class Checking : public FormulaEvaluation<Checking<S>, S, S> {
 public:
  Checking(const FormulaInput<S>& input, const std::vector<S>& inputs, const std::vector<S>& parameters)
      : FormulaEvaluation<Checking<S>, S, S>(input, inputs, parameters), text_(input.formula.text()) {}

  S constant(const S& value) const { return value; }
  void check(const Expression::Node& node, const S& value) const {
    if (!is_finite(value)) throw ExpressionError(text_, node.at, std::string(reason(node.kind)) + " at the start");
  }

 private:
  static const char* reason(Expression::Node::Kind kind) {
    using Kind = Expression::Node::Kind;
    if (kind == Kind::divide) return "division by 0";
    if (kind == Kind::sqrt) return "square root of a negative number";
    if (kind == Kind::log) return "logarithm of a number that is not positive";
    if (kind == Kind::power) return "a power without a value";
    if (kind == Kind::asin || kind == Kind::acos) return "arc sine or cosine of a number beyond 1";
    if (kind == Kind::atan2) return "angle of a point with y = 0 and x <= 0";
    return "a value beyond the range of numbers";
  }

  const std::string& text_;
};

template <Scalar S>
Displacement<Mpfr> exactly(const Displacement<S>& x) {
  const auto same = [](const S& value) { return rounded_to<Mpfr>(raw(hbvm::core::exactly(value))); };
  Displacement<Mpfr> result;
  for (const auto& block : x.blocks) result.blocks.push_back({block.offset, same(block.weight)});
  result.shift.resize(x.shift.size());
  for (Index i = 0; i < x.shift.size(); ++i) result.shift[i] = same(x.shift[i]);
  return result;
}

}  // namespace

template <Scalar S>
Traced<S> record(const FormulaInput<S>& input, Trace<S>& trace) {
  return Recording<S>(input, trace).value();
}

template <Scalar S>
EffectTerm<S> make_term(const FormulaInput<S>& input) {
  EffectTerm<S> term;
  term.kind = "formula";
  term.arguments = input.arguments;
  std::vector<std::vector<S>> parameters;
  for (const auto& instance : input.instances) {
    term.displacements.insert(term.displacements.end(), instance.x.begin(), instance.x.end());
    parameters.push_back(instance.parameters);
  }
  Trace<S> trace;
  const typename Trace<S>::Id U = record(input, trace).id();
  compile(trace, U, input.inputs(), input.parameters, parameters, term);
  return term;
}

template <Scalar S>
void check_formula(const FormulaInput<S>& input, const EffectTerm<S>& term, const Vector<S>& q) {
  const Index d = input.dimension;
  Matrix<S> x(term.instances(), term.arguments * d);
  displace(term, d, lanes(q), x);
  for (Index n = 0; n < x.rows(); ++n) {
    const Vector<S> inputs = x.row(n).transpose();
    Checking<S>(input, {inputs.begin(), inputs.end()}, input.instances[static_cast<std::size_t>(n)].parameters).value();
  }
  Execution<S> gradient(term.gradient, term.gradient_coefficients, x, 1);
  gradient.run();
  for (Index n = 0; n < x.rows(); ++n)
    for (Index i = 0; i < x.cols(); ++i)
      if (!is_finite(gradient.output(i, n)))
        throw ExpressionError(input.formula.text(), 0, "a derivative has no value at the start");
}

template <Scalar S>
FormulaInput<Mpfr> exactly(const FormulaInput<S>& input) {
  FormulaInput<Mpfr> result{
      input.formula, input.constants, input.dimension, input.arguments, input.variables, input.parameters, {},
      input.timed};
  for (const auto& instance : input.instances) {
    auto& copy = result.instances.emplace_back();
    for (const Displacement<S>& x : instance.x) copy.x.push_back(exactly(x));
    for (const S& value : instance.parameters) copy.parameters.push_back(rounded_to<Mpfr>(raw(exactly(value))));
  }
  return result;
}

#define HBVM_DEFINE(S)                                                                            \
  template Traced<S> record<S>(const FormulaInput<S>&, Trace<S>&);                                \
  template EffectTerm<S> make_term<S>(const FormulaInput<S>&);                                    \
  template void check_formula<S>(const FormulaInput<S>&, const EffectTerm<S>&, const Vector<S>&); \
  template FormulaInput<Mpfr> exactly<S>(const FormulaInput<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
