#include "step/raising_stepper.hpp"

#include <algorithm>

#include "copy_state.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {

template <Scalar S>
RaisingStepper<S>::Nodes::Nodes(const Problem<S>& problem, HbvmName name, SolverKind solver)
    : method(make_hbvm<S>(name.k, name.s, name.r)), stepper(problem, method, solver), defect(problem, name.k, name.s) {}

template <Scalar S>
RaisingStepper<S>::RaisingStepper(const Problem<S>& problem, HbvmName name, SolverKind solver, NodeLog& log,
                                  OnShortage on_shortage, Raises raises)
    : problem_(problem),
      s_(name.s),
      most_(on_shortage == OnShortage::keep ? max_k - s_ : std::min(max_k - s_, 8 * std::max(name.k, name.r))),
      solver_(solver),
      log_(log),
      on_shortage_(on_shortage),
      nodes_(make_nodes(name.k, name.r == 0 ? name.s : name.r)),
      epsilon_(epsilon<S>()),
      nine_eighths_(S(9) / 8),
      energy_(problem),
      before_(Vector<S>::Zero(problem.m()), Vector<S>::Zero(problem.m())),
      after_(before_),
      records_(Matrix<S>::Zero(static_cast<Index>(problem.blocks.size()), 2)),
      raises_r_(raises == Raises::k_and_r),
      step_drift_(problem),
      drift_(problem) {
  raises_r_ = raises_r_ && !drift_.empty();
}

template <Scalar S>
auto RaisingStepper<S>::make_nodes(int k, int r) const -> std::unique_ptr<Nodes> {
  return std::make_unique<Nodes>(problem_, HbvmName{k, s_, r}, solver_);
}

template <Scalar S>
StepResult<S> RaisingStepper<S>::step(State<S>& state, const S& h) {
  set(h_, h);
  copy_state(before_, state);
  // The state need not be that after its last step, if others make steps, too.
  if (!started_ || state.q != after_.q || state.p != after_.p) take_energy(state);
  if (!started_) set(first_H_, H_);
  started_ = true;
  if (raises_r_ && made_ == 0) drift_.start(state.q);
  nodes_->last = nodes_->stepper.step(state, h_);
  long sweeps = nodes_->last.sweeps;
  if (raises_r_) sweeps += keep_constraints(state);
  ++made_;
  set(change_, H_);
  take_energy(state);
  set_difference(change_, H_, change_);
  ++since_;
  if (wait_ > 0)
    --wait_;
  else if (energy_changed(state))
    sweeps += examine(state, Look::strict);
  else if (since_ >= interval || exceeds_records(false))
    sweeps += examine(state, Look::usual);
  copy_state(after_, state);
  return {sweeps, nodes_->last.multiplier, nodes_->last.unknowns};
}

template <Scalar S>
void RaisingStepper<S>::take_energy(const State<S>& state) {
  energy_.evaluate_energy(state.q, state.p);
  set(H_, energy_.H());
}

template <Scalar S>
void RaisingStepper<S>::take_round_off(const State<S>& state) {
  // At either end H is right to epsilon/2 of what it is sensitive to, and to a rounding more of its terms.
  energy_.evaluate(before_.q, before_.p);
  set(round_off_, energy_.round_off_size());
  energy_.evaluate(state.q, state.p);
  if (exceeds(energy_.round_off_size(), round_off_)) set(round_off_, energy_.round_off_size());
  set_product(round_off_, round_off_, epsilon_);
  set_sum(round_off_, round_off_, round_off_);
}

template <Scalar S>
bool RaisingStepper<S>::energy_changed(const State<S>& state) {
  set_difference(t_, H_, first_H_);
  const bool drifted = exceeds(t_, alarm_), jumped = exceeds(change_, round_off_);
  // What round-off was when it was last looked at usually shows enough.
  if (!drifted && !jumped) return false;
  take_round_off(state);
  if (drifted) {
    // As it grows by itself: like the square root of the number of steps.
    while (root_ * root_ < made_ + energy_.count()) ++root_;
    u_ = root_;
    set_product(alarm_, round_off_, u_);
    if (exceeds(t_, alarm_)) {
      set_sum(alarm_, t_, t_);
      return true;
    }
  }
  return exceeds(change_, round_off_);
}

template <Scalar S>
bool RaisingStepper<S>::exceeds_records(bool keep) {
  const StageUnknowns<S>& x = nodes_->stepper.solver().unknowns();
  const Matrix<S>* const seen[2] = {&x.psi, &x.gamma};
  bool exceeded = false;
  for (Index b = 0; b < records_.rows(); ++b)
    for (Index which = 0; which < 2; ++which) {
      set_zero(t_);
      const Index first = problem_.blocks[static_cast<std::size_t>(b)].offset;
      for (Index j = first; j < first + problem_.dimension; ++j)
        for (Index i = 0; i < s_; ++i) raise_magnitude(t_, (*seen[which])(i, j));
      S& record = records_(b, which);
      if (keep) {
        if (exceeds(t_, record)) set(record, t_);
        continue;
      }
      set_product(u_, record, nine_eighths_);
      exceeded = exceeded || !(t_ <= u_);
    }
  return exceeded;
}

template <Scalar S>
bool RaisingStepper<S>::passes(const QuadratureDefect<S>& defect, Look look) const {
  return defect.relative() <= noise_ || (look == Look::usual ? defect.defect() <= 1 : defect.is_least());
}

template <Scalar S>
int RaisingStepper<S>::enough_nodes(Nodes& nodes, Look look) const {
  const S first = nodes.defect.relative();
  int reference_k = nodes.method.k;
  S reference = first;
  bool small = nodes.defect.may_be_round_off();
  for (int k = nodes.method.k;;) {
    k = std::min(k + std::max(1, k / 4), most_);
    QuadratureDefect<S> defect(problem_, k, s_);
    defect.measure({before_.q, before_.p, h_}, nodes.stepper.solver().unknowns());
    if (k == most_ || (passes(defect, look) && 4 * defect.relative() <= first)) return k;
    // Once it is small, the error of the quadrature of a smooth force falls by far more when k is doubled.
    if (small && k < 2 * reference_k) continue;
    if (small && 2 * defect.relative() > reference) return reference_k == nodes.method.k ? 0 : reference_k;
    reference_k = k;
    reference = defect.relative();
    small = defect.may_be_round_off();
  }
}

template <Scalar S>
bool RaisingStepper<S>::is_round_off(Nodes& nodes) const {
  if (!nodes.defect.may_be_round_off()) return false;
  QuadratureDefect<S> half(problem_, std::max(s_, nodes.method.k / 2), s_);
  half.measure({before_.q, before_.p, h_}, nodes.stepper.solver().unknowns());
  return half.relative() <= 2 * nodes.defect.relative();
}

template <Scalar S>
long RaisingStepper<S>::examine(State<S>& state, Look look) {
  since_ = 0;
  exceeds_records(true);
  take_round_off(state);
  nodes_->defect.measure({before_.q, before_.p, h_}, nodes_->stepper.solver().unknowns());
  if (passes(nodes_->defect, look)) return 0;

  // Rare: allocations do not matter from here on.
  long sweeps = 0;
  std::unique_ptr<Nodes> more;
  State<S> repeated = before_;
  bool enough = false;
  while (!enough) {
    Nodes& last = more ? *more : *nodes_;
    const bool greatest = last.method.k >= most_;
    const int next_k = greatest ? 0 : enough_nodes(last, look);
    if (next_k == 0) {
      enough = !greatest || is_round_off(last);
      if (enough) raise_to(noise_, S(2 * last.defect.relative()));
      break;
    }
    std::unique_ptr<Nodes> next = make_nodes(next_k, r());
    copy_state(repeated, before_);
    try {
      next->last = next->stepper.step(repeated, h_);
      sweeps += next->last.sweeps;
    } catch (const StageFailure& failure) {
      sweeps += failure.sweeps();
      break;
    }
    if (more) add_counts(past_, more->stepper.counts(), problem_);
    more = std::move(next);
    more->defect.measure({before_.q, before_.p, h_}, more->stepper.solver().unknowns());
    enough = passes(more->defect, look);
  }
  if (!enough && on_shortage_ == OnShortage::fail) {
    copy_state(state, before_);
    if (more) add_counts(past_, more->stepper.counts(), problem_);
    throw StageFailure(FailureCause::stage_equations_diverge,
                       "no number of nodes up to " + std::to_string(most_) + " integrates the forces to round-off",
                       to_scientific(nodes_->defect.relative(), 3), sweeps);
  }
  if (!enough) wait();
  if (!more) return sweeps;
  energy_.evaluate_energy(repeated.q, repeated.p);
  const S change = energy_.H() - (H_ - change_);
  if (!enough && !(1'024 * magnitude(change) <= magnitude(change_))) {
    add_counts(past_, more->stepper.counts(), problem_);
    return sweeps;
  }
  copy_state(state, repeated);
  set(H_, energy_.H());
  add_counts(past_, nodes_->stepper.counts(), problem_);
  nodes_ = std::move(more);
  exceeds_records(true);
  log_.raised.push_back({log_.step, k(), 0});
  return sweeps;
}

template <Scalar S>
long RaisingStepper<S>::keep_constraints(State<S>& state) {
  using std::sqrt;
  // A unit of the sizes of g and of q at either end, which allows for what the sums of the step round.
  constexpr int roundings = 1;
  step_drift_.start(before_.q);
  S change = step_drift_.in_units(state.q);
  bool drifts = false;
  if (const S whole = drift_.in_units(state.q); whole > g_alarm_) {
    g_alarm_ = roundings * sqrt(S(made_ + 1));
    drifts = whole > g_alarm_;
    if (drifts) g_alarm_ = 2 * whole;
  }
  const S limit = std::max(S(roundings), g_noise_);
  if (change <= limit && !drifts) return 0;

  // Rare, as in examine().
  long sweeps = 0;
  State<S> repeated = before_;
  for (bool doubled = false; !(change <= limit) || drifts;) {
    const int next = std::min(doubled ? 2 * r() : r() + std::max(1, r() / 4), most_);
    if (next == r()) break;
    std::unique_ptr<Nodes> more = make_nodes(k(), next);
    copy_state(repeated, before_);
    try {
      more->last = more->stepper.step(repeated, h_);
      sweeps += more->last.sweeps;
    } catch (const StageFailure& failure) {
      sweeps += failure.sweeps();
      break;
    }
    const S with_more = step_drift_.in_units(repeated.q);
    // What adds up over many steps is too small to be told from rounding in one.
    const bool only_drifts = drifts && change <= limit;
    if (!(2 * with_more <= change) && !only_drifts) {
      add_counts(past_, more->stepper.counts(), problem_);
      if (doubled) {
        // More nodes do not make it smaller: it is rounding, or the step too large for any number of them.
        if (change * change * epsilon_ < 1) raise_to(g_noise_, S(2 * change));
        break;
      }
      doubled = true;
      continue;
    }
    copy_state(state, repeated);
    add_counts(past_, nodes_->stepper.counts(), problem_);
    nodes_ = std::move(more);
    log_.raised.push_back({log_.step, k(), r()});
    change = with_more;
    doubled = drifts = false;
  }
  if (!(change <= std::max(limit, g_noise_))) {
    if (on_shortage_ == OnShortage::fail) {
      copy_state(state, before_);
      throw StageFailure(FailureCause::stage_equations_diverge,
                         "no number of nodes up to " + std::to_string(most_) + " keeps the constraints to round-off",
                         to_scientific(S(change * epsilon_), 3), sweeps);
    }
    if (log_.unresolved++ == 0) log_.first_unresolved = log_.step;
    raise_to(g_noise_, S(2 * change));
  }
  return sweeps;
}

template <Scalar S>
void RaisingStepper<S>::wait() {
  if (log_.unresolved++ == 0) log_.first_unresolved = log_.step;
  wait_ = pause_;
  pause_ *= 2;
}

template <Scalar S>
SolverCounts RaisingStepper<S>::counts() const {
  return sum_of(past_, nodes_->stepper.counts(), problem_);
}

template <Scalar S>
void RaisingStepper<S>::remember(Archive& archive) {
  int k = this->k(), r = this->r();
  archive(k, r);
  if (k != this->k() || r != this->r()) nodes_ = make_nodes(k, r);
  archive(nodes_->stepper, past_, after_, H_, round_off_, started_, made_, since_, wait_, pause_, root_, first_H_,
          alarm_, noise_, records_, drift_, g_noise_, g_alarm_);
}

#define HBVM_DEFINE(S) template class RaisingStepper<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
