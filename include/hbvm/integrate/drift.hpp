#pragma once

#include "hbvm/integrate/integrate.hpp"
#include "hbvm/problem/point.hpp"

namespace hbvm {

/// The paper's errors e_H, e_g and e_hid: maxima over the mesh, t = 0 included, of |H_n - H_0|, |g|_max and
/// |grad g^T M^-1 p|_max.
template <Scalar S>
class Drift final : public Observer<S> {
 public:
  explicit Drift(const Problem<S>& problem) : point_(problem) {}
  void observe(const Snapshot<S>& snapshot) override;

  const S& e_H() const { return e_H_; }
  const S& e_g() const { return e_g_; }
  const S& e_hid() const { return e_hid_; }
  const S& H0() const { return H0_; }

 private:
  Point<S> point_;
  S H0_ = 0, e_H_ = 0, e_g_ = 0, e_hid_ = 0;
};

#define HBVM_DECLARE(S) extern template class Drift<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
