#include "problem/force/force_input.hpp"

#include <algorithm>

#include "hbvm/error.hpp"
#include "problem/effect/compile.hpp"
#include "problem/effect/execution.hpp"

namespace hbvm::core {
namespace {

using Ids = std::vector<std::size_t>;

/// Derivatives by very many inputs take that many operations.
constexpr std::size_t most_operations = 200'000;

template <Scalar S>
ForceArguments<Traced<S>> formal_arguments(const ForceInput<S>& input, Trace<S>& trace) {
  const auto d = static_cast<std::size_t>(input.dimension), n = static_cast<std::size_t>(input.arguments);
  ForceArguments<Traced<S>> formal;
  const auto vectors = [&](std::size_t first) {
    std::vector<std::vector<Traced<S>>> result;
    for (std::size_t a = 0; a < static_cast<std::size_t>(input.acting); ++a) {
      auto& one = result.emplace_back();
      for (std::size_t j = 0; j < d; ++j) one.emplace_back(trace, trace.input(first + a * d + j));
    }
    return result;
  };
  formal.x = vectors(0);
  formal.v = vectors(n * d);
  for (std::size_t i = 0; i < input.parameters; ++i) formal.parameters.emplace_back(trace, trace.parameter(i));
  for (const auto& [key, formulas] : input.values) {
    bool zero = true;
    for (const Expression& formula : formulas) {
      zero = zero && formula.text() == "0";
      FormulaInput<S> of{formula,         input.constants, input.dimension, 2 * input.arguments,
                         input.variables, input.parameters};
      try {
        formal.values[key].push_back(record(of, trace));
      } catch (const ExpressionError& error) {
        throw InputError("'" + key + "', " + formula.text() + ": " + error.reason());
      }
    }
    if (zero) formal.zeros.insert(key);
  }
  return formal;
}

template <Scalar S>
Matrix<S> parameters_of(const ForceInput<S>& input) {
  Matrix<S> result(static_cast<Index>(input.instances.size()), static_cast<Index>(input.parameters));
  for (std::size_t n = 0; n < input.instances.size(); ++n)
    std::copy(input.instances[n].parameters.begin(), input.instances[n].parameters.end(),
              result.row(static_cast<Index>(n)).begin());
  return result;
}

}  // namespace

template <Scalar S>
ForceTerm<S> make_force(const ForceInput<S>& input) {
  Trace<S> trace;
  const ForceArguments<Traced<S>> formal = formal_arguments(input, trace);
  Ids outputs, slopes;
  with_force(input.kind, input.mutual, [&]<class Force>() {
    for (const Traced<S>& component : Force::F(formal)) outputs.push_back(component.id());
  });
  if (outputs.size() != static_cast<std::size_t>(input.acting * input.dimension))
    throw Error("force '" + input.kind + "' has another number of components than what it acts on");
  const auto inputs = static_cast<std::size_t>(2 * input.arguments * input.dimension);
  for (const std::size_t output : outputs) {
    const Ids row = trace.gradient(output, inputs);
    slopes.insert(slopes.end(), row.begin(), row.end());
    if (trace.size() > most_operations) throw InputError("its derivatives take too many operations");
  }
  ForceTerm<S> term;
  term.kind = input.kind;
  term.name = input.name;
  term.arguments = input.arguments;
  term.acting = input.acting;
  for (const auto& instance : input.instances)
    term.displacements.insert(term.displacements.end(), instance.x.begin(), instance.x.end());
  const Matrix<S> own = parameters_of(input);
  auto force = trace.compile(outputs, inputs, input.parameters);
  auto derivatives = trace.compile(slopes, inputs, input.parameters);
  term.force_coefficients = outputs_of(force.coefficients, Matrix<S>(), own);
  term.slope_coefficients = outputs_of(derivatives.coefficients, Matrix<S>(), own);
  term.force = std::move(force.program);
  term.slopes = std::move(derivatives.program);
  return term;
}

template <Scalar S>
std::optional<EffectTerm<S>> potential_beside(const ForceInput<S>& input) {
  std::optional<EffectTerm<S>> term;
  with_force(input.kind, input.mutual, [&]<class Force>() {
    if constexpr (requires(const ForceArguments<Traced<S>>& of) { Force::U(of); }) {
      Trace<S> trace;
      const auto U = Force::U(formal_arguments(input, trace)).id();
      term.emplace();
      term->kind = input.kind;
      term->arguments = input.arguments;
      std::vector<std::vector<S>> parameters;
      for (const auto& instance : input.instances) {
        term->displacements.insert(term->displacements.end(), instance.x.begin(), instance.x.end());
        parameters.push_back(instance.parameters);
      }
      compile(trace, U, static_cast<std::size_t>(input.arguments * input.dimension), input.parameters, parameters,
              *term);
      // No motion of space is said to keep it: the frame turns about one axis, and momenta turn with it.
      term->symmetry.kind = Symmetry::computed;
      term->symmetry.acts.assign(input.instances.size(), true);
      const Index motions = rotations_in(input.dimension) + input.dimension;
      term->symmetry.conditions = Matrix<S>::Identity(motions, motions);
    }
  });
  return term;
}

template <Scalar S>
DrivenPoint<S> driven_point(std::string name, const std::vector<Expression>& position, const Constants& constants) {
  Trace<S> trace;
  Ids places, velocities, accelerations;
  for (const Expression& component : position) {
    const FormulaInput<S> of{component, constants, 1, 1, {{"t", {FormulaVariable::Is::input, 0}}}};
    const std::size_t x = record(of, trace).id(), v = trace.gradient(x, 1).front();
    places.push_back(x);
    velocities.push_back(v);
    accelerations.push_back(trace.gradient(v, 1).front());
  }
  Ids all = places;
  all.insert(all.end(), velocities.begin(), velocities.end());
  all.insert(all.end(), accelerations.begin(), accelerations.end());
  DrivenPoint<S> point{std::move(name), trace.compile(all, 1, 0).program};
  const Matrix<S> start = outputs_of(point.course, Matrix<S>(1, 0), Matrix<S>(Matrix<S>::Zero(1, 1)));
  for (Index i = 0; i < start.size(); ++i)
    if (!is_finite(start.data()[i])) throw InputError("'position' has no value, or no derivative, at t = 0");
  return point;
}

#define HBVM_DEFINE(S)                                                             \
  template ForceTerm<S> make_force<S>(const ForceInput<S>&);                       \
  template std::optional<EffectTerm<S>> potential_beside<S>(const ForceInput<S>&); \
  template DrivenPoint<S> driven_point<S>(std::string, const std::vector<Expression>&, const Constants&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
