#pragma once

#include "linear/matrix.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {

/// Arithmetic in place, as of one number (in_place.hpp), entry by entry of whole matrices or vectors of one size. None
/// of it allocates.

template <class A>
void set_zero(Eigen::PlainObjectBase<A>& a) {
  for (Index i = 0; i < a.size(); ++i) set_zero(a.data()[i]);
}

/// to = from.
template <class A, class B>
void set(Eigen::PlainObjectBase<A>& to, const Eigen::PlainObjectBase<B>& from) {
  for (Index i = 0; i < from.size(); ++i) set(to.data()[i], from.data()[i]);
}

/// r = a - b.
template <class R, class A, class B>
void set_difference(Eigen::PlainObjectBase<R>& r, const Eigen::PlainObjectBase<A>& a,
                    const Eigen::PlainObjectBase<B>& b) {
  for (Index i = 0; i < a.size(); ++i) set_difference(r.data()[i], a.data()[i], b.data()[i]);
}

/// r = factor a, which may be r.
template <class R, class A>
void set_product(Eigen::PlainObjectBase<R>& r, const typename A::Scalar& factor, const Eigen::PlainObjectBase<A>& a) {
  for (Index i = 0; i < a.size(); ++i) set_product(r.data()[i], factor, a.data()[i]);
}

}  // namespace hbvm::core
