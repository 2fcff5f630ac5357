#pragma once

#include <string>
#include <string_view>

#include "reference/compute_reference.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {

/// What of the state at the end has to be right.
enum class CostQuantity { q, p, lambda, all };
/// \throws InputError for an unknown name
CostQuantity parse_cost_quantity(std::string_view name);
std::string_view name_of(CostQuantity quantity);

/// log10 of relative errors at the end of a run; NaN for multipliers of a scene without constraints.
struct CostErrors {
  double q = 0, p = 0, lambda = 0;

  /// Of `all` the greatest.
  double of(CostQuantity quantity) const;
};

/// Says how far a state is from the reference, relative to it. The coordinates of a body, or of a director of one, are
/// compared with the greatest of them. A multiplier is compared with itself. What is 0 there is compared with the
/// greatest of its kind, q, p or lambda. So bodies, lengths and units may be as uneven as they like.
class CostJudge {
 public:
  /// \param state of the scene at the time; it has `digits` digits after the leading one of each vector
  CostJudge(const Scene& scene, const ReferenceState& state, int digits);

  /// Each at least what the last digit of the reference leaves open.
  template <Scalar S>
  CostErrors errors(const Vector<S>& q, const Vector<S>& p, const Vector<S>& lambda) const;
  /// log10 of what the last digit leaves open.
  const CostErrors& resolution() const { return resolution_; }
  bool has_multipliers() const { return lambda_.exact.size() > 0; }

 private:
  struct Component {
    Vector<Mpfr> exact, scale;  ///< entry by entry
  };
  Component component(const std::vector<std::string>& texts, const Vector<Mpfr>& start, Index group,
                      double& resolution);
  template <Scalar S>
  double error(const Component& component, const Vector<S>& found, double resolution) const;

  int digits_;
  unsigned working_digits_;
  Component q_, p_, lambda_;
  CostErrors resolution_;
};

}  // namespace hbvm::core
