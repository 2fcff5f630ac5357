#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "scalar/random_values.hpp"

namespace hbvm::core {

/// A number with its first and second derivatives by some variables, for formulas evaluated forwards by the rules of
/// the second order. A trace, which is differentiated backwards, is held against it.
template <class S>
struct Jet {
  using Row = std::vector<S>;
  S value;
  Row first;
  std::vector<Row> second;

  static Jet number(const S& value, std::size_t n) {
    const Row zeros(n, S(0));
    return {value, zeros, std::vector<Row>(n, zeros)};
  }
  static Jet variable(const S& value, std::size_t i, std::size_t n) {
    Jet result = number(value, n);
    result.first[i] = S(1);
    return result;
  }

  /// f(this), with the derivatives of f there.
  Jet through(const S& f, const S& df, const S& ddf) const {
    Jet r = number(f, first.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      r.first[i] = df * first[i];
      for (std::size_t j = 0; j < first.size(); ++j) r.second[i][j] = df * second[i][j] + ddf * first[i] * first[j];
    }
    return r;
  }
  Jet power(const S& n) const {
    using std::pow;
    return through(pow(value, n), n * pow(value, S(n - 1)), n * (n - 1) * pow(value, S(n - 2)));
  }

  friend Jet operator*(const Jet& a, const Jet& b) {
    Jet r = number(a.value * b.value, a.first.size());
    for (std::size_t i = 0; i < r.first.size(); ++i) {
      r.first[i] = a.first[i] * b.value + a.value * b.first[i];
      for (std::size_t j = 0; j < r.first.size(); ++j)
        r.second[i][j] =
            a.second[i][j] * b.value + a.first[i] * b.first[j] + a.first[j] * b.first[i] + a.value * b.second[i][j];
    }
    return r;
  }
  /// a + sign b.
  static Jet sum(const Jet& a, const Jet& b, int sign) {
    Jet r = a;
    const auto add = [&](S& to, const S& part) { to = sign > 0 ? S(to + part) : S(to - part); };
    add(r.value, b.value);
    for (std::size_t i = 0; i < r.first.size(); ++i) {
      add(r.first[i], b.first[i]);
      for (std::size_t j = 0; j < r.first.size(); ++j) add(r.second[i][j], b.second[i][j]);
    }
    return r;
  }
};

/// A random formula of the variables that are named, with values and derivatives for all of moderate size. It has its
/// text as a scene has it, and its value by another evaluator.
class RandomFormula {
 public:
  template <Scalar S>
  RandomFormula(RandomValues<S>& random, int depth, const std::vector<std::string>& names) {
    kind_ = depth == 0 ? Kind::leaf : static_cast<Kind>(random.whole(0, static_cast<long>(Kind::leaf)));
    whole_ = random.whole(0, 9);
    if (kind_ == Kind::leaf) {
      const auto count = static_cast<long>(names.size());
      name_ = static_cast<std::size_t>(random.whole(0, count + 1));
      text_ = name_ < names.size() ? names[name_]
              : whole_ % 2 == 0    ? "(" + std::to_string(whole_) + "/7)"
                                   : "0.3" + std::to_string(whole_) + "e-1";
      return;
    }
    for (int i = 0; i < 2; ++i) parts_.push_back(std::make_shared<RandomFormula>(random, depth - 1, names));
    // In the order of the kinds.
    constexpr std::array texts{"{a} + {b}",
                               "{a}-{b}",
                               "{a}*{b}",
                               "{a}/({b}^2 + 1)",
                               "-{a}*{b}",
                               "{a}^{power}/{scale}",
                               "(1 + {a}^2)^(-{whole}-1/2)",
                               "(2 + sin{a})^({whole}/3 + 1/3)",
                               "sqrt(1 + {a}^2)",
                               "sin{a}",
                               "cos {a}",
                               "tan(sin{a})",
                               "exp(sin{a})",
                               "log(2 + {a}^2)",
                               "sinh(cos{a})",
                               "cosh(sin{a})",
                               "tanh{a}",
                               "atan{a}",
                               "asin(sin{a}/2)",
                               "acos(cos{a}/2)",
                               "atan2(1 + {a}^2, {b})",
                               "abs(sin{a} - 2)"};
    static_assert(texts.size() == static_cast<std::size_t>(Kind::leaf));
    text_ =
        fmt::format(fmt::runtime(texts[static_cast<std::size_t>(kind_)]), fmt::arg("a", "(" + parts_[0]->text_ + ")"),
                    fmt::arg("b", "(" + parts_[1]->text_ + ")"), fmt::arg("whole", whole_),
                    fmt::arg("power", whole_ + 2), fmt::arg("scale", 1L << (whole_ + 2)));
  }

  const std::string& text() const { return text_; }

  template <class S>
  Jet<S> jet(const std::vector<Jet<S>>& variables) const {
    using std::acos, std::asin, std::atan, std::atan2, std::cos, std::cosh, std::exp, std::log, std::sin, std::sinh,
        std::sqrt, std::tan, std::tanh;
    using J = Jet<S>;
    const std::size_t n = variables.front().first.size();
    const auto plus = [&](const J& a, int number) { return J::sum(a, J::number(S(number), n), 1); };
    const auto sine = [](const J& a) { return a.through(sin(a.value), cos(a.value), S(-sin(a.value))); };
    const auto cosine = [](const J& a) { return a.through(cos(a.value), S(-sin(a.value)), S(-cos(a.value))); };
    if (kind_ == Kind::leaf) {
      if (name_ < variables.size()) return variables[name_];
      return J::number(
          whole_ % 2 == 0 ? S(S(static_cast<int>(whole_)) / 7) : S(S(static_cast<int>(30 + whole_)) / 1000), n);
    }
    const J a = parts_[0]->jet(variables), b = parts_[1]->jet(variables);
    const S& x = a.value;
    switch (kind_) {
      case Kind::add:
        return J::sum(a, b, 1);
      case Kind::subtract:
        return J::sum(a, b, -1);
      case Kind::multiply:
        return a * b;
      case Kind::divide:
        return a * plus(b * b, 1).power(S(-1));
      case Kind::negate:
        return J::sum(J::number(S(0), n), a * b, -1);
      case Kind::power: {
        J result = a;
        for (long i = 1; i < whole_ + 2; ++i) result = result * a;
        return result * J::number(S(S(1) / static_cast<int>(1L << (whole_ + 2))), n);
      }
      case Kind::half_power:
        return plus(a * a, 1).power(S(S(-1 - 2 * static_cast<int>(whole_)) / 2));
      case Kind::third_power:
        return plus(sine(a), 2).power(S(S(static_cast<int>(whole_) + 1) / 3));
      case Kind::root:
        return plus(a * a, 1).power(S(S(1) / 2));
      case Kind::sine:
        return sine(a);
      case Kind::cosine:
        return cosine(a);
      case Kind::tangent: {
        const J s = sine(a);
        const S t = tan(s.value), slope = 1 + t * t;
        return s.through(t, slope, S(2 * t * slope));
      }
      case Kind::exponential: {
        const J s = sine(a);
        const S e = exp(s.value);
        return s.through(e, e, e);
      }
      case Kind::logarithm: {
        const J s = plus(a * a, 2);
        const S over = 1 / s.value;
        return s.through(log(s.value), over, S(-over * over));
      }
      case Kind::hyperbolic_sine: {
        const J c = cosine(a);
        return c.through(sinh(c.value), cosh(c.value), sinh(c.value));
      }
      case Kind::hyperbolic_cosine: {
        const J s = sine(a);
        return s.through(cosh(s.value), sinh(s.value), cosh(s.value));
      }
      case Kind::hyperbolic_tangent: {
        const S t = tanh(x), slope = 1 - t * t;
        return a.through(t, slope, S(-2 * t * slope));
      }
      case Kind::arc_tangent: {
        const S slope = 1 / (1 + x * x);
        return a.through(atan(x), slope, S(-2 * x * slope * slope));
      }
      case Kind::arc_sine: {
        const J s = sine(a) * J::number(S(S(1) / 2), n);
        const S slope = 1 / sqrt(S(1 - s.value * s.value));
        return s.through(asin(s.value), slope, S(s.value * slope * slope * slope));
      }
      case Kind::arc_cosine: {
        const J c = cosine(a) * J::number(S(S(1) / 2), n);
        const S slope = 1 / sqrt(S(1 - c.value * c.value));
        return c.through(acos(c.value), S(-slope), S(-c.value * slope * slope * slope));
      }
      case Kind::angle: {  // pi/2 - atan(b/(1 + a^2))
        const J cotangent = b * plus(a * a, 1).power(S(-1));
        const S& t = cotangent.value;
        const S slope = 1 / (1 + t * t);
        return cotangent.through(atan2(S(1), t), S(-slope), S(2 * t * slope * slope));
      }
      case Kind::absolute:
        return J::sum(J::number(S(2), n), sine(a), -1);
      case Kind::leaf:
        break;
    }
    return a;
  }

 private:
  enum class Kind {
    add,
    subtract,
    multiply,
    divide,
    negate,
    power,
    half_power,
    third_power,
    root,
    sine,
    cosine,
    tangent,
    exponential,
    logarithm,
    hyperbolic_sine,
    hyperbolic_cosine,
    hyperbolic_tangent,
    arc_tangent,
    arc_sine,
    arc_cosine,
    angle,
    absolute,
    leaf
  };
  Kind kind_;
  long whole_;
  std::size_t name_ = 0;
  std::string text_;
  std::vector<std::shared_ptr<RandomFormula>> parts_;
};

}  // namespace hbvm::core
