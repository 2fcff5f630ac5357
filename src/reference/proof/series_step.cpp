#include "series_step.hpp"

namespace hbvm::core {

SeriesStep::SeriesStep(std::vector<BallSeries> q, std::vector<BallSeries> lambda, const RealBall& unit,
                       const RealBall& end, Index order)
    : q_(std::move(q)), lambda_(std::move(lambda)), unit_(unit), end_(end), order_(order) {
  const BallScope exactly(ARF_PREC_EXACT);
  for (const BallSeries& x : q_) {
    v_.push_back(x.derivative());
    a_.push_back(v_.back().derivative());
  }
}

RealBall SeriesStep::end_time(RealBall start) const {
  arb_addmul(raw(start), raw(end_), raw(unit_), ARF_PREC_EXACT);
  return start;
}

std::vector<RealBall> SeriesStep::velocities(const RealBall& s) const {
  std::vector<RealBall> v = at(v_, s);
  for (RealBall& x : v) x = x / unit_;
  return v;
}

std::vector<RealBall> SeriesStep::accelerations(const RealBall& s) const {
  std::vector<RealBall> a = at(a_, s);
  for (RealBall& x : a) x = x / unit_ / unit_;
  return a;
}

SeriesStep SeriesStep::rounded() const {
  SeriesStep result = *this;
  for (std::vector<BallSeries>* const all : {&result.q_, &result.v_, &result.a_, &result.lambda_})
    for (BallSeries& x : *all) x = x.rounded_within(end_);
  return result;
}

std::vector<RealBall> SeriesStep::at(const std::vector<BallSeries>& series, const RealBall& s) {
  std::vector<RealBall> result;
  for (const BallSeries& x : series) result.push_back(x.at(s));
  return result;
}

}  // namespace hbvm::core
