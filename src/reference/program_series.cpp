#include "reference/program_series.hpp"

#include <algorithm>
#include <optional>

#include "hbvm/error.hpp"
#include "scalar/in_place.hpp"
#include "scalar/sine.hpp"

namespace hbvm::core {
namespace {

[[noreturn]] void refuse(const char* what) {
  throw IntegrationError(std::string("the forces have no Taylor series here: ") + what);
}

/// The function whose series comes with that of this one, for sin, cos, sinh and cosh.
std::optional<Op> partner_of(Op op) {
  for (const auto& [function, partner] : {std::pair(Op::sin, Op::cos), std::pair(Op::sinh, Op::cosh)}) {
    if (op == function) return partner;
    if (op == partner) return function;
  }
  return std::nullopt;
}

void start_sine(Mpfr& sine, Mpfr& cosine, const Mpfr& a) {
  if (!has_sine_in_reach(raw(a))) refuse("a sine of a number beyond the reach of its reduction");
  mpfr_sin_cos(raw(sine), raw(cosine), raw(a), MPFR_RNDN);
}

}  // namespace

ProgramSeries::ProgramSeries(const Program<Mpfr>& program, Index inputs, std::vector<const Mpfr*> coefficients,
                             Index order)
    : order_(order), inputs_(inputs) {
  Index count = inputs;
  // Registers serve several values in turn; here each has a series of its own.
  std::vector<Value> registers(program.temporaries());
  const auto value_of = [&](const Operand& x) -> Value {
    if (x.bank == Bank::temporary) return registers[x.index];
    if (x.bank == Bank::constant) return {-1, &program.constants()[x.index]};
    if (static_cast<Index>(x.index) < inputs) return {static_cast<Index>(x.index), nullptr};
    return {-1, coefficients[x.index - static_cast<std::size_t>(inputs)]};
  };
  for (const Instruction& instruction : program.instructions()) {
    Node node{.op = instruction.op, .a = value_of(instruction.a), .b = {}, .z = count++};
    if (is_binary(node.op)) node.b = value_of(instruction.b);
    const std::optional<Op> partner = partner_of(node.op);
    const auto found = std::find_if(nodes_.begin(), nodes_.end(), [&](const Node& x) {
      return x.op == partner && x.a.series == node.a.series && x.a.number == node.a.number && !x.computed;
    });
    if (found != nodes_.end()) {
      node.z = found->other;
      node.computed = true;
    } else if (node.op > Op::sqrt) {
      node.aux = count++;
      if (node.op != Op::exp && node.op != Op::log) node.other = count++;
    }
    registers[instruction.result] = {node.z, nullptr};
    nodes_.push_back(node);
  }
  for (const Operand& output : program.output_operands()) outputs_.push_back(value_of(output));
  values_.assign(static_cast<std::size_t>(count * (order + 1)), Mpfr(0));
  position_.assign(static_cast<std::size_t>(count), -1);
  for (Node& node : nodes_) {
    if (node.computed) continue;
    const bool both = node.op == Op::multiply && node.a.series >= 0 && node.b.series >= 0;
    if (both || node.op == Op::reciprocal || node.op == Op::log || node.op == Op::atan) align(node.a.series);
    if (both) align(node.b.series);
    if (node.op == Op::reciprocal || node.op == Op::sqrt || node.op == Op::exp) align(node.z);
    for (const Index i : {node.aux, node.other}) align(i);
    if (node.other >= 0 && node.op != Op::atan) align(node.z);
    if (both)
      add_convolutions(node, {{0, 0}});
    else if (node.op == Op::sqrt || node.op == Op::log)
      add_convolutions(node, {{1, 1}});
    else if (node.op == Op::atan)
      add_convolutions(node, {{1, 1}, {0, 0}});
    else if (node.op == Op::reciprocal || node.op == Op::exp)
      add_convolutions(node, {{1, 0}});
    else if (node.op == Op::tanh)
      add_convolutions(node, {{1, 0}, {0, 0}});
    else if (node.other >= 0)
      add_convolutions(node, {{1, 0}, {1, 0}});
  }
}

void ProgramSeries::add_convolutions(Node& node, std::initializer_list<std::pair<Index, Index>> from) {
  node.sums = static_cast<Index>(convolutions_.size());
  for (const auto& [a, b] : from) convolutions_.emplace_back(order_ + 1, a, b);
}

void ProgramSeries::align(Index i) {
  if (i < 0 || position_[static_cast<std::size_t>(i)] >= 0) return;
  position_[static_cast<std::size_t>(i)] = static_cast<Index>(aligned_.size());
  aligned_.emplace_back(order_ + 1);
}

void ProgramSeries::keep(Index i, Index n) {
  if (i >= 0 && position_[static_cast<std::size_t>(i)] >= 0) aligned(i).set(n, series(i)[n]);
}

void ProgramSeries::set_convolution(Mpfr& r, Index sums, Index a, Index b, Index n) {
  convolutions_[static_cast<std::size_t>(sums)].set(r, aligned(a), aligned(b), n);
}

void ProgramSeries::set_square(Mpfr& r, Index sums, Index a, Index n, Index first, Mpfr& t) {
  GrowingConvolution& growing = convolutions_[static_cast<std::size_t>(sums)];
  if (growing.by_blocks(n)) return growing.set(r, aligned(a), aligned(a), n);
  hbvm::core::set_convolution(r, aligned(a), aligned(a), n, first, (n + 1) / 2 - 1);  // i < n - i
  mpfr_mul_2ui(raw(r), raw(r), 1, MPFR_RNDN);
  if (n % 2 == 0 && n / 2 >= first) add_product(r, series(a)[n / 2], series(a)[n / 2], t);
}

const Mpfr& ProgramSeries::at(const Value& x, Index n) const {
  if (x.series >= 0) return series(x.series)[n];
  return n == 0 ? *x.number : zero_;
}

const Mpfr& ProgramSeries::output(std::size_t i, Index n) const { return at(outputs_[i], n); }

void ProgramSeries::advance(Index n) {
  for (Index i = 0; i < inputs_; ++i) keep(i, n);
  for (const Node& node : nodes_) {
    if (node.computed) continue;
    if (node.op == Op::multiply)
      multiply(node, n);
    else if (node.op < Op::reciprocal)
      linear(node, n);
    else if (n == 0)
      start(node);
    else
      go_on(node, n);
    if (n == 0) keep(node.aux, 0);
    keep(node.z, n);
    keep(node.other, n);
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
    set_square(z, node.sums, node.a.series, n, 0, t_);
  else
    set_convolution(z, node.sums, node.a.series, node.b.series, n);
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
      start_sine(z, series(node.other)[0], a);
      break;
    case Op::sinh:
      mpfr_sinh_cosh(raw(z), raw(series(node.other)[0]), raw(a), MPFR_RNDN);
      break;
    case Op::cosh:
      mpfr_sinh_cosh(raw(series(node.other)[0]), raw(z), raw(a), MPFR_RNDN);
      break;
    case Op::tanh:
      mpfr_tanh(raw(z), raw(a), MPFR_RNDN);
      set_product(series(node.other)[0], z, z);
      break;
    case Op::atan: {
      mpfr_atan(raw(z), raw(a), MPFR_RNDN);
      Mpfr& w = series(node.other)[0];
      set_product(w, a, a);
      mpfr_add_ui(raw(w), raw(w), 1, MPFR_RNDN);
      break;
    }
    default:
      start_sine(series(node.other)[0], z, a);
      break;
  }
  if (!is_finite(z)) refuse("a value beyond the range of numbers");
}

void ProgramSeries::go_on(const Node& node, Index n) {
  if (node.a.series < 0) return;  // of a number: 0
  const auto whole = static_cast<unsigned long>(n);
  Mpfr* const z = series(node.z);
  const Mpfr& a_n = at(node.a, n);
  // i a_i, and r = sum_{1 <= i <= n} i a_i w_{n-i} / n.
  const auto set_weighted = [&] {
    mpfr_mul_ui(raw(series(node.aux)[n]), raw(a_n), whole, MPFR_RNDN);
    keep(node.aux, n);
  };
  const auto set_integral = [&](Mpfr& r, Index w, Index sums) {
    set_convolution(t_, sums, node.aux, w, n);
    mpfr_div_ui(raw(r), raw(t_), whole, MPFR_RNDN);
  };
  switch (node.op) {
    case Op::reciprocal:
      set_convolution(t_, node.sums, node.a.series, node.z, n);
      set_product(t_, t_, z[0]);
      set_negative(z[n], t_);
      break;
    case Op::sqrt:
      set_square(t_, node.sums, node.z, n, 1, z[n]);
      set_difference(t_, a_n, t_);
      mpfr_div_2ui(raw(t_), raw(t_), 1, MPFR_RNDN);
      set_quotient(z[n], t_, z[0]);
      break;
    case Op::log:
    case Op::atan: {
      // z' w = a', where w is a of the logarithm, and 1 + a^2 of the arc tangent.
      const Index w = node.op == Op::log ? node.a.series : node.other;
      set_convolution(t_, node.sums, node.aux, w, n);
      mpfr_div_ui(raw(t_), raw(t_), whole, MPFR_RNDN);
      set_difference(t_, a_n, t_);
      set_quotient(z[n], t_, series(w)[0]);
      mpfr_mul_ui(raw(series(node.aux)[n]), raw(z[n]), whole, MPFR_RNDN);
      keep(node.aux, n);
      if (node.op == Op::atan) set_square(series(w)[n], node.sums + 1, node.a.series, n, 0, t_);
      break;
    }
    case Op::exp:
      set_weighted();
      set_integral(z[n], node.z, node.sums);
      break;
    case Op::tanh: {
      Mpfr* const square = series(node.other);
      set_weighted();
      set_integral(t_, node.other, node.sums);
      set_difference(z[n], a_n, t_);
      keep(node.z, n);
      set_square(square[n], node.sums + 1, node.z, n, 0, t_);
      break;
    }
    default: {
      set_weighted();
      const bool is_sine = node.op == Op::sin || node.op == Op::sinh;
      const Index sine = is_sine ? node.z : node.other, cosine = is_sine ? node.other : node.z;
      set_integral(series(sine)[n], cosine, node.sums);
      set_integral(series(cosine)[n], sine, node.sums + 1);
      if (node.op == Op::sin || node.op == Op::cos) set_negative(series(cosine)[n], series(cosine)[n]);
      break;
    }
  }
}

}  // namespace hbvm::core
