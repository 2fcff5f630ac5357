#pragma once

#include <cstdint>
#include <vector>

#include "linear/matrix.hpp"
#include "linear/operation_counts.hpp"

namespace hbvm::core {

/// Where an operand stands: among the inputs, the constants or the temporaries.
enum class Bank : std::uint8_t { input, constant, temporary };
struct Operand {
  Bank bank = Bank::constant;
  std::uint32_t index = 0;
};
struct Instruction {
  Op op;
  Operand a, b;
  std::uint32_t result;  // temporary
};

/// Puts results into registers that are free again after their last use, where each had a temporary of its own; what is
/// an output stays. \return how many registers that takes
std::uint32_t reuse_registers(std::vector<Instruction>& code, std::vector<Operand>& outputs);

/// Straight-line code over registers that hold one number per lane (a node of the quadrature, of a body or pair).
/// It has no branches and allocates nothing when it runs.
template <Scalar S>
class Program {
 public:
  Program() = default;
  Program(std::vector<S> constants, std::vector<Instruction> instructions, std::vector<Operand> outputs,
          std::uint32_t temporaries)
      : constants_(std::move(constants)),
        instructions_(std::move(instructions)),
        outputs_(std::move(outputs)),
        temporaries_(temporaries) {}

  const std::vector<S>& constants() const { return constants_; }
  const std::vector<Instruction>& instructions() const { return instructions_; }
  const std::vector<Operand>& output_operands() const { return outputs_; }
  std::uint32_t temporaries() const { return temporaries_; }

  std::size_t outputs() const { return outputs_.size(); }
  /// True if output i does not depend on the inputs.
  bool is_constant(std::size_t i) const { return outputs_[i].bank == Bank::constant; }
  /// Operations per lane.
  OperationCounts operations() const { return operations(0, instructions_.size()); }
  /// Operations per lane of the instructions [first, end).
  OperationCounts operations(std::size_t first, std::size_t end) const;

  /// registers: lanes x temporaries, from make_registers; inputs: one pointer to `lanes` numbers for each input.
  void run(Matrix<S>& registers, const std::vector<const S*>& inputs) const {
    run(registers, inputs, 0, instructions_.size());
  }
  /// The instructions [first, end), after all before.
  void run(Matrix<S>& registers, const std::vector<const S*>& inputs, std::size_t first, std::size_t end) const;
  Matrix<S> make_registers(Index lanes) const { return Matrix<S>(lanes, temporaries_); }
  /// Output i in one lane, after run().
  const S& output(std::size_t i, Index lane, const Matrix<S>& registers, const std::vector<const S*>& inputs) const;

  /// What rounding makes of the outputs, in units of round-off and to first order. It is the sum of |z| |dy/dz| over
  /// all numbers z that are computed on the way to y. The inputs add sizes |dy/dx|, where `sizes` says their own error.
  /// Where y is no sum of terms, this is the size to measure the round-off of y by. Of cos x - 1 near 0 it is 1. (The
  /// accumulated error of Linnainmaa, BIT 16, 1976, by its forward recurrence.) One number for each input.
  std::vector<S> rounding_sizes(const std::vector<S>& inputs, const std::vector<S>& sizes) const;

 private:
  std::vector<S> constants_;
  std::vector<Instruction> instructions_;
  std::vector<Operand> outputs_;
  std::uint32_t temporaries_ = 0;
};

/// The program with its constants rounded to double.
template <Scalar S>
Program<double> in_double(const Program<S>& program);

}  // namespace hbvm::core
