#include "ball_program.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

namespace hbvm::core {
namespace {

constexpr slong bits = Ball::bits;

/// The degree of what is not computed as a loop.
constexpr int none = 3;

/// Of the result of an operation on values of such degrees; `none` or more if it is not computed as a loop.
int degree(Op op, int a, int b) {
  if (op == Op::add || op == Op::subtract) return std::max(a, b);
  if (op == Op::negate) return a;
  return op == Op::multiply ? a + b : none;
}

/// Whether Re x > 1, so that exp(x) is more than what is added to it.
bool is_large(const Ball& x) {
  Ball less;
  acb_sub_ui(raw(less), raw(x), 1, bits);
  return arb_is_positive(less.real()) != 0;
}

}  // namespace

std::size_t BallProgram::directions_of(Op op) {
  if (op == Op::atan) return 2;
  constexpr Op of_one[] = {Op::reciprocal, Op::sqrt, Op::log, Op::tanh, Op::abs, Op::sign};
  return std::ranges::count(of_one, op) > 0 ? 1 : 0;
}

BallProgram::BallProgram(const Program<Mpfr>& program, Index inputs, const std::vector<const Mpfr*>& coefficients)
    : inputs_(static_cast<std::size_t>(inputs)) {
  const std::size_t constants = inputs_ + coefficients.size(), results = constants + program.constants().size();
  const std::size_t values = results + program.instructions().size();
  balls_.resize(inputs_);
  for (const Mpfr* x : coefficients) balls_.emplace_back(*x);
  for (const Mpfr& x : program.constants()) balls_.emplace_back(x);
  balls_.resize(values);
  exponents_.resize(values);
  loops_.resize(values, Loop(Mpfr(0)));
  for (std::size_t i = inputs_; i < results; ++i)
    loops_[i] = Loop(i < constants ? *coefficients[i - inputs_] : program.constants()[i - constants]);
  // Of each value its degree in the inputs, where a loop is made of it.
  std::vector<int> degrees(values, none);
  std::fill_n(degrees.begin(), inputs_, 1);
  std::fill(degrees.begin() + static_cast<std::ptrdiff_t>(inputs_),
            degrees.begin() + static_cast<std::ptrdiff_t>(results), 0);
  // Registers serve several values in turn; here each has a ball of its own.
  std::vector<std::size_t> registers(program.temporaries());
  const auto value_of = [&](const Operand& x) {
    return x.bank == Bank::input ? x.index : x.bank == Bank::constant ? constants + x.index : registers[x.index];
  };
  std::vector<bool> wanted(values, false);
  const auto ball = [&](std::size_t value) {
    wanted[value] = true;
    return &balls_[value];
  };
  std::size_t z = results;
  for (const Instruction& instruction : program.instructions()) {
    const std::size_t a = value_of(instruction.a), b = is_binary(instruction.op) ? value_of(instruction.b) : a;
    degrees[z] = degree(instruction.op, degrees[a], degrees[b]);
    if (degrees[z] < none) {
      polynomials_.push_back({instruction.op, a, b, z});
    } else {
      steps_.push_back({instruction.op, ball(a), ball(b), &balls_[z], directions_.size()});
      directions_.resize(directions_.size() + directions_of(instruction.op));
    }
    registers[instruction.result] = z++;
  }
  for (const Operand& output : program.output_operands()) outputs_.push_back(ball(value_of(output)));
  for (std::size_t i = 0; i < values; ++i)
    if (wanted[i] && degrees[i] < none && (i < inputs_ || i >= results)) enclosed_.push_back(i);
}

bool BallProgram::is_bounded(const std::vector<Loop>& inputs, const std::vector<double>& log2_limits) {
  std::copy(inputs.begin(), inputs.end(), loops_.begin());
  for (const auto& [op, a, b, z] : polynomials_)
    loops_[z] = op == Op::add        ? loops_[a] + loops_[b]
                : op == Op::subtract ? loops_[a] - loops_[b]
                : op == Op::multiply ? loops_[a] * loops_[b]
                                     : -loops_[a];
  enclosures_.clear();
  for (const std::size_t i : enclosed_) enclosures_.emplace_back(loops_[i]);
  log2_limits_ = &log2_limits;
  constexpr int arcs = 8;
  constexpr double width = std::numbers::pi / arcs;
  for (int n = 0; n < arcs; ++n)
    if (!follow({(2 * n + 1) * width / 2, width / 2, n == 0, n + 1 == arcs}, 0)) return false;
  // The lower half of the curve turns as far again.
  for (const Direction& direction : directions_)
    if (direction.quarters != direction.first) return fails(direction.singularity);
  return true;
}

bool BallProgram::follow(const Arc& arc, int divisions) {
  if (evaluate(arc)) {
    directions_ = tried_;
    return true;
  }
  constexpr int most_divisions = 6;
  if (divisions == most_divisions) return false;
  const double half = arc.half_width / 2;
  return follow({arc.middle - half, half, arc.first, false}, divisions + 1) &&
         follow({arc.middle + half, half, false, arc.last}, divisions + 1);
}

bool BallProgram::evaluate(const Arc& arc) {
  // The arc is a little wider than its angles in double.
  const double half_width = arc.half_width * (1 + 16 * std::numeric_limits<double>::epsilon());
  const std::complex<double> at = std::polar(double{1}, arc.middle);
  for (std::size_t i = 0; i < enclosed_.size(); ++i) enclosures_[i].enclose(at, half_width, balls_[enclosed_[i]]);
  tried_ = directions_;
  for (const Step& step : steps_)
    if (!apply(step, arc)) return false;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const Ball output = whole(outputs_[i]);
    if (!output.is_finite()) return fails("a value beyond all bounds");
    if (!(output.log2_size() <= (*log2_limits_)[i])) return fails("a force that changes too much");
  }
  return true;
}

bool BallProgram::fails(const char* what) {
  obstacle_ = what;
  return false;
}

bool BallProgram::turn(std::size_t i, const Ball& x, const Arc& arc, const char* what) {
  Direction& direction = tried_[i];
  const auto lies = [&x](long quarters) {
    const arb_srcptr part = quarters % 2 == 0 ? x.real() : x.imaginary();
    return (((quarters % 4) + 4) % 4 < 2 ? arb_is_positive(part) : arb_is_negative(part)) != 0;
  };
  if (arc.first) {
    // Where the curve begins all is real.
    for (const long quarters : {0, 2})
      if (lies(quarters)) {
        direction = {quarters, quarters, what};
        return true;
      }
    return fails(what);
  }
  // It shares a point with the arc before, so that it is at most one quarter turn on. If that is not decided, it is as
  // far back as may be.
  if (std::abs(direction.first - direction.quarters) == 1 && lies(direction.first)) {
    direction.quarters = direction.first;
    return true;
  }
  for (const long turned : {0, 1, -1})
    if (lies(direction.quarters + turned)) {
      direction.quarters += turned;
      return true;
    }
  return fails(what);
}

long BallProgram::turn_back(std::size_t i, const Ball& x) {
  const long quarters = tried_[i].quarters, even = quarters - (((quarters % 2) + 2) % 2);
  if (((even % 4) + 4) % 4 == 0)
    acb_set(raw(t_), raw(x));
  else
    acb_neg(raw(t_), raw(x));
  return even / 2;
}

bool BallProgram::set_log(Ball& z, std::size_t i, const Ball& x, const Arc& arc, const char* what) {
  if (!turn(i, x, arc, what)) return false;
  const long half_turns = turn_back(i, x);
  acb_log(raw(z), raw(t_), bits);
  if (half_turns == 0) return true;
  Ball pi;
  arb_const_pi(acb_realref(raw(pi)), bits);
  arb_addmul_si(acb_imagref(raw(z)), acb_realref(raw(pi)), half_turns, bits);
  return true;
}

Ball BallProgram::whole(const Ball* value) {
  Ball result = *value;
  const Exponent& exponent = exponent_of(value);
  if (!exponent.there) return result;
  Ball power;
  acb_exp(raw(power), raw(exponent.v), bits);
  acb_mul(raw(result), raw(result), raw(power), bits);
  return result;
}

void BallProgram::add_scaled(const Step& step, const Arc& arc) {
  const Exponent &a = exponent_of(step.a), &b = exponent_of(step.b);
  Exponent& z = exponent_of(step.z);
  const auto sum = [&](const Ball& x, const Ball& y) {
    (step.op == Op::add ? acb_add : acb_sub)(raw(*step.z), raw(x), raw(y), bits);
  };
  Ball apart;  // of the exponents
  acb_sub(raw(apart), raw(a.v), raw(b.v), bits);
  const bool alike = a.there && b.there && a.of != nullptr && a.of == b.of && a.sign == b.sign;
  if (arc.first) {
    Ball opposite;
    acb_neg(raw(opposite), raw(apart));
    z.first_is_greater = a.there && (alike || is_large(apart));
    z.there = z.first_is_greater || (b.there && is_large(opposite));
    const Exponent& greater = z.first_is_greater ? a : b;
    z.of = greater.of;
    z.sign = greater.sign;
  }
  if (!z.there) {
    acb_zero(raw(z.v));
    sum(whole(step.a), whole(step.b));
    return;
  }
  acb_set(raw(z.v), raw(z.first_is_greater ? a.v : b.v));
  if (alike) {
    sum(*step.a, *step.b);
    return;
  }
  if (z.first_is_greater) acb_neg(raw(apart), raw(apart));
  acb_exp(raw(apart), raw(apart), bits);
  Ball other = z.first_is_greater ? *step.b : *step.a;
  acb_mul(raw(other), raw(other), raw(apart), bits);
  if (z.first_is_greater)
    sum(*step.a, other);
  else
    sum(other, *step.b);
}

void BallProgram::start_hyperbolic(const Step& step, const Arc& arc) {
  Exponent& z = exponent_of(step.z);
  const Ball a = whole(step.a);
  if (arc.first) {
    Ball opposite;
    acb_neg(raw(opposite), raw(a));
    z.sign = is_large(opposite) ? -1 : 1;
    z.there = z.sign < 0 || is_large(a);
    z.of = exponent_of(step.a).there ? nullptr : step.a;
  }
  if (!z.there) {
    acb_zero(raw(z.v));
    (step.op == Op::cosh ? acb_cosh : acb_sinh)(raw(*step.z), raw(a), bits);
    return;
  }
  // cosh a = exp(sign a) (1 + exp(-2 sign a))/2; sinh a likewise.
  acb_mul_si(raw(z.v), raw(a), z.sign, bits);
  acb_mul_si(raw(t_), raw(z.v), -2, bits);
  acb_exp(raw(t_), raw(t_), bits);
  if (step.op == Op::sinh) acb_neg(raw(t_), raw(t_));
  acb_add_ui(raw(t_), raw(t_), 1, bits);
  if (step.op == Op::sinh) acb_mul_si(raw(t_), raw(t_), z.sign, bits);
  acb_mul_2exp_si(raw(*step.z), raw(t_), -1);
}

bool BallProgram::apply_scaled(const Step& step, const Arc& arc, bool& known) {
  const Exponent& a = exponent_of(step.a);
  Exponent& z = exponent_of(step.z);
  known = true;
  if (step.op == Op::exp) {
    z.there = true;
    z.sign = 1;
    z.of = a.there ? nullptr : step.a;
    acb_set(raw(z.v), raw(whole(step.a)));
    acb_one(raw(*step.z));
    return true;
  }
  if (step.op == Op::cosh || step.op == Op::sinh) {
    start_hyperbolic(step, arc);
    return true;
  }
  const bool binary = is_binary(step.op);
  if (!a.there && !(binary && exponent_of(step.b).there)) {
    z.there = false;
    acb_zero(raw(z.v));
    return false;
  }
  // What keeps the exponent of its argument, times 1, -1 or 1/2.
  const auto keep = [&](int sign) {
    z.there = true;
    z.of = a.of;
    z.sign = sign * a.sign;
    acb_mul_si(raw(z.v), raw(a.v), sign, bits);
  };
  switch (step.op) {
    case Op::add:
    case Op::subtract:
      add_scaled(step, arc);
      return true;
    case Op::multiply: {
      const Exponent& b = exponent_of(step.b);
      z.there = true;
      z.of = a.there && b.there ? nullptr : a.there ? a.of : b.of;
      z.sign = a.there ? a.sign : b.sign;
      if (a.there && b.there)
        acb_add(raw(z.v), raw(a.v), raw(b.v), bits);
      else
        acb_set(raw(z.v), raw(a.there ? a.v : b.v));
      acb_mul(raw(*step.z), raw(*step.a), raw(*step.b), bits);
      return true;
    }
    case Op::negate:
      keep(1);
      acb_neg(raw(*step.z), raw(*step.a));
      return true;
    case Op::reciprocal:
      known = turn(step.direction, *step.a, arc, "a division by 0");
      if (!known) return true;
      keep(-1);
      acb_inv(raw(*step.z), raw(*step.a), bits);
      return true;
    default: {
      // Of what has no rule of its own the argument is one ball.
      z.there = false;
      acb_zero(raw(z.v));
      const Ball argument = whole(step.a);
      Step plain = step;
      plain.a = &argument;
      known = apply_plain(plain, arc);
      return true;
    }
  }
}

bool BallProgram::apply(const Step& step, const Arc& arc) {
  bool known = true;
  return apply_scaled(step, arc, known) ? known : apply_plain(step, arc);
}

bool BallProgram::apply_plain(const Step& step, const Arc& arc) {
  const acb_srcptr a = raw(*step.a);
  const acb_ptr z = raw(*step.z);
  switch (step.op) {
    case Op::add:
      acb_add(z, a, raw(*step.b), bits);
      return true;
    case Op::subtract:
      acb_sub(z, a, raw(*step.b), bits);
      return true;
    case Op::multiply:
      acb_mul(z, a, raw(*step.b), bits);
      return true;
    case Op::negate:
      acb_neg(z, a);
      return true;
    case Op::reciprocal:
      if (!turn(step.direction, *step.a, arc, "a division by 0")) return false;
      acb_inv(z, a, bits);
      return true;
    case Op::sqrt: {
      if (!turn(step.direction, *step.a, arc, "a square root of 0")) return false;
      const long half_turns = turn_back(step.direction, *step.a);
      acb_sqrt(z, raw(t_), bits);
      // i for each half turn.
      for (long n = ((half_turns % 4) + 4) % 4; n > 0; --n) acb_mul_onei(z, z);
      return true;
    }
    case Op::log:
      return set_log(*step.z, step.direction, *step.a, arc, "a logarithm of 0");
    case Op::sin:
      acb_sin(z, a, bits);
      return true;
    case Op::cos:
      acb_cos(z, a, bits);
      return true;
    case Op::tanh:
      // Its poles are the zeros of 1 + exp(-2 a), and of 1 + exp(2 a).
      if (arc.first) exponent_of(step.z).sign = arb_is_negative(step.a->real()) != 0 ? -1 : 1;
      acb_mul_si(raw(u_), a, exponent_of(step.z).sign * -2, bits);
      acb_exp(raw(u_), raw(u_), bits);
      acb_add_ui(raw(u_), raw(u_), 1, bits);
      if (!turn(step.direction, u_, arc, "a pole of tanh")) return false;
      acb_tanh(z, a, bits);
      return true;
    case Op::atan: {
      // (log(1 + i a) - log(1 - i a)) / 2i, both continued from the positive real axis.
      Ball logarithms[2];
      for (const std::size_t side : {0, 1}) {
        Ball w;
        acb_mul_onei(raw(w), a);
        if (side == 1) acb_neg(raw(w), raw(w));
        acb_add_ui(raw(w), raw(w), 1, bits);
        if (!set_log(logarithms[side], step.direction + side, w, arc, "a branch point of atan")) return false;
      }
      acb_sub(z, raw(logarithms[0]), raw(logarithms[1]), bits);
      acb_div_onei(z, z);
      acb_mul_2exp_si(z, z, -1);
      return true;
    }
    case Op::abs:
    case Op::sign: {
      // Analytic where it keeps its sign: plus or minus its argument.
      if (!turn(step.direction, *step.a, arc, "a magnitude at 0")) return false;
      const bool negative = tried_[step.direction].first != 0;
      if (step.op == Op::sign)
        acb_set_si(z, negative ? -1 : 1);
      else if (negative)
        acb_neg(z, a);
      else
        acb_set(z, a);
      return true;
    }
    default:
      return fails("an operation without bounds");
  }
}

}  // namespace hbvm::core
