#pragma once

#include <vector>

#include "hbvm/linear/matrix.hpp"
#include "hbvm/scalar/in_place.hpp"

namespace hbvm {

/// Continues a sequence x_1, x_2, … of vectors, one a step, by the polynomial through its last elements. It keeps the
/// backward differences D_r = nabla^r x_n; x_{n+1} is predicted as sum_{i <= r} D_i, and as D_{r+1} is the error that
/// the same prediction of x_n had, r is chosen to make that least.
template <Scalar S>
class Extrapolation {
 public:
  static constexpr Index max_order = 8;

  explicit Extrapolation(Index size) : size_(size), differences_(size, max_order + 2), scratch_(size) {}

  void clear() { known_ = 0; }
  bool empty() const { return known_ == 0; }

  /// x_{n+1} = x.
  void add(const S* x) {
    for (Index i = 0; i < size_; ++i) set(scratch_[i], x[i]);
    const Index differences = std::min(known_ + 1, max_order + 2);
    order_ = 0;
    for (Index r = 0; r < differences; ++r) {
      S* const old = differences_.data() + r * size_;
      using std::swap;  // Boost has its own, which exchanges the digits; the moves of std::swap may round them
      for (Index i = 0; i < size_; ++i) swap(old[i], scratch_[i]);
      if (r + 1 < differences)
        for (Index i = 0; i < size_; ++i) set_difference(scratch_[i], old[i], scratch_[i]);
      if (r == 0) continue;
      set_zero(norm_);
      for (Index i = 0; i < size_; ++i) raise_magnitude(norm_, old[i]);
      if (r > 1 && !exceeds(least_, norm_)) continue;
      set(least_, norm_);
      order_ = r - 1;
    }
    known_ = differences;
  }

  /// The prediction of x_{n+1}; not for an empty sequence.
  void predict(S* x) const {
    for (Index i = 0; i < size_; ++i) set(x[i], differences_.data()[i]);
    for (Index r = 1; r <= order_; ++r)
      for (Index i = 0; i < size_; ++i) set_sum(x[i], x[i], differences_.data()[r * size_ + i]);
  }
  Index order() const { return order_; }

 private:
  Index size_, known_ = 0, order_ = 0;
  Matrix<S> differences_;
  Vector<S> scratch_;
  S norm_ = 0, least_ = 0;
};

}  // namespace hbvm
