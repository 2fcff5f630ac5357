#pragma once

#include <string>
#include <vector>

#include "loop.hpp"
#include "problem/effect/program.hpp"

namespace hbvm::core {

/// A program of an effect evaluated over balls along a closed curve in complex time, on which its inputs are loops. It
/// tells whether the outputs are analytic inside the curve, and how large they are on it.
///
/// They are analytic if no operation on the way meets a singularity inside. Then no 1/a meets a zero of a, no root or
/// logarithm a zero of a, and no tanh a a zero of cosh a. No atan a meets a zero of 1 + i a or 1 - i a, and no
/// magnitude a zero of a. An analytic function has as many zeros inside a curve as it turns about 0 along it (the
/// argument principle). Roots and logarithms are continued from arc to arc, so that they are of one branch. Values of
/// degree 2 in the inputs, such as the square of a distance, are computed as loops, whose terms may cancel.
///
/// Far from where it matters exp(a) turns about 0 as often as Im a passes 2 pi, and yet has no zero. So values are kept
/// as m exp(v), of which m alone is followed. Then 1/cosh(a), tanh(a) and 1/(c + exp(a)) are known to be analytic where
/// Re a keeps its sign, however large a is.
class BallProgram {
 public:
  /// The first inputs vary; the others are numbers, `coefficients`.
  BallProgram(const Program<Mpfr>& program, Index inputs, const std::vector<const Mpfr*>& coefficients);

  /// Whether all outputs are analytic inside the curve, and output i at most 2^log2_limits[i] on it. So are its Taylor
  /// or Legendre coefficients, by Cauchy's estimate. A curve for which it says no may only be too wide for its arcs.
  bool is_bounded(const std::vector<Loop>& inputs, const std::vector<double>& log2_limits);
  /// What was in the way the last time: "a division by 0", "a value that is too large".
  const std::string& obstacle() const { return obstacle_; }

 private:
  /// Which way a number lies from 0 while its curve is followed, in quarter turns from the positive real axis. It is
  /// within one quarter turn of that direction.
  struct Direction {
    long quarters = 0, first = 0;
    const char* singularity = "";  ///< what 0 is
  };
  /// The exponent v of a value m exp(v), whose m is its ball. Whether it has one, and which, is decided where a curve
  /// begins.
  struct Exponent {
    bool there = false;
    int sign = 1;                  ///< v is this times `of`, if that is there
    const Ball* of = nullptr;      ///< null: a sum of others
    bool first_is_greater = true;  ///< of a sum of two
    Ball v;                        ///< 0 if there is none
  };
  struct Step {
    Op op;
    const Ball *a, *b;
    Ball* z;
    std::size_t direction = 0;  ///< the first of those it needs, if it needs any
  };
  /// A value that is a loop, as the inputs are: a sum, a difference, a product of two, or the negative of one.
  struct Polynomial {
    Op op;
    std::size_t a, b, z;  ///< numbers of values
  };
  struct Arc {
    double middle, half_width;
    bool first, last;
  };
  static std::size_t directions_of(Op op);

  bool follow(const Arc& arc, int divisions);
  bool evaluate(const Arc& arc);
  bool apply(const Step& step, const Arc& arc);
  /// The operations that make an exponent or keep it. \return whether this is one of them; if so, `known` is what
  /// apply() returns
  bool apply_scaled(const Step& step, const Arc& arc, bool& known);
  bool apply_plain(const Step& step, const Arc& arc);
  void add_scaled(const Step& step, const Arc& arc);
  void start_hyperbolic(const Step& step, const Arc& arc);
  Exponent& exponent_of(const Ball* value) { return exponents_[static_cast<std::size_t>(value - balls_.data())]; }
  /// m exp(v) as a ball.
  Ball whole(const Ball* value);
  /// Turns direction i towards x. \return whether x is known to lie on one side of 0
  bool turn(std::size_t i, const Ball& x, const Arc& arc, const char* what);
  /// x turned back by an even number of quarter turns to where its principal root and logarithm are continuous.
  /// \return that number, halved
  long turn_back(std::size_t i, const Ball& x);
  /// z = log x by the branch that direction i has come to. \return as turn()
  bool set_log(Ball& z, std::size_t i, const Ball& x, const Arc& arc, const char* what);
  bool fails(const char* what);

  std::size_t inputs_;
  std::vector<Ball> balls_;          ///< of each value: inputs, coefficients and constants, results
  std::vector<Exponent> exponents_;  ///< likewise
  std::vector<Step> steps_;
  std::vector<Polynomial> polynomials_;
  std::vector<std::size_t> enclosed_;  ///< the loops of which balls are wanted
  std::vector<const Ball*> outputs_;
  std::vector<Direction> directions_, tried_;
  std::vector<Loop> loops_;  ///< of each value that has one
  std::vector<LoopEnclosure> enclosures_;
  const std::vector<double>* log2_limits_ = nullptr;
  std::string obstacle_;
  Ball t_, u_;
};

}  // namespace hbvm::core
