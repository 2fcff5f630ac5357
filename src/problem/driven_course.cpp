#include "problem/driven_course.hpp"

#include "scalar/in_place.hpp"

namespace hbvm::core {

template <Scalar S>
DrivenCourse<S>::DrivenCourse(const Problem<S>& problem, Index lanes)
    : first_(problem.clock()), d_(problem.dimension), times_(Matrix<S>::Zero(lanes, 1)) {
  const Matrix<S> no_coefficients(1, 0);
  for (const DrivenPoint<S>& point : problem.driven) points_.emplace_back(point.course, no_coefficients, times_, lanes);
}

template <Scalar S>
void DrivenCourse<S>::evaluate() {
  for (Execution<S>& point : points_) point.run();
}

template <Scalar S>
void DrivenCourse<S>::set_outputs(Lanes<S> to, Index derivative) const {
  Index column = first_;
  for (const Execution<S>& point : points_)
    for (Index j = 0; j < d_; ++j, ++column)
      for (Index i = 0; i < to.count; ++i) set(to[column][i], point.output(derivative * d_ + j, i));
}

template <Scalar S>
void DrivenCourse<S>::make_powers(Lanes<S> force) const {
  Index column = first_;
  for (const Execution<S>& point : points_)
    for (Index j = 0; j < d_; ++j, ++column)
      for (Index i = 0; i < force.count; ++i) set_product(force[column][i], force[column][i], point.output(d_ + j, i));
}

#define HBVM_DEFINE(S) template class DrivenCourse<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
