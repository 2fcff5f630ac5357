#include "hbvm/analysis/cost/calibration.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "hbvm/clock.hpp"
#include "hbvm/scalar/in_place.hpp"
#include "hbvm/scalar/with_scalar.hpp"

namespace hbvm {

double typical_nanoseconds(const Precision& precision) {
  // Sums of products as the solver makes them: binary128 in software, mpfr with what surrounds each operation.
  switch (precision.kind()) {
    case Precision::Kind::binary64:
      return 1;
    case Precision::Kind::binary128:
      return 60;
    case Precision::Kind::mpfr:
      break;
  }
  const double digits = precision.digits();
  return 25 + digits / 4 + digits * digits / 4'000;
}

namespace {

/// What comes out of a precision must be no scalar.
struct LoopTime {
  double seconds;
};

}  // namespace

double calibration_seconds(const Precision& precision) {
  constexpr double nanoseconds = 3'000'000;
  constexpr std::size_t length = 64;
  const auto rounds =
      1 + static_cast<std::size_t>(nanoseconds / (typical_nanoseconds(precision) * 2 * static_cast<double>(length)));
  const LoopTime loop = with_scalar(precision, [&]<Scalar S>() {
    std::vector<S> x, y;
    for (std::size_t i = 0; i < length; ++i) {
      x.push_back(S(1) / static_cast<long>(i + 3));
      y.push_back(S(static_cast<long>(i + 2)) / static_cast<long>(i + 1));
    }
    // Sums that do not wait for one another: a core that another thread has a share in is slower at many operations at
    // a time, as the solver has them, but not at one after another.
    constexpr std::size_t at_a_time = 8;
    std::array<S, at_a_time> sums{};
    S product = 0;
    const double before = thread_seconds();
    for (std::size_t round = 0; round < rounds; ++round)
      for (std::size_t i = 0; i < length; ++i) {
        set_product(product, x[i], y[i]);
        S& sum = sums[i % at_a_time];
        set_sum(sum, sum, product);
      }
    const double seconds = thread_seconds() - before;
    // Looked at, so that the compiler cannot leave them out.
    return LoopTime{std::all_of(sums.begin(), sums.end(), [](const S& sum) { return is_finite(sum); }) ? seconds : 0};
  });
  return loop.seconds;
}

}  // namespace hbvm
