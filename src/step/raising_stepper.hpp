#pragma once

#include <memory>
#include <vector>

#include "problem/energy_terms.hpp"
#include "problem/general_drift.hpp"
#include "step/hbvm_stepper.hpp"
#include "step/quadrature_defect.hpp"

namespace hbvm::core {

/// What became of the number of nodes in a run, in one list for all steppers that make its steps.
struct NodeLog {
  struct Raise {
    long step = 0;  ///< steps of the grid made before
    int k = 0;
    int r = 0;  ///< nodes for constraints, if these were raised, or 0
    void remember(Archive& archive) { archive(step, k, r); }
  };
  long step = 0;  ///< steps of the grid made: set by whoever counts them
  std::vector<Raise> raised;
  long unresolved = 0;        ///< steps seen for which no number of nodes was enough
  long first_unresolved = 0;  ///< the first of them

  void remember(Archive& archive) {
    archive(step, unresolved, first_unresolved);
    archive.sized(raised);
  }
};

/// What to do with a step for which no number of nodes is enough.
enum class OnShortage {
  keep,  ///< it is kept, and logged
  fail   ///< it fails, as one does whose stage equations cannot be solved: who divides it needs fewer nodes
};

/// Which numbers of nodes are raised.
enum class Raises { k, k_and_r };

/// Steps of HBVM(k, s) whose k is raised where it no longer suffices, and never falls. As long as it suffices the
/// digits are those of HbvmStepper.
///
/// A step is examined if its energy, or that since the first step, changed by more than round-off. It is examined, too,
/// if a body's force or momentum is greater by 1/8 than in any step examined before, and every `interval` steps. The
/// QuadratureDefect examines it: it sees each body with its own scale, where the energy is blind to a light one. If
/// more nodes would change the step, their number is raised by quarters until they do not, along the polynomial of the
/// step as made. The step is then repeated from its start, and so on until a repeated step passes. A defect that more
/// nodes do not make smaller is round-off, and tolerated from then on.
///
/// The number r of nodes for constraints that are not quadratic is raised likewise. It is enough where a step moves g
/// by round-off: its defect is what g moves by.
///
/// If no number of nodes is enough, or steps with more nodes fail, the step is too large for the motion. Where such
/// steps fail, eight times as many nodes as at first are the most. Where they are kept, that is logged, and no step is
/// examined for a while, each time twice as long. Such a step is as it was, unless more nodes reduce the change of its
/// energy by 2^10.
template <Scalar S>
class RaisingStepper final : public Stepper<S> {
 public:
  static constexpr long interval = 16;

  /// Starts with k nodes, and r for the constraints: s if the name does not say it. The problem and the log must
  /// outlive it.
  RaisingStepper(const Problem<S>& problem, HbvmName name, SolverKind solver, NodeLog& log,
                 OnShortage on_shortage = OnShortage::keep, Raises raises = Raises::k);

  const Problem<S>& problem() const override { return problem_; }
  StepResult<S> step(State<S>& state, const S& h) override;
  SolverCounts counts() const override;
  void remember(Archive& archive) override;

  int k() const { return nodes_->method.k; }
  int r() const { return nodes_->method.r; }

 private:
  /// All that depends on k and r.
  struct Nodes {
    Hbvm<S> method;
    HbvmStepper<S> stepper;
    QuadratureDefect<S> defect;
    StepResult<S> last;
    Nodes(const Problem<S>& problem, HbvmName name, SolverKind solver);
  };

  /// How closely a step is looked at. The usual look takes QuadratureDefect's own measure. The strict one, where the
  /// energy shows an error, takes what rounding makes of a mean of k + s terms.
  enum class Look { usual, strict };

  std::unique_ptr<Nodes> make_nodes(int k, int r) const;
  /// Takes the energy at the state.
  void take_energy(const State<S>& state);
  /// Takes the round-off of the energy at the start and at the end of the step just made.
  void take_round_off(const State<S>& state);
  /// Whether the energy shows an error: in the step just made, or since the first.
  bool energy_changed(const State<S>& state);
  /// Raises r where the step just made has moved g, and repeats it. \return the sweeps of that
  long keep_constraints(State<S>& state);
  /// Whether a body's psi or gamma is greater by 1/8 than its record; with `keep`, makes it the record.
  bool exceeds_records(bool keep);

  bool passes(const QuadratureDefect<S>& defect, Look look) const;
  /// Examines the step just made, and repeats it with more nodes where that helps. \return the sweeps of that
  long examine(State<S>& state, Look look);
  /// The least k, by quarters, above that of `nodes` that is enough along the polynomial it has made, or the greatest
  /// allowed. It is 0 if more nodes do not make the defect smaller, which is then round-off.
  int enough_nodes(Nodes& nodes, Look look) const;
  /// Whether the defect with the greatest number of nodes is round-off: half of them have no greater one.
  bool is_round_off(Nodes& nodes) const;
  /// Examines no steps for a while.
  void wait();

  const Problem<S>& problem_;
  int s_, most_;
  S h_ = 0;  ///< of the step being made
  SolverKind solver_;
  NodeLog& log_;
  OnShortage on_shortage_;
  std::unique_ptr<Nodes> nodes_;
  SolverCounts past_;  ///< of nodes given up
  S epsilon_, nine_eighths_;
  EnergyTerms<S> energy_;
  State<S> before_, after_;  ///< the step just made
  S H_ = 0, change_ = 0, round_off_ = 0, t_ = 0, u_ = 0;
  // What it remembers of the motion so far, beside k, after_, H_ and round_off_.
  bool started_ = false;
  long made_ = 0, since_ = 0, wait_ = 0, pause_ = interval, root_ = 0;
  S first_H_ = 0, alarm_ = 0;  ///< the energy before the first step, and the change since that is looked at next
  S noise_ = 0;                ///< relative defect that counts as round-off
  Matrix<S> records_;          ///< bodies x 2: the greatest force and momentum examined
  bool raises_r_;
  GeneralDrift<S> step_drift_, drift_;  ///< of g in a step, and since the first
  S g_noise_ = 0, g_alarm_ = 0;         ///< what counts as round-off in a step, and what is looked at since the first
};

}  // namespace hbvm::core
