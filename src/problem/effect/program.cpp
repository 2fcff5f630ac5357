#include "problem/effect/program.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "linear/in_double.hpp"
#include "scalar/in_place.hpp"
#include "scalar/sine.hpp"

namespace hbvm::core {

namespace {

int sine(mpfr_ptr r, mpfr_srcptr a, mpfr_rnd_t to) {
  set_sin(r, a, to);
  return 0;
}
int cosine(mpfr_ptr r, mpfr_srcptr a, mpfr_rnd_t to) {
  set_cos(r, a, to);
  return 0;
}

/// The function of each Op that is one of MPFR; from sinc on it is divided by its operand.
constexpr int (*functions[op_count])(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t) = {
    nullptr,  nullptr,  nullptr,   mpfr_neg,  mpfr_abs,  nullptr,   nullptr, mpfr_sqrt, sine,       cosine,
    mpfr_exp, mpfr_log, mpfr_sinh, mpfr_cosh, mpfr_tanh, mpfr_atan, sine,    mpfr_sinh, mpfr_atanh, mpfr_atan};

/// r = op(a), of one operand. f(a)/a has the limit 1 at 0.
void apply(Op op, Mpfr& r, const Mpfr& a) {
  const auto function = functions[static_cast<std::size_t>(op)];
  if (op == Op::sign) {
    mpfr_set_si(raw(r), mpfr_sgn(raw(a)), MPFR_RNDN);
  } else if (op == Op::reciprocal) {
    mpfr_ui_div(raw(r), 1, raw(a), MPFR_RNDN);
  } else if (op < Op::sinc) {
    function(raw(r), raw(a), MPFR_RNDN);
  } else if (mpfr_zero_p(raw(a)) != 0) {
    mpfr_set_ui(raw(r), 1, MPFR_RNDN);
  } else {
    // r may be a.
    Mpfr& value = scratch<Mpfr>();
    function(raw(value), raw(a), MPFR_RNDN);
    mpfr_div(raw(r), raw(value), raw(a), MPFR_RNDN);
  }
}

template <Scalar S>
S value(Op op, const S& a) {
  using std::atan, std::atanh, std::cos, std::cosh, std::exp, std::log, std::sin, std::sinh, std::sqrt, std::tanh;
  const auto ratio = [&](const S& f) { return a == 0 ? S(1) : S(f / a); };
  switch (op) {
    case Op::negate:
      return -a;
    case Op::abs:
      return magnitude(a);
    case Op::sign:
      return a > 0 ? 1 : a < 0 ? -1 : 0;
    case Op::reciprocal:
      return 1 / a;
    case Op::sqrt:
      return sqrt(a);
    case Op::sin:
      return sin(a);
    case Op::cos:
      return cos(a);
    case Op::exp:
      return exp(a);
    case Op::log:
      return log(a);
    case Op::sinh:
      return sinh(a);
    case Op::cosh:
      return cosh(a);
    case Op::tanh:
      return tanh(a);
    case Op::atan:
      return atan(a);
    case Op::sinc:
      return ratio(sin(a));
    case Op::sinhc:
      return ratio(sinh(a));
    case Op::atanhc:
      return ratio(atanh(a));
    case Op::atanc:
      return ratio(atan(a));
    default:
      return a;
  }
}
template <Scalar S>
void apply(Op op, S& r, const S& a) {
  r = value(op, a);
}

/// |dz/da| of z = op(a).
template <Scalar S>
S slope(Op op, const S& a, const S& z) {
  using std::cos, std::cosh, std::sin, std::sinh;
  // Of f(a)/a.
  const auto of_ratio = [&](const S& slope_of_f) { return a == 0 ? S(0) : magnitude(S((slope_of_f - z) / a)); };
  switch (op) {
    case Op::negate:
    case Op::abs:
      return 1;
    case Op::reciprocal:
      return z * z;
    case Op::sqrt:
      return 1 / (2 * magnitude(z));
    case Op::sin:
      return magnitude(S(cos(a)));
    case Op::cos:
      return magnitude(S(sin(a)));
    case Op::exp:
      return magnitude(z);
    case Op::log:
      return 1 / magnitude(a);
    case Op::sinh:
      return cosh(a);
    case Op::cosh:
      return magnitude(S(sinh(a)));
    case Op::tanh:
      return magnitude(S(1 - z * z));
    case Op::atan:
      return 1 / (1 + a * a);
    case Op::sinc:
      return of_ratio(cos(a));
    case Op::sinhc:
      return of_ratio(cosh(a));
    case Op::atanhc:
      return of_ratio(1 / (1 - a * a));
    case Op::atanc:
      return of_ratio(1 / (1 + a * a));
    default:
      return 0;
  }
}

/// r = f(a, b) in every lane; a constant operand is one number for all.
template <Scalar S, class F>
void binary(Index lanes, S* r, const S* a, bool a_constant, const S* b, bool b_constant, F f) {
  if (a_constant)
    for (Index i = 0; i < lanes; ++i) f(r[i], a[0], b[i]);
  else if (b_constant)
    for (Index i = 0; i < lanes; ++i) f(r[i], a[i], b[0]);
  else
    for (Index i = 0; i < lanes; ++i) f(r[i], a[i], b[i]);
}

/// The numbers of an operand, one for each lane or a constant for all.
template <Scalar S>
const S* address(const Operand& x, const std::vector<S>& constants, const Matrix<S>& registers,
                 const std::vector<const S*>& inputs) {
  if (x.bank == Bank::input) return inputs[x.index];
  if (x.bank == Bank::constant) return &constants[x.index];
  return registers.data() + registers.rows() * x.index;
}

}  // namespace

std::uint32_t reuse_registers(std::vector<Instruction>& code, std::vector<Operand>& outputs) {
  constexpr std::size_t never = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> last_use(code.size(), 0);
  const auto for_each_temporary = [](Instruction& i, auto f) {
    if (i.a.bank == Bank::temporary) f(i.a);
    if (is_binary(i.op) && i.b.bank == Bank::temporary) f(i.b);
  };
  for (std::size_t n = 0; n < code.size(); ++n)
    for_each_temporary(code[n], [&](const Operand& x) { last_use[x.index] = n; });
  for (const Operand& x : outputs)
    if (x.bank == Bank::temporary) last_use[x.index] = never;

  std::vector<std::uint32_t> register_of(code.size()), free_registers;
  std::uint32_t registers = 0;
  for (std::size_t n = 0; n < code.size(); ++n) {
    for_each_temporary(code[n], [&](Operand& x) {
      const std::uint32_t temporary = std::exchange(x.index, register_of[x.index]);
      if (last_use[temporary] != n) return;
      free_registers.push_back(x.index);
      last_use[temporary] = never;  // it may be the other operand, too
    });
    std::uint32_t& target = register_of[code[n].result];
    if (free_registers.empty()) {
      target = registers++;
    } else {
      target = free_registers.back();
      free_registers.pop_back();
    }
    code[n].result = target;
  }
  for (Operand& x : outputs)
    if (x.bank == Bank::temporary) x.index = register_of[x.index];
  return registers;
}

template <Scalar S>
OperationCounts Program<S>::operations(std::size_t first, std::size_t end) const {
  OperationCounts counts{};
  for (std::size_t n = first; n < end; ++n) ++counts[instructions_[n].op];
  return counts;
}

template <Scalar S>
void Program<S>::run(Matrix<S>& registers, const std::vector<const S*>& inputs, std::size_t first,
                     std::size_t end) const {
  const Index lanes = registers.rows();
  for (std::size_t n = first; n < end; ++n) {
    const Instruction& i = instructions_[n];
    S* const r = registers.data() + lanes * i.result;
    const S* const a = address(i.a, constants_, registers, inputs);
    if (!is_binary(i.op)) {
      if (i.op == Op::reciprocal) {
        for (Index lane = 0; lane < lanes; ++lane) apply(Op::reciprocal, r[lane], a[lane]);
      } else if (i.op == Op::sqrt) {
        for (Index lane = 0; lane < lanes; ++lane) apply(Op::sqrt, r[lane], a[lane]);
      } else {
        for (Index lane = 0; lane < lanes; ++lane) apply(i.op, r[lane], a[lane]);
      }
      continue;
    }
    const S* const b = address(i.b, constants_, registers, inputs);
    const bool a_constant = i.a.bank == Bank::constant, b_constant = i.b.bank == Bank::constant;
    // Lambdas rather than function pointers: the loops over lanes are then inlined and vectorised.
    switch (i.op) {
      case Op::add:
        binary(lanes, r, a, a_constant, b, b_constant, [](S& z, const S& x, const S& y) { set_sum(z, x, y); });
        break;
      case Op::subtract:
        binary(lanes, r, a, a_constant, b, b_constant, [](S& z, const S& x, const S& y) { set_difference(z, x, y); });
        break;
      default:
        binary(lanes, r, a, a_constant, b, b_constant, [](S& z, const S& x, const S& y) { set_product(z, x, y); });
        break;
    }
  }
}

template <Scalar S>
const S& Program<S>::output(std::size_t i, Index lane, const Matrix<S>& registers,
                            const std::vector<const S*>& inputs) const {
  const S* const lanes = address(outputs_[i], constants_, registers, inputs);
  return is_constant(i) ? *lanes : lanes[lane];
}

template <Scalar S>
std::vector<S> Program<S>::rounding_sizes(const std::vector<S>& inputs, const std::vector<S>& sizes) const {
  struct Number {
    S value = 0, size = 0;
  };
  std::vector<Number> registers(temporaries_);
  const auto read = [&](const Operand& x) -> Number {
    if (x.bank == Bank::input) return {inputs[x.index], sizes[x.index]};
    if (x.bank == Bank::constant) return {constants_[x.index], magnitude(constants_[x.index])};
    return registers[x.index];
  };
  for (const Instruction& i : instructions_) {
    const Number a = read(i.a), b = is_binary(i.op) ? read(i.b) : Number{};
    Number z;
    switch (i.op) {
      case Op::add:
        z = {a.value + b.value, a.size + b.size};
        break;
      case Op::subtract:
        z = {a.value - b.value, a.size + b.size};
        break;
      case Op::multiply:
        z = {a.value * b.value, magnitude(b.value) * a.size + magnitude(a.value) * b.size};
        break;
      default:
        apply(i.op, z.value, a.value);
        z.size = a.size == 0 ? S(0) : S(slope(i.op, a.value, z.value) * a.size);
    }
    if (i.op != Op::negate && i.op != Op::abs && i.op != Op::sign) z.size += magnitude(z.value);
    registers[i.result] = std::move(z);
  }
  std::vector<S> result;
  for (const Operand& x : outputs_) result.push_back(read(x).size);
  return result;
}

template <Scalar S>
Program<double> in_double(const Program<S>& program) {
  std::vector<double> constants;
  for (const S& value : program.constants()) constants.push_back(approximately(value));
  return {std::move(constants), program.instructions(), program.output_operands(), program.temporaries()};
}

#define HBVM_DEFINE(S)       \
  template class Program<S>; \
  template Program<double> in_double<S>(const Program<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
