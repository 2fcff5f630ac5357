#pragma once

#include <string>
#include <vector>

#include "hbvm/error.hpp"
#include "reference/compute_reference.hpp"
#include "reference/route_run.hpp"

namespace hbvm::core {

/// floor(log10 |x|), the exponent of the leading digit; x is not 0.
long decimal_exponent(const Mpfr& x);
/// x to the digit of 10^last.
std::string to_digit(const Mpfr& x, long last);

/// What one route found, and what the route is called.
struct NamedRun {
  std::string name;
  RouteRun run;
};

/// The runs differ in a digit that was asked for; the message says the same.
class Disagreement : public IntegrationError {
 public:
  struct Value {
    std::string route, number;
  };
  Disagreement(const std::string& message, std::string time, std::string where, std::vector<Value> found)
      : IntegrationError(message), t(std::move(time)), component(std::move(where)), values(std::move(found)) {}

  std::string t, component;   ///< "q_3"
  std::vector<Value> values;  ///< of every run
};

/// Runs of one motion beside each other. q, p, lambda, H and each conserved momentum are compared at each time, every
/// run with every other. So is what is conserved with what it was at the start. Digits are counted after the leading
/// one of a vector's greatest component. What is 0 but for rounding is measured by the terms that it is a sum of, or by
/// what it is at other times.
class Agreement {
 public:
  /// In the scope of the runs' digits. \param runs one at least; of one alone nothing is compared
  /// \throws IntegrationError for numbers that are not finite, and runs of different lengths
  Agreement(const Assembled<Mpfr>& scene, const std::vector<Expression>& times, const std::vector<NamedRun>& runs,
            int digits);

  /// In how many digits all runs agree, the least of all vectors and times.
  long digits() const;
  /// Whether that is one more than was asked for, at least.
  bool holds() const { return digits() > digits_; }
  /// The first that does not hold, if one does not. \throws Disagreement
  void require() const;

  /// The digits that were asked for, of the first run, in the order of the times.
  std::vector<ReferenceState> states() const;
  const std::vector<std::string>& momentum_names() const { return momentum_names_; }

 private:
  /// A vector at one time.
  struct Compared {
    std::string name;
    std::vector<Vector<Mpfr>> values;  ///< of each run, then at the start if it is conserved
    Mpfr natural = 0;                  ///< the size of the terms that it is a sum of, if it is a sum
    long leading = 0;                  ///< decimal exponent of the greatest component
    long agreed = 0;                   ///< digits after it
  };
  /// All vectors at one time.
  struct State {
    std::vector<Compared> vectors;
    long agreed() const;
  };
  void count_digits();
  [[noreturn]] void fail(std::size_t time, const Compared& vector) const;

  std::vector<std::string> times_, routes_, momentum_names_;
  int digits_;
  std::vector<State> states_;
};

}  // namespace hbvm::core
