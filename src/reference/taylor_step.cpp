#include "reference/taylor_step.hpp"

namespace hbvm::core {
namespace {

/// So many series of so many terms.
template <class Series>
std::vector<BallSeries> exact_series(Index count, Index terms, Series series) {
  std::vector<BallSeries> result;
  for (Index i = 0; i < count; ++i) result.push_back(BallSeries::exactly(series(i), terms));
  return result;
}

}  // namespace

SeriesStep step_of(const TaylorMotion& motion, const BallProblem& problem) {
  const Index order = motion.order() - 1;
  const RealBall unit = exact_ball(raw(motion.unit()));
  // Any end serves that is about there.
  const BallScope bits(2 * static_cast<slong>(mpfr_get_prec(raw(motion.length()))));
  RealBall end = exact_ball(raw(motion.length())) / unit;
  arb_get_mid_arb(raw(end), raw(end));
  return {exact_series(problem.m(), order + 2, [&](Index j) { return motion.position(j); }),
          exact_series(problem.nu(), order, [&](Index a) { return motion.multiplier(a); }), unit, end, order};
}

}  // namespace hbvm::core
