#pragma once

#include <array>
#include <vector>

#include "hard_cases/case.hpp"
#include "run/scene_run.hpp"

namespace hbvm::core {

/// How far a quantity strays within n steps, for every power of two n. It is the mean, over the windows of n steps that
/// follow one another, of the greatest distance from the value at the window's start. A mean of many windows scatters
/// far less than the one greatest distance of the whole run.
class Straying {
 public:
  void add(double value);

  struct Point {
    long steps;
    double distance;
  };
  /// The points from n = 1 to the longest window that was completed.
  std::vector<Point> points() const;

 private:
  static constexpr std::size_t most = 40;
  // Of the windows of 2^j steps: where the present one starts and how far it strayed; the sum of those completed.
  std::array<double, most> start_{}, greatest_{}, sum_{};
  std::array<long, most> count_{};
  long n_ = 0;
};

/// What round-off did to energy and constraints over a long run, in units of epsilon times the size of their terms.
struct RoundOffGrowth {
  std::vector<Straying::Point> H, g;      ///< g: of the constraint that strays most; empty without constraints
  double e_H = 0, e_g = 0;                ///< in the same units
  double turnover_H = 0, turnover_g = 0;  ///< what a step adds to them, of either sign, over the size of their terms
  long steps = 0;
};

/// \throws StepError, InputError
RoundOffGrowth round_off_growth_of(const RunRequest& request);

/// Exponents of the growth of energy and constraints, at most 0.6 where round-off walks at random, and their sizes.
/// These are a few roundings of what each step adds, of either sign, and those of their evaluation.
CaseResult long_run(const RunRequest& request);

}  // namespace hbvm::core
