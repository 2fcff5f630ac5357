#include "integrate/observations.hpp"

#include <algorithm>
#include <cmath>

#include "integrate/output_state.hpp"
#include "problem/formula/input.hpp"
#include "scalar/expression_node.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {

template <Scalar S>
Observations<S>::Observations(const Scene& scene, const Problem<S>& problem)
    : scene_(scene), problem_(problem), point_(problem), redundant_(problem) {
  const SeenQuantities<S> quantities(scene, problem);
  for (const SceneObservation& observation : scene.observations) {
    try {
      add(observation, quantities);
    } catch (const InputError& error) {
      throw InputError(scene.name + (observation.line > 0 ? ":" + std::to_string(observation.line) : "") +
                       ": observe '" + observation.name + "': " + error.what());
    }
  }
  const auto quantities_count = static_cast<Index>(quantities_.size());
  seen_ = angles_ = rates_ = Vector<S>::Zero(quantities_count);
  values_ = Vector<S>::Zero(static_cast<Index>(formulas_.size()));
  least_ = greatest_ = {values_, values_};
}

template <Scalar S>
void Observations<S>::add(const SceneObservation& observation, const SeenQuantities<S>& quantities) {
  auto formula = std::make_unique<Formula>();
  FormulaInput<S> input{observation.value, scene_.constants};
  for (const std::string& name : observation.value.names()) {
    if (scene_.constants.contains(name)) {
      if (name == "t") throw InputError("'t' is a constant of the scene, and the time here: rename the constant");
      continue;
    }
    auto known = std::find(names_.begin(), names_.end(), name);
    const auto at = static_cast<std::size_t>(known - names_.begin());
    if (known == names_.end()) {
      quantities_.push_back(quantities.named(name));
      names_.push_back(name);
    }
    input.variables.emplace(name, FormulaVariable{FormulaVariable::Is::input, formula->quantities.size()});
    formula->quantities.push_back(at);
  }
  if (formula->quantities.empty()) throw InputError("it names nothing of the motion");
  input.dimension = static_cast<Index>(formula->quantities.size());
  if (observation.value.root()->kind != Expression::Node::Kind::name) {
    input.instances.emplace_back();
    formula->term = make_term(input);
    formula->inputs = Matrix<S>::Zero(1, input.dimension);
    formula->execution =
        std::make_unique<Execution<S>>(formula->term.value, formula->term.value_coefficients, formula->inputs, 1);
  }
  formulas_.push_back(std::move(formula));
}

template <Scalar S>
void Observations<S>::take(const S& t, const Vector<S>& q, const Vector<S>& p) {
  state_.t = t;
  state_.q = q;
  const OutputState<S> output = output_state(point_, q, p);
  state_.p = output.p;
  state_.v = Vector<S>::Zero(q.size());
  problem_.mass.velocity(lanes(state_.p), lanes(state_.v));
  state_.lambda = redundant_.multipliers(q, output.lambda);
  state_.H = point_.energy(q, state_.p);
  state_.T = 0;
  for (Index i = 0; i < q.size(); ++i) state_.T += state_.p[i] * state_.v[i] / 2;
  for (std::size_t i = 0; i < quantities_.size(); ++i) seen_[static_cast<Index>(i)] = quantities_[i].value(state_);
}

template <Scalar S>
void Observations<S>::evaluate_all(bool at_start) {
  for (std::size_t n = 0; n < formulas_.size(); ++n) {
    Formula& formula = *formulas_[n];
    S& value = values_[static_cast<Index>(n)];
    if (formula.execution) {
      for (std::size_t i = 0; i < formula.quantities.size(); ++i)
        formula.inputs(0, static_cast<Index>(i)) = seen_[static_cast<Index>(formula.quantities[i])];
      formula.execution->run();
      value = formula.execution->output(0, 0);
    } else {
      value = seen_[static_cast<Index>(formula.quantities.front())];
    }
    if (is_finite(value)) continue;
    const std::string what =
        scene_.name + ": observe '" + scene_.observations[n].name + "' has no value at t = " + to_text(state_.t);
    if (at_start) throw InputError(what);
    throw IntegrationError(what);
  }
}

template <Scalar S>
void Observations<S>::observe(const Snapshot<S>& s) {
  take(s.t, s.q, s.p);
  const S passed = s.t - last_t_;
  for (std::size_t i = 0; i < quantities_.size(); ++i) {
    if (!quantities_[i].rate) continue;
    const auto at = static_cast<Index>(i);
    const S rate = quantities_[i].rate(state_);
    if (s.n > 0) turn_towards(seen_[at], S(angles_[at] + passed * (rates_[at] + rate) / 2));
    angles_[at] = seen_[at];
    rates_[at] = rate;
  }
  last_t_ = s.t;
  evaluate_all(s.n == 0);
  for (Index i = 0; i < values_.size(); ++i) {
    const auto take_if = [&](Extremes& extremes, bool beyond) {
      if (s.n > 0 && !beyond) return;
      extremes.values[i] = values_[i];
      extremes.times[i] = s.t;
    };
    take_if(least_, values_[i] < least_.values[i]);
    take_if(greatest_, values_[i] > greatest_.values[i]);
  }
}

template <Scalar S>
bool Observations<S>::has_angles() const {
  return std::ranges::any_of(quantities_, [](const SeenQuantity<S>& quantity) { return bool(quantity.rate); });
}

template <Scalar S>
bool Observations<S>::is_angle(Index observation) const {
  const Formula& formula = *formulas_[static_cast<std::size_t>(observation)];
  return !formula.execution && quantities_[formula.quantities.front()].rate;
}

template <Scalar S>
const Vector<S>& Observations<S>::see(const S& t, const Vector<S>& q, const Vector<S>& p) {
  take(t, q, p);
  evaluate_all(false);
  return values_;
}

template <Scalar S>
const Vector<S>& Observations<S>::see(const S& t, const Vector<S>& q, const Vector<S>& p, const Vector<S>& angles) {
  take(t, q, p);
  for (std::size_t i = 0; i < quantities_.size(); ++i)
    if (quantities_[i].rate) turn_towards(seen_[static_cast<Index>(i)], angles[static_cast<Index>(i)]);
  evaluate_all(false);
  return values_;
}

#define HBVM_DEFINE(S) template class Observations<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
