#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "hbvm/horizon.hpp"
#include "integrate/observations.hpp"
#include "problem/redundant_constraints.hpp"
#include "problem/state_evaluator.hpp"

namespace hbvm::core {

/// What a picture shows of a run: however long it is, at most `most` samples at equal distances and the last mesh
/// point. Motion and multipliers are those at the samples; of the errors nothing is left out.
struct Recording {
  static constexpr long most = 1000;

  struct Sample {
    double t = 0;
    std::vector<double> q = {}, lambda = {};
    /// Of H less the work done. Decimal logarithms of |H - H_0|, |g|_max and |grad g^T M^-1 p|_max, the greatest since
    /// the sample before; minus infinity for 0. Errors of hundreds of digits are beyond the range of double, their
    /// logarithms are not.
    double energy = 0, constraints = 0, hidden = 0;
    double H_change = 0;  ///< H - H_0, at the sample
    std::vector<double> observed = {};
    std::vector<double> v = {};  ///< velocities of q
    /// The least and the greatest of lambda and of what is observed since the sample before.
    std::vector<double> least_lambda = {}, greatest_lambda = {}, least_observed = {}, greatest_observed = {};

    void remember(Archive& archive) {
      archive(t);
      archive(energy, constraints, hidden, H_change);
      for (std::vector<double>* const list :
           {&q, &lambda, &observed, &v, &least_lambda, &greatest_lambda, &least_observed, &greatest_observed})
        archive.sized(*list);
    }
  };

  long every = 1;                         ///< mesh points a sample
  long steps = 0;                         ///< of the whole run, also if it fails on the way
  std::string conserved = "H";            ///< or "H − W", where work is done
  std::vector<std::string> constraints;   ///< whose multipliers these are
  std::vector<std::string> observations;  ///< names of what was observed
  std::vector<Sample> samples;
  std::optional<DigitsLost> horizon = {};  ///< if it is to be shown
  /// Decimal logarithms of the terms of H at the start, and of their rounding or that of the terms of g, if it is less.
  double size_of_H = std::numeric_limits<double>::infinity(), round_off = -size_of_H;

  /// What is seen of the motion: of one whose H is off by more than its terms, for good, that before.
  Recording until_lost() const;

  /// q of all samples.
  std::vector<std::vector<double>> states() const;
};

/// Whose multipliers a picture shows: constraints that keep rigid bodies rigid are many, and say little beside others.
std::vector<std::size_t> shown_multipliers(const Recording& recording);

/// Fills a recording.
template <Scalar S>
class MotionRecorder final : public Observer<S> {
 public:
  /// \param observations that see each point before; null if there are none
  MotionRecorder(const Problem<S>& problem, long steps, Recording& recording,
                 const Observations<S>* observations = nullptr);
  void observe(const Snapshot<S>& snapshot) override;
  void remember(Archive& archive) override;

 private:
  const Problem<S>& problem_;
  StateEvaluator<S> point_;
  RedundantConstraints<S> redundant_;
  long steps_;
  Recording& recording_;
  const Observations<S>* observations_;
  S H0_ = 0, energy_ = 0, constraints_ = 0, hidden_ = 0;
  Vector<S> v_;
  /// Of what a sample has, since the one before.
  struct Range {
    std::vector<double> least, greatest;
    void take(const std::vector<double>& values);
    void remember(Archive& archive) {
      archive.sized(least);
      archive.sized(greatest);
    }
  };
  Range lambda_, observed_;
};

}  // namespace hbvm::core
