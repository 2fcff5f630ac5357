#pragma once

#include "method/hbvm_name.hpp"
#include "method/perturbation.hpp"
#include "step/method.hpp"

namespace hbvm::core {

/// HBVM(k, s), of order 2s in q and the tangential momentum; hbvm:auto,S as long as its k is not chosen. For an audit
/// one of its numbers may be wrong.
class HbvmMethod final : public MethodByTemplate<HbvmMethod> {
 public:
  /// \throws InputError as HbvmName::check and perturb do
  explicit HbvmMethod(HbvmName name, std::optional<Perturbation> perturbation = {});

  const HbvmName& name() const { return name_; }
  const std::optional<Perturbation>& perturbation() const { return perturbation_; }
  /// The number of nodes for the constraints of a problem: as named, or s if g is at most quadratic. For g of degree d
  /// it is r >= d s/2, which keeps g exactly; for other g it is k.
  template <Scalar S>
  int constraint_nodes(const Problem<S>& problem) const;
  /// With so many nodes for the constraints. \throws InputError if k is not chosen
  template <Scalar S>
  Hbvm<S> coefficients(int r) const;
  /// With as many as named, or s.
  template <Scalar S>
  Hbvm<S> coefficients() const {
    return coefficients<S>(name_.r == 0 ? name_.s : name_.r);
  }

  std::string text() const override { return name_.text(); }
  std::string title() const override;
  std::string key() const override;
  int order() const override { return 2 * name_.s; }
  int stages() const override { return name_.s; }
  int terms() const override { return name_.k + name_.s; }
  Kept kept() const override;
  /// Those of the paper: r = s + 1 for odd s, s for even.
  Orders orders() const override;
  Constants parameters() const override;

  template <Scalar S>
  StepperMaker<S> prepare_in(const Problem<S>& problem, SolverKind solver) const;

 private:
  HbvmName name_;
  std::optional<Perturbation> perturbation_;
};

/// \throws InputError as HbvmName::check does
MethodPtr hbvm_of(HbvmName name, std::optional<Perturbation> perturbation = {});

/// From "K,S" or "auto,S". \throws InputError
MethodPtr hbvm_method(std::string_view arguments);

/// The method as one of these, or null.
const HbvmMethod* as_hbvm(const Method& method);

}  // namespace hbvm::core
