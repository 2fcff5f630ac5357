#pragma once

#include "problem/effect/program.hpp"

namespace hbvm::core {

/// A program of an effect with the registers to run it for all its bodies or pairs at once, in `lanes` lanes each.
/// Instances come one after another, as the displacements stand that it reads.
template <Scalar S>
class Execution {
 public:
  /// displacement: (instances * lanes) x d, per_instance: instances x coefficients. The program and the displacement
  /// must outlive it.
  Execution(const Program<S>& code, const Matrix<S>& per_instance, const Matrix<S>& displacement, Index lanes)
      : program_(&code),
        coefficients_(displacement.rows(), per_instance.cols()),
        registers_(code.make_registers(displacement.rows())) {
    for (Index j = 0; j < coefficients_.cols(); ++j)
      for (Index i = 0; i < coefficients_.rows(); ++i) coefficients_(i, j) = per_instance(i / lanes, j);
    for (const Matrix<S>* columns : {&displacement, &std::as_const(coefficients_)})
      for (Index j = 0; j < columns->cols(); ++j) inputs_.push_back(columns->data() + j * columns->rows());
  }
  Execution(const Execution&) = delete;
  Execution& operator=(const Execution&) = delete;

  void run() { program_->run(registers_, inputs_); }
  /// Its instructions [first, end), after all before.
  void run(std::size_t first, std::size_t end) { program_->run(registers_, inputs_, first, end); }
  const S& output(Index i, Index lane) const {
    return program_->output(static_cast<std::size_t>(i), lane, registers_, inputs_);
  }

 private:
  const Program<S>* program_;
  Matrix<S> coefficients_, registers_;
  std::vector<const S*> inputs_;
};

/// The outputs of a program, a row for each row of inputs x and of coefficients.
template <Scalar S>
Matrix<S> outputs_of(const Program<S>& code, const Matrix<S>& per_instance, const Matrix<S>& x) {
  Execution<S> execution(code, per_instance, x, 1);
  execution.run();
  Matrix<S> result(x.rows(), static_cast<Index>(code.outputs()));
  for (Index n = 0; n < result.rows(); ++n)
    for (Index i = 0; i < result.cols(); ++i) result(n, i) = execution.output(i, n);
  return result;
}

}  // namespace hbvm::core
