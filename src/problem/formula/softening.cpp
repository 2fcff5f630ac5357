#include "softening.hpp"

namespace hbvm::core {

Program<Mpfr> with_exponents_times(const Mpfr& factor, const Program<Mpfr>& program) {
  std::vector<Mpfr> constants = program.constants();
  const Operand by{Bank::constant, static_cast<std::uint32_t>(constants.size())};
  constants.push_back(factor);
  std::vector<Instruction> code;
  std::vector<Operand> outputs = program.output_operands();
  std::uint32_t temporaries = program.temporaries();
  for (Instruction instruction : program.instructions()) {
    const Op op = instruction.op;
    if (op == Op::exp || op == Op::sinh || op == Op::cosh || op == Op::tanh) {
      code.push_back({Op::multiply, instruction.a, by, temporaries});
      instruction.a = {Bank::temporary, temporaries++};
      outputs.push_back(instruction.a);
    }
    code.push_back(instruction);
  }
  return {std::move(constants), std::move(code), std::move(outputs), temporaries};
}

}  // namespace hbvm::core
