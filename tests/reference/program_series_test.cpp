#include "reference/program_series.hpp"

#include <functional>

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "problem/effect/trace.hpp"
#include "scalar/literal.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

using T = Traced<Mpfr>;
using Function = std::function<T(const T&, const T&, const T&)>;

/// A function of two inputs and one parameter, as a program and its series where the inputs are polynomials of t.
class Formula {
 public:
  static constexpr Index order = 24;

  explicit Formula(const Function& f) {
    Trace<Mpfr> trace;
    const T x(trace, trace.input(0)), y(trace, trace.input(1)), c(trace, trace.parameter(0));
    compiled_ = trace.compile({f(x, y, c).id()}, 2, 1);
    const std::vector<const Mpfr*> parameter{&parameter_};
    Matrix<Mpfr> registers = compiled_.coefficients.make_registers(1);
    compiled_.coefficients.run(registers, parameter);
    for (std::size_t i = 0; i < compiled_.coefficients.outputs(); ++i)
      coefficients_.push_back(compiled_.coefficients.output(i, 0, registers, parameter));
    for (const Mpfr& coefficient : coefficients_) addresses_.push_back(&coefficient);
  }

  Mpfr x(const Mpfr& t) const { return Mpfr(2) / 3 + t / 2 - t * t / 5; }
  Mpfr y(const Mpfr& t) const { return Mpfr(7) / 5 - t / 3 + t * t * t / 7; }

  Mpfr value(const Mpfr& t) const {
    const Mpfr at_x = x(t), at_y = y(t);
    std::vector<const Mpfr*> inputs{&at_x, &at_y};
    inputs.insert(inputs.end(), addresses_.begin(), addresses_.end());
    Matrix<Mpfr> registers = compiled_.program.make_registers(1);
    compiled_.program.run(registers, inputs);
    return compiled_.program.output(0, 0, registers, inputs);
  }

  std::vector<Mpfr> series() const {
    ProgramSeries s(compiled_.program, 2, addresses_, order);
    const std::vector<Mpfr> x{Mpfr(2) / 3, Mpfr(1) / 2, Mpfr(-1) / 5},
        y{Mpfr(7) / 5, Mpfr(-1) / 3, Mpfr(0), Mpfr(1) / 7};
    std::vector<Mpfr> result;
    for (Index n = 0; n <= order; ++n) {
      s.input(0, n) = static_cast<std::size_t>(n) < x.size() ? x[static_cast<std::size_t>(n)] : Mpfr(0);
      s.input(1, n) = static_cast<std::size_t>(n) < y.size() ? y[static_cast<std::size_t>(n)] : Mpfr(0);
      s.advance(n);
      result.push_back(s.output(0, n));
    }
    return result;
  }

 private:
  Trace<Mpfr>::Compiled compiled_;
  Mpfr parameter_ = Mpfr(11) / 9;
  std::vector<Mpfr> coefficients_;
  std::vector<const Mpfr*> addresses_;
};

/// With t = 2^-20 the 24 terms leave about 2^-500 of what they are the series of.
TEST(ProgramSeries, SumsToTheValueOfTheProgram) {
  const PrecisionScope digits(140);
  const std::vector<std::pair<const char*, Function>> formulas{
      {"sum", [](const T& x, const T& y, const T& c) { return x + y - c; }},
      {"product", [](const T& x, const T& y, const T& c) { return c * x * y; }},
      {"square", [](const T& x, const T&, const T& c) { return x * x * c + x; }},
      {"quotient", [](const T& x, const T& y, const T& c) { return c * x / (y * y + 1); }},
      {"root", [](const T& x, const T& y, const T&) { return 1 / sqrt(x * x + y * y); }},
      {"sine", [](const T& x, const T& y, const T&) { return sin(x * y); }},
      {"cosine", [](const T& x, const T& y, const T&) { return y * cos(x); }},
      {"both", [](const T& x, const T& y, const T&) { return sin(x) * cos(x) + cos(y) * sin(y); }},
      {"exponential", [](const T& x, const T& y, const T& c) { return c * exp(x - y); }},
      {"logarithm", [](const T& x, const T& y, const T&) { return x * log(y); }},
      {"hyperbolic sine", [](const T& x, const T& y, const T&) { return sinh(x * y); }},
      {"hyperbolic cosine", [](const T& x, const T& y, const T&) { return y * cosh(x); }},
      {"both hyperbolic", [](const T& x, const T& y, const T&) { return sinh(x) * cosh(x) + cosh(y) * sinh(y); }},
      {"hyperbolic tangent", [](const T& x, const T& y, const T& c) { return tanh(x - c * y * y); }},
      {"arc tangent", [](const T& x, const T& y, const T& c) { return atan(c * x * y) * x; }},
      {"magnitude", [](const T& x, const T& y, const T&) { return abs(x - y) * y; }},
      {"constant", [](const T&, const T&, const T& c) { return c * c; }},
      {"all", [](const T& x, const T& y, const T& c) { return exp(sin(sqrt(x) / y)) * log(c * cos(x) * cos(x) + 1); }}};
  for (const auto& [name, f] : formulas) {
    const Formula formula(f);
    const std::vector<Mpfr> z = formula.series();
    for (const char* text : {"1/1048576", "-1/1048576"}) {
      const Mpfr t = literal<Mpfr>(text);
      Mpfr sum = 0;
      for (std::size_t n = z.size(); n-- > 0;) sum = sum * t + z[n];
      EXPECT_LE(magnitude(Mpfr(sum - formula.value(t))), 1000 * epsilon<Mpfr>()) << name;
    }
  }
}

TEST(ProgramSeries, RefusesWhereThereIsNone) {
  const PrecisionScope digits(30);
  const Function sure[] = {[](const T& x, const T&, const T&) { return sqrt(x - 3); },
                           [](const T& x, const T&, const T&) { return log(x - 3); }};
  for (const Function& f : sure)
    expect_words(message_of<IntegrationError>([&] { Formula(f).series(); }), {"no Taylor series"});
  // The difference may be rounding, which is refused for its sign or taken for what it is.
  const Function perhaps[] = {[](const T& x, const T&, const T&) { return 1 / (x - x * x / x); },
                              [](const T& x, const T&, const T&) { return abs(x - x * x / x); }};
  for (const Function& f : perhaps) {
    try {
      Formula(f).series();
    } catch (const IntegrationError& error) {
      expect_words(error.what(), {"no Taylor series"});
    }
  }
}

}  // namespace
}  // namespace hbvm::core
