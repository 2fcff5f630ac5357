#include "hbvm/reference/program_series.hpp"

#include <algorithm>

#include "hbvm/error.hpp"
#include "hbvm/linear/product.hpp"
#include "hbvm/scalar/in_place.hpp"

namespace hbvm {
namespace {

[[noreturn]] void refuse(const char* what) {
  throw IntegrationError(std::string("the forces have no Taylor series here: ") + what);
}

/// r = sum_{first <= i <= last} a_i b_{n-i}.
void set_convolution(Mpfr& r, const Mpfr* a, const Mpfr* b, Index n, Index first, Index last) {
  set_dot(r, a + first, 1, b + n - first, -1, last - first + 1);
}

/// r = sum_{first <= i <= n - first} a_i a_{n-i}: equal terms once.
void set_square(Mpfr& r, const Mpfr* a, Index n, Index first, Mpfr& t) {
  const Index pairs = (n + 1) / 2 - first;  // i < n - i
  if (pairs > 0)
    set_convolution(r, a, a, n, first, first + pairs - 1);
  else
    set_zero(r);
  mpfr_mul_2ui(raw(r), raw(r), 1, MPFR_RNDN);
  if (n % 2 == 0 && n / 2 >= first) add_product(r, a[n / 2], a[n / 2], t);
}

}  // namespace

ProgramSeries::ProgramSeries(const Program<Mpfr>& program, Index inputs, std::vector<const Mpfr*> coefficients,
                             Index order)
    : order_(order) {
  Index count = inputs;
  // Registers serve several values in turn; here each has a series of its own.
  std::vector<Value> registers(program.temporaries());
  const auto value_of = [&](const Operand& x) -> Value {
    switch (x.bank) {
      case Bank::input:
        if (static_cast<Index>(x.index) < inputs) return {static_cast<Index>(x.index), nullptr};
        return {-1, coefficients[x.index - static_cast<std::size_t>(inputs)]};
      case Bank::constant:
        return {-1, &program.constants()[x.index]};
      case Bank::temporary:
        break;
    }
    return registers[x.index];
  };
  for (const Instruction& instruction : program.instructions()) {
    Node node{.op = instruction.op, .a = value_of(instruction.a), .b = {}, .z = count++};
    if (is_binary(node.op)) node.b = value_of(instruction.b);
    if (node.op == Op::exp || node.op == Op::log) node.aux = count++;
    if (node.op == Op::sin || node.op == Op::cos) {
      const Op partner = node.op == Op::sin ? Op::cos : Op::sin;
      const auto found = std::find_if(nodes_.begin(), nodes_.end(), [&](const Node& x) {
        return x.op == partner && x.a.series == node.a.series && x.a.number == node.a.number && !x.computed;
      });
      if (found != nodes_.end()) {
        node.z = found->other;
        node.computed = true;
      } else {
        node.aux = count++;
        node.other = count++;
      }
    }
    registers[instruction.result] = {node.z, nullptr};
    nodes_.push_back(node);
  }
  for (const Operand& output : program.output_operands()) outputs_.push_back(value_of(output));
  values_.assign(static_cast<std::size_t>(count * (order + 1)), Mpfr(0));
}

const Mpfr& ProgramSeries::at(const Value& x, Index n) const {
  if (x.series >= 0) return series(x.series)[n];
  return n == 0 ? *x.number : zero_;
}

const Mpfr& ProgramSeries::output(std::size_t i, Index n) const { return at(outputs_[i], n); }

void ProgramSeries::advance(Index n) {
  for (const Node& node : nodes_) {
    if (node.computed) continue;
    switch (node.op) {
      case Op::add:
      case Op::subtract:
      case Op::negate:
      case Op::abs:
      case Op::sign:
        linear(node, n);
        break;
      case Op::multiply:
        multiply(node, n);
        break;
      default:
        if (n == 0)
          start(node);
        else
          go_on(node, n);
        break;
    }
  }
}

void ProgramSeries::linear(const Node& node, Index n) {
  Mpfr& z = series(node.z)[n];
  const Mpfr& a = at(node.a, n);
  if (node.op == Op::add) return set_sum(z, a, at(node.b, n));
  if (node.op == Op::subtract) return set_difference(z, a, at(node.b, n));
  if (node.op == Op::negate) return set_negative(z, a);
  const int sign = mpfr_sgn(raw(at(node.a, 0)));
  if (sign == 0) refuse("a magnitude at 0");
  if (node.op == Op::sign)
    mpfr_set_si(raw(z), n == 0 ? sign : 0, MPFR_RNDN);
  else if (sign > 0)
    set(z, a);
  else
    set_negative(z, a);
}

void ProgramSeries::multiply(const Node& node, Index n) {
  Mpfr& z = series(node.z)[n];
  if (node.a.series < 0 || node.b.series < 0) {
    const Value& number = node.a.series < 0 ? node.a : node.b;
    const Value& varying = node.a.series < 0 ? node.b : node.a;
    return set_product(z, *(number.number ? number.number : &at(number, 0)), at(varying, n));
  }
  if (node.a.series == node.b.series)
    set_square(z, series(node.a.series), n, 0, t_);
  else
    set_convolution(z, series(node.a.series), series(node.b.series), n, 0, n);
}

void ProgramSeries::start(const Node& node) {
  const Mpfr& a = at(node.a, 0);
  Mpfr& z = series(node.z)[0];
  switch (node.op) {
    case Op::reciprocal:
      if (a == 0) refuse("a division by 0");
      mpfr_ui_div(raw(z), 1, raw(a), MPFR_RNDN);
      break;
    case Op::sqrt:
      if (!(a > 0)) refuse("a square root of what is not positive");
      mpfr_sqrt(raw(z), raw(a), MPFR_RNDN);
      break;
    case Op::exp:
      mpfr_exp(raw(z), raw(a), MPFR_RNDN);
      break;
    case Op::log:
      if (!(a > 0)) refuse("a logarithm of what is not positive");
      mpfr_log(raw(z), raw(a), MPFR_RNDN);
      break;
    case Op::sin:
      mpfr_sin_cos(raw(z), raw(series(node.other)[0]), raw(a), MPFR_RNDN);
      break;
    default:
      mpfr_sin_cos(raw(series(node.other)[0]), raw(z), raw(a), MPFR_RNDN);
      break;
  }
  if (!is_finite(z)) refuse("a value beyond the range of numbers");
}

void ProgramSeries::go_on(const Node& node, Index n) {
  const auto whole = static_cast<unsigned long>(n);
  Mpfr* const z = series(node.z);
  const Mpfr& a_n = at(node.a, n);
  switch (node.op) {
    case Op::reciprocal:
      set_convolution(t_, series(node.a.series), z, n, 1, n);
      set_product(t_, t_, z[0]);
      set_negative(z[n], t_);
      break;
    case Op::sqrt:
      set_square(t_, z, n, 1, z[n]);
      set_difference(t_, a_n, t_);
      mpfr_div_2ui(raw(t_), raw(t_), 1, MPFR_RNDN);
      set_quotient(z[n], t_, z[0]);
      break;
    case Op::log: {
      Mpfr* const weighted = series(node.aux);
      set_convolution(t_, weighted, series(node.a.series), n, 1, n - 1);
      mpfr_div_ui(raw(t_), raw(t_), whole, MPFR_RNDN);
      set_difference(t_, a_n, t_);
      set_quotient(z[n], t_, at(node.a, 0));
      mpfr_mul_ui(raw(weighted[n]), raw(z[n]), whole, MPFR_RNDN);
      break;
    }
    case Op::exp: {
      Mpfr* const weighted = series(node.aux);
      mpfr_mul_ui(raw(weighted[n]), raw(a_n), whole, MPFR_RNDN);
      set_convolution(t_, weighted, z, n, 1, n);
      mpfr_div_ui(raw(z[n]), raw(t_), whole, MPFR_RNDN);
      break;
    }
    default: {
      Mpfr* const weighted = series(node.aux);
      Mpfr* const other = series(node.other);
      mpfr_mul_ui(raw(weighted[n]), raw(a_n), whole, MPFR_RNDN);
      Mpfr* const sine = node.op == Op::sin ? z : other;
      Mpfr* const cosine = node.op == Op::sin ? other : z;
      set_convolution(t_, weighted, cosine, n, 1, n);
      mpfr_div_ui(raw(sine[n]), raw(t_), whole, MPFR_RNDN);
      set_convolution(t_, weighted, sine, n, 1, n);
      set_negative(t_, t_);
      mpfr_div_ui(raw(cosine[n]), raw(t_), whole, MPFR_RNDN);
      break;
    }
  }
}

}  // namespace hbvm
