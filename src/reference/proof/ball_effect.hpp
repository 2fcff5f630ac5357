#pragma once

#include <vector>

#include "ball_series.hpp"
#include "linear/matrix.hpp"
#include "problem/effect/program.hpp"

namespace hbvm::core {

/// A number of the scene that was computed with so many bits, as a ball: its last quarter is not believed.
RealBall believed(const Mpfr& x);
std::vector<RealBall> believed(const Vector<Mpfr>& x);

/// A program of an effect over power series of balls. Series of one term are ranges of its values. Series of two terms
/// are ranges of values and of derivatives along a direction.
class BallEffect {
 public:
  /// \param coefficients  the inputs that are numbers, after those that vary
  BallEffect(const Program<Mpfr>& program, const std::vector<Mpfr>& coefficients);

  /// The outputs' terms below degree `length`, from the series of the inputs that vary. Where an operation has no value
  /// coefficients are not finite.
  std::vector<BallSeries> outputs(const std::vector<BallSeries>& inputs, Index length) const;

 private:
  const Program<Mpfr>& program_;
  std::vector<BallSeries> coefficients_, constants_;
};

}  // namespace hbvm::core
