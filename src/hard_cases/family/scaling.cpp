#include <fmt/format.h>

#include <array>

#include "hard_cases/family.hpp"
#include "hard_cases/motion.hpp"
#include "hard_cases/scenes.hpp"

namespace hbvm::core {
namespace {

/// Powers of two by which lengths, masses and times are multiplied.
using Powers = std::array<int, 3>;

RunRequest scaled(const Powers& powers, const std::string& solver, const std::string& precision) {
  const auto [length, mass, time] = powers;
  return request_of(scaled_pendulum(length, mass, time), "hbvm:4,2", solver, fmt::format("2^({})/16", time),
                    fmt::format("2^({})", time), precision);
}

long differing(const std::vector<BigFloat>& x, const std::vector<BigFloat>& y, long power) {
  long count = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    BigFloat expected = x[i];
    mpfr_mul_2si(raw(expected), raw(expected), power, MPFR_RNDN);
    count += mpfr_equal_p(raw(expected), raw(y[i])) == 0;
  }
  return count;
}

CaseResult bit_for_bit(const Powers& powers, const std::string& solver, const std::string& precision) {
  const SampledMotion plain = motion_of(scaled({0, 0, 0}, solver, precision));
  const SampledMotion other = motion_of(scaled(powers, solver, precision));
  const auto [length, mass, time] = powers;
  long count = 0;
  for (std::size_t n = 0; n < plain.samples.size(); ++n)
    count += differing(plain.samples[n].q, other.samples[n].q, length) +
             differing(plain.samples[n].p, other.samples[n].p, length + mass - time);
  CaseResult result;
  result.criteria = {{"coordinates that differ", static_cast<double>(count), 0}};
  return result;
}

}  // namespace

void add_scaling(const Family& family) {
  for (const Powers& powers :
       {Powers{-33, 0, 0}, Powers{0, 40, 0}, Powers{0, 0, -20}, Powers{10, -30, 7}, Powers{0, -1100, 0}})
    for (const std::string solver : {"auto", "newton", "fixed-point", "paper"}) {
      if (!family.full() && solver == "paper") continue;
      const bool tiny = powers[1] < -1000;
      for (const std::string& precision : all_precisions) {
        // Double has no such masses.
        const Expected expected = tiny && precision == "double" ? Expected{false, {"refused"}, {}, {}} : holds();
        // Newton's iteration looks for its start in double, which then does not hold the masses: the digits are right,
        // but come by another way.
        const bool other_way = tiny && (solver == "auto" || solver == "newton");
        family.add("charged double pendulum",
                   fmt::format("lengths 2^{}, masses 2^{}, times 2^{}, {}", powers[0], powers[1], powers[2], solver),
                   {precision}, expected, [powers, solver, other_way](const std::string& digits) {
                     if (other_way) return accuracy(scaled(powers, solver, digits));
                     return guarded([&] { return bit_for_bit(powers, solver, digits); });
                   });
      }
    }
}

}  // namespace hbvm::core
