#include "ball_effect.hpp"

#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

BallSeries sum_of(const BallSeries& a, const BallSeries& b, int sign) {
  BallSeries result = a;
  if (sign > 0)
    result += b;
  else
    result -= b;
  return result;
}

/// 1, -1 or, where the sign is not known, what is not a number.
RealBall sign_of(const BallSeries& a) {
  const RealBall value = a[0];
  if (value.is_positive()) return 1;
  if ((-value).is_positive()) return -1;
  RealBall unknown;
  arb_indeterminate(raw(unknown));
  return unknown;
}

BallSeries applied(Op op, const BallSeries& a, Index length) {
  const slong bits = BallScope::bits();
  BallSeries z, other;
  switch (op) {
    case Op::negate:
      arb_poly_neg(raw(z), raw(a));
      break;
    case Op::abs:
      return a * sign_of(a);
    case Op::sign:
      return BallSeries(sign_of(a));
    case Op::reciprocal:
      arb_poly_inv_series(raw(z), raw(a), length, bits);
      break;
    case Op::sqrt:
      arb_poly_sqrt_series(raw(z), raw(a), length, bits);
      break;
    case Op::exp:
      arb_poly_exp_series(raw(z), raw(a), length, bits);
      break;
    case Op::log:
      arb_poly_log_series(raw(z), raw(a), length, bits);
      break;
    case Op::sin:
      arb_poly_sin_series(raw(z), raw(a), length, bits);
      break;
    case Op::cos:
      arb_poly_cos_series(raw(z), raw(a), length, bits);
      break;
    case Op::sinh:
      arb_poly_sinh_series(raw(z), raw(a), length, bits);
      break;
    case Op::cosh:
      arb_poly_cosh_series(raw(z), raw(a), length, bits);
      break;
    case Op::tanh:
      arb_poly_sinh_cosh_series(raw(other), raw(z), raw(a), length, bits);
      arb_poly_div_series(raw(z), raw(other), raw(z), length, bits);
      break;
    case Op::atan:
      arb_poly_atan_series(raw(z), raw(a), length, bits);
      break;
    default:
      throw IntegrationError("a force has an operation that has no series of balls");
  }
  return z;
}

}  // namespace

RealBall believed(const Mpfr& x) {
  RealBall ball = exact_ball(raw(x));
  if (mpfr_zero_p(raw(x)) != 0) return ball;
  RealBall unsure = greatest_magnitude(ball);
  arb_mul_2exp_si(raw(unsure), raw(unsure), -3 * static_cast<slong>(mpfr_get_prec(raw(x))) / 4);
  return widened(std::move(ball), unsure);
}

std::vector<RealBall> believed(const Vector<Mpfr>& x) {
  std::vector<RealBall> result;
  for (const Mpfr& value : x) result.push_back(believed(value));
  return result;
}

BallEffect::BallEffect(const Program<Mpfr>& program, const std::vector<Mpfr>& coefficients) : program_(program) {
  for (const Mpfr& x : coefficients) coefficients_.emplace_back(believed(x));
  for (const Mpfr& x : program.constants()) constants_.emplace_back(believed(x));
}

std::vector<BallSeries> BallEffect::outputs(const std::vector<BallSeries>& inputs, Index length) const {
  std::vector<BallSeries> registers(program_.temporaries());
  const auto value_of = [&](const Operand& x) -> const BallSeries& {
    if (x.bank == Bank::temporary) return registers[x.index];
    if (x.bank == Bank::constant) return constants_[x.index];
    return x.index < inputs.size() ? inputs[x.index] : coefficients_[x.index - inputs.size()];
  };
  for (const Instruction& instruction : program_.instructions()) {
    const Op op = instruction.op;
    const BallSeries& a = value_of(instruction.a);
    BallSeries z;
    if (op == Op::add || op == Op::subtract)
      z = sum_of(a, value_of(instruction.b), op == Op::add ? 1 : -1);
    else if (op == Op::multiply)
      z = a.times(value_of(instruction.b), length);
    else
      z = applied(op, a, length);
    registers[instruction.result] = std::move(z);
  }
  std::vector<BallSeries> result;
  for (const Operand& output : program_.output_operands()) result.push_back(value_of(output).shortened(length));
  return result;
}

}  // namespace hbvm::core
