#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "hbvm/error.hpp"
#include "problem/effect/kernel.hpp"

namespace hbvm::core {
namespace {

class Printer {
 public:
  Printer(const Program<double>& program, Index dimension)
      : program_(program), dimension_(static_cast<std::uint32_t>(dimension)) {}

  std::string text() const {
    std::string text;
    for (std::uint32_t i = 0; i < program_.temporaries(); ++i) text += fmt::format("double t{};\n", i);
    for (const auto& i : program_.instructions()) text += statement(i);
    return text + outputs();
  }

  std::string steps() const {
    const std::vector<Instruction>& code = program_.instructions();
    std::string text;
    std::size_t begin = 0;
    for (std::size_t n = 0; n < code.size(); ++n) {
      if (!is_call(code[n].op)) continue;
      if (code[n].a.bank != Bank::temporary) return "";
      text += step(begin, n);
      text += fmt::format("for (Index i = 0; i < lanes; ++i) t[{}][i] = std::{}(t[{}][i]);\n", code[n].result,
                          name_of(code[n].op), code[n].a.index);
      begin = n + 1;
    }
    return begin == 0 ? "" : text + step(begin, code.size());
  }

 private:
  /// Whether it is a function of the library, which the compiler does not do in several lanes at a time.
  static bool is_call(Op op) { return op > Op::sqrt; }

  std::string statement(const Instruction& i) const { return fmt::format("t{} = {};\n", i.result, operation(i)); }
  std::string outputs() const {
    std::string text;
    for (std::size_t i = 0; i < program_.outputs(); ++i)
      text += fmt::format("g[{}] = {};\n", i, operand(program_.output_operands()[i]));
    return text;
  }

  /// A loop over the lanes that does the instructions [begin, end), and after the last of all hands over the gradient.
  /// Temporaries that another step has written are read from t, those that another one reads are written there.
  std::string step(std::size_t begin, std::size_t end) const {
    const std::vector<Instruction>& code = program_.instructions();
    const bool is_last = end == code.size();
    std::string declared, statements, kept;
    std::set<std::uint32_t> known;
    const auto read = [&](const Operand& x) {
      if (x.bank == Bank::temporary && known.insert(x.index).second)
        declared += fmt::format("double t{0} = t[{0}][i];\n", x.index);
    };
    std::set<std::uint32_t> written;
    for (std::size_t n = begin; n < end; ++n) {
      read(code[n].a);
      if (is_binary(code[n].op)) read(code[n].b);
      if (known.insert(code[n].result).second) declared += fmt::format("double t{};\n", code[n].result);
      written.insert(code[n].result);
      statements += statement(code[n]);
    }
    if (is_last)
      for (const Operand& x : program_.output_operands()) read(x);
    for (const std::uint32_t temporary : written)
      if (!is_last && is_read(temporary, end)) kept += fmt::format("t[{0}][i] = t{0};\n", temporary);
    return fmt::format(
        "for_each_lane(lanes, [&](Index i) {{\n[[maybe_unused]] double x[{}];\nx_of(i, x);\n{}{}{}}});\n", dimension_,
        declared, statements,
        is_last ? fmt::format("double g[{}];\n{}add(i, g);\n", program_.outputs(), outputs()) : kept);
  }

  /// Whether the value of a temporary is read from instruction `begin` on, before another one takes its place.
  bool is_read(std::uint32_t temporary, std::size_t begin) const {
    const auto is_it = [&](const Operand& x) { return x.bank == Bank::temporary && x.index == temporary; };
    for (std::size_t n = begin; n < program_.instructions().size(); ++n) {
      const Instruction& i = program_.instructions()[n];
      if (is_it(i.a) || (is_binary(i.op) && is_it(i.b))) return true;
      if (i.result == temporary) return false;
    }
    return std::any_of(program_.output_operands().begin(), program_.output_operands().end(), is_it);
  }

  std::string operand(const Operand& x) const {
    if (x.bank == Bank::constant) return fmt::format("{:a}", program_.constants()[x.index]);
    if (x.bank == Bank::temporary) return fmt::format("t{}", x.index);
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
      default:
        if (i.op >= Op::sinc) throw Error(std::string("no kernel is printed of ") + name_of(i.op));
        return fmt::format("std::{}({})", name_of(i.op), a);
    }
  }

  const Program<double>& program_;
  std::uint32_t dimension_;
};

}  // namespace

std::string cpp_text(const Program<double>& program, Index dimension) { return Printer(program, dimension).text(); }

std::string cpp_steps(const Program<double>& program, Index dimension) { return Printer(program, dimension).steps(); }

}  // namespace hbvm::core
