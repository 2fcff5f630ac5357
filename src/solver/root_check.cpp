#include "solver/root_check.hpp"

#include <algorithm>
#include <cmath>

#include "scalar/binary_exponent.hpp"

namespace hbvm::core {

template <Scalar S>
RootCheck<S>::Rounded::Rounded(const Problem<S>& full, const Hbvm<S>& full_method)
    : problem(in_double(full)), method(in_double(full_method)), newton(problem, method) {}

template <Scalar S>
auto RootCheck<S>::judge(const StepStart<S>& start, const Matrix<S>& gamma) -> Verdict {
  // Other solutions are other motions: they differ in the first digits.
  const double apart = power_of_two<double>(-10);
  sweeps_ = 0;
  if (!fits_double(problem_) || !fits_double(start.h)) return Verdict::unknown;
  const auto rounded = [](const auto& x) { return x.unaryExpr([](const S& entry) { return approximately(entry); }); };
  const Vector<double> q = rounded(start.q), p = rounded(start.p);
  const double h = approximately(start.h);
  try {
    if (!rounded_) rounded_ = std::make_unique<Rounded>(problem_, method_);
    sweeps_ = rounded_->newton.follow({q, p, h});
  } catch (const StageFailure& failure) {
    sweeps_ = failure.sweeps();
    return Verdict::lost;
  }
  const Matrix<double>& followed = rounded_->newton.unknowns().gamma;
  for (const auto& block : problem_.mass.blocks()) {
    double size = 0, difference = 0;
    for (Index j = block.offset; j < block.offset + block.size; ++j) {
      size = std::max(size, std::abs(p[j]));
      for (Index i = 0; i < gamma.rows(); ++i) {
        size = std::max(size, std::abs(followed(i, j)));
        difference = std::max(difference, std::abs(followed(i, j) - approximately(gamma(i, j))));
      }
    }
    if (!(difference <= apart * size)) return Verdict::other;
  }
  return Verdict::same;
}

#define HBVM_DEFINE(S) template class RootCheck<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
