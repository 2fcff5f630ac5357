#pragma once

#include "integrate/observer.hpp"
#include "problem/redundant_constraints.hpp"
#include "problem/state_evaluator.hpp"
#include "solver/stage_failure.hpp"

namespace hbvm::core {

/// A constraint that followed from the others at the start has ceased to.
class RedundancyLost final : public IntegrationError {
 public:
  RedundancyLost(const std::string& what, std::string constraint, std::string time)
      : IntegrationError(what), constraint_(std::move(constraint)), time_(std::move(time)) {}
  FailureCause cause() const { return FailureCause::inconsistent_state; }
  const std::string& constraint() const { return constraint_; }
  const std::string& time() const { return time_; }

 private:
  std::string constraint_, time_;
};

/// The energy or a constraint has become infinite, or no number.
class NotFinite final : public IntegrationError {
 public:
  explicit NotFinite(const std::string& place,
                     const std::string& advice = "the step is far too large, or an effect has a singularity there")
      : IntegrationError(place + ": the energy or a constraint is not finite; " + advice), place_(place) {}
  const std::string& place() const { return place_; }

 private:
  std::string place_;
};

/// The paper's errors e_H, e_g and e_hid. They are maxima over the mesh, t = 0 included, of |H_n - H_0|, |g|_max and
/// |grad g^T M^-1 p|_max, redundant constraints included.
template <Scalar S>
class Drift final : public Observer<S> {
 public:
  explicit Drift(const Problem<S>& problem) : point_(problem), redundant_(problem) {}
  /// \throws RedundancyLost if a redundant constraint is violated by more than the root of epsilon of its terms;
  /// NotFinite
  void observe(const Snapshot<S>& snapshot) override;
  void remember(Archive& archive) override { archive(H0_, B0_, e_H_, e_B_, e_g_, e_hid_, redundancy_); }

  const S& e_H() const { return e_H_; }
  /// The same of H - W, which is H where forces have a potential and no point is driven.
  const S& e_B() const { return e_B_; }
  const S& e_g() const { return e_g_; }
  const S& e_hid() const { return e_hid_; }
  const S& H0() const { return H0_; }
  /// The greatest violation of a redundant constraint over the size of its terms; round-off if they are redundant.
  const S& redundancy() const { return redundancy_; }

 private:
  void watch_redundant(const Snapshot<S>& snapshot);

  StateEvaluator<S> point_;
  RedundantConstraints<S> redundant_;
  S H0_ = 0, B0_ = 0, e_H_ = 0, e_B_ = 0, e_g_ = 0, e_hid_ = 0, redundancy_ = 0;
};

}  // namespace hbvm::core
