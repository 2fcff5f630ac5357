#include <fmt/format.h>

#include "hbvm/error.hpp"
#include "hbvm/problem/effect/kernel.hpp"

namespace hbvm {
namespace {

class Printer {
 public:
  Printer(const Program<double>& program, Index dimension)
      : program_(program), dimension_(static_cast<std::uint32_t>(dimension)) {}

  std::string text() const {
    std::string text;
    for (std::uint32_t i = 0; i < program_.temporaries(); ++i) text += fmt::format("double t{};\n", i);
    for (const auto& i : program_.instructions()) text += fmt::format("t{} = {};\n", i.result, operation(i));
    for (std::size_t i = 0; i < program_.outputs(); ++i)
      text += fmt::format("g[{}] = {};\n", i, operand(program_.output_operands()[i]));
    return text;
  }

 private:
  std::string operand(const Operand& x) const {
    switch (x.bank) {
      case Bank::constant:
        return fmt::format("{:a}", program_.constants()[x.index]);
      case Bank::temporary:
        return fmt::format("t{}", x.index);
      case Bank::input:
        break;
    }
    return x.index < dimension_ ? fmt::format("x[{}]", x.index) : fmt::format("c[{}]", x.index - dimension_);
  }

  std::string operation(const Instruction& i) const {
    const std::string a = operand(i.a);
    switch (i.op) {
      case Op::add:
        return a + " + " + operand(i.b);
      case Op::subtract:
        return a + " - " + operand(i.b);
      case Op::multiply:
        return a + " * " + operand(i.b);
      case Op::negate:
        return "-" + a;
      case Op::sign:
        return fmt::format("{0} > 0 ? 1 : {0} < 0 ? -1 : 0", a);
      case Op::reciprocal:
        return "1 / " + a;
      case Op::abs:
      case Op::sqrt:
      case Op::sin:
      case Op::cos:
      case Op::exp:
      case Op::log:
      case Op::sinh:
      case Op::cosh:
      case Op::tanh:
      case Op::atan:
        break;
      case Op::sinc:
      case Op::sinhc:
      case Op::atanhc:
      case Op::atanc:
        throw Error(std::string("no kernel is printed of ") + name_of(i.op));
    }
    return fmt::format("std::{}({})", name_of(i.op), a);
  }

  const Program<double>& program_;
  std::uint32_t dimension_;
};

}  // namespace

std::string cpp_text(const Program<double>& program, Index dimension) { return Printer(program, dimension).text(); }

}  // namespace hbvm
