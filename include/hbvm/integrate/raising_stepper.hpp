#pragma once

#include <memory>
#include <vector>

#include "hbvm/integrate/hbvm_stepper.hpp"
#include "hbvm/integrate/quadrature_defect.hpp"
#include "hbvm/problem/energy_terms.hpp"

namespace hbvm {

/// What became of the number of nodes in a run, in one list for all steppers that make its steps.
struct NodeLog {
  struct Raise {
    long step;  ///< steps of the grid made before
    int k;
  };
  long step = 0;  ///< steps of the grid made: set by whoever counts them
  std::vector<Raise> raised;
  long unresolved = 0;        ///< steps seen for which no number of nodes was enough
  long first_unresolved = 0;  ///< the first of them
};

/// Steps of HBVM(k, s) whose k is raised where it no longer suffices, and never falls. As long as it suffices the
/// digits are those of HbvmStepper.
///
/// A step is examined if its energy changed by more than round-off, if a body's force or momentum is greater by 1/8
/// than in any step examined before, and every `interval` steps: by the QuadratureDefect, which sees each body with its
/// own scale, where the energy is blind to a light one. If more nodes would change the step, their number is raised by
/// quarters until they do not, along the polynomial of the step as made, and the step is repeated from its start; and
/// so on until a repeated step passes. A defect that more nodes do not make smaller is round-off, and tolerated from
/// then on. If no number of nodes is enough, or steps with more nodes fail, the step is too large for the motion:
/// that is logged, the step is kept, and none is examined for a while, each time twice as long.
template <Scalar S>
class RaisingStepper final : public Stepper<S> {
 public:
  static constexpr long interval = 16;

  /// Starts with k nodes. The problem and the log must outlive it.
  RaisingStepper(const Problem<S>& problem, int k, int s, const S& step, SolverKind solver, NodeLog& log);

  const Problem<S>& problem() const override { return problem_; }
  long step(State<S>& state) override;
  const Vector<S>& multiplier() const override { return nodes_->stepper.multiplier(); }
  const StageUnknowns<S>* unknowns() const override { return nodes_->stepper.unknowns(); }
  SolverCounts counts() const override;
  void measure_time() override;

  int k() const { return nodes_->method.k; }

 private:
  /// All that depends on k.
  struct Nodes {
    Hbvm<S> method;
    HbvmStepper<S> stepper;
    QuadratureDefect<S> defect;
    Nodes(const Problem<S>& problem, int k, int s, const S& step, SolverKind solver);
  };

  std::unique_ptr<Nodes> make_nodes(int k) const;
  /// Takes the energy at the state.
  void take_energy(const State<S>& state);
  /// Takes the sizes of the terms of the energy at the start and at the end of the step just made, for its round-off.
  void take_round_off(const State<S>& state);
  /// Whether the step just made is to be examined.
  bool is_due(const State<S>& state);
  /// Whether a body's psi or gamma is greater by 1/8 than its record; with `keep`, makes it the record.
  bool exceeds_records(bool keep);
  /// Examines the step just made, and repeats it with more nodes where that helps. \return the sweeps of that
  long examine(State<S>& state);
  /// The least k, by quarters, above that of `nodes` that is enough along the polynomial it has made, or the greatest
  /// allowed; 0 if more nodes do not make the defect smaller, which is then round-off.
  int enough_nodes(Nodes& nodes) const;
  /// Examines no steps for a while.
  void wait();

  const Problem<S>& problem_;
  int s_, most_;
  S h_;
  SolverKind solver_;
  NodeLog& log_;
  bool timed_ = false;
  std::unique_ptr<Nodes> nodes_;
  SolverCounts past_;  ///< of nodes given up
  S epsilon_, nine_eighths_;
  EnergyTerms<S> energy_;
  State<S> before_;
  S H_ = 0, change_ = 0, round_off_ = 0, t_ = 0, u_ = 0;
  // What it remembers beside k: from step to step, and of the motion so far.
  bool started_ = false;
  long since_ = 0, wait_ = 0, pause_ = interval;
  S tolerated_;        ///< defect that counts as round-off
  Matrix<S> records_;  ///< bodies x 2: the greatest force and momentum examined
};

#define HBVM_DECLARE(S) extern template class RaisingStepper<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
