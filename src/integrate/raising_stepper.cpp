#include "hbvm/integrate/raising_stepper.hpp"

#include <algorithm>

#include "copy_state.hpp"

namespace hbvm {

template <Scalar S>
RaisingStepper<S>::Nodes::Nodes(const Problem<S>& problem, int k, int s, const S& step, SolverKind solver)
    : method(make_hbvm<S>(k, s)), stepper(problem, method, step, solver), defect(problem, k, s, step) {}

template <Scalar S>
RaisingStepper<S>::RaisingStepper(const Problem<S>& problem, int k, int s, const S& step, SolverKind solver,
                                  NodeLog& log)
    : problem_(problem),
      s_(s),
      most_(max_k - s),
      h_(step),
      solver_(solver),
      log_(log),
      nodes_(make_nodes(k)),
      epsilon_(epsilon<S>()),
      nine_eighths_(S(9) / 8),
      energy_(problem),
      before_(Vector<S>::Zero(problem.m()), Vector<S>::Zero(problem.m())),
      tolerated_(1),
      records_(Matrix<S>::Zero(static_cast<Index>(problem.blocks.size()), 2)) {}

template <Scalar S>
auto RaisingStepper<S>::make_nodes(int k) const -> std::unique_ptr<Nodes> {
  auto nodes = std::make_unique<Nodes>(problem_, k, s_, h_, solver_);
  if (timed_) nodes->stepper.measure_time();
  return nodes;
}

template <Scalar S>
long RaisingStepper<S>::step(State<S>& state) {
  copy_state(before_, state);
  if (!started_) take_energy(state);
  started_ = true;
  long sweeps = nodes_->stepper.step(state);
  set(change_, H_);
  take_energy(state);
  set_difference(change_, H_, change_);
  if (is_due(state)) sweeps += examine(state);
  return sweeps;
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
bool RaisingStepper<S>::is_due(const State<S>& state) {
  ++since_;
  if (wait_ > 0) {
    --wait_;
    return false;
  }
  if (since_ >= interval || exceeds_records(false)) return true;
  // What round-off was when it was last looked at usually shows enough.
  if (!exceeds(change_, round_off_)) return false;
  take_round_off(state);
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
int RaisingStepper<S>::enough_nodes(Nodes& nodes) const {
  int reference_k = nodes.method.k;
  S reference = nodes.defect.relative();
  bool small = nodes.defect.may_be_round_off();
  for (int k = nodes.method.k;;) {
    k = std::min(k + std::max(1, k / 4), most_);
    QuadratureDefect<S> defect(problem_, k, s_, h_);
    if (defect.measure(before_.q, before_.p, nodes.stepper.solver().unknowns()) <= tolerated_ || k == most_) return k;
    // Once it is small, the error of the quadrature of a smooth force falls by far more when k is doubled.
    if (small && k < 2 * reference_k) continue;
    if (small && 2 * defect.relative() > reference) return reference_k == nodes.method.k ? 0 : reference_k;
    reference_k = k;
    reference = defect.relative();
    small = defect.may_be_round_off();
  }
}

template <Scalar S>
long RaisingStepper<S>::examine(State<S>& state) {
  since_ = 0;
  exceeds_records(true);
  take_round_off(state);
  QuadratureDefect<S>* defect = &nodes_->defect;
  if (defect->measure(before_.q, before_.p, nodes_->stepper.solver().unknowns()) <= tolerated_) return 0;

  // Rare: allocations do not matter from here on.
  long sweeps = 0;
  std::unique_ptr<Nodes> more;
  State<S> repeated = before_;
  bool enough = false;
  while (!enough) {
    Nodes& last = more ? *more : *nodes_;
    const int k = last.method.k < most_ ? enough_nodes(last) : 0;
    if (k == 0) {
      enough = last.defect.may_be_round_off();
      if (enough) raise_to(tolerated_, S(2 * last.defect.defect()));
      break;
    }
    std::unique_ptr<Nodes> next = make_nodes(k);
    copy_state(repeated, before_);
    try {
      sweeps += next->stepper.step(repeated);
    } catch (const StageFailure& failure) {
      sweeps += failure.sweeps();
      break;
    }
    if (more) add_counts(past_, more->stepper.counts(), problem_);
    more = std::move(next);
    enough = more->defect.measure(before_.q, before_.p, more->stepper.solver().unknowns()) <= tolerated_;
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
  log_.raised.push_back({log_.step, k()});
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
  SolverCounts sum = past_;
  add_counts(sum, nodes_->stepper.counts(), problem_);
  return sum;
}

template <Scalar S>
void RaisingStepper<S>::measure_time() {
  timed_ = true;
  nodes_->stepper.measure_time();
}

#define HBVM_DEFINE(S) template class RaisingStepper<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
