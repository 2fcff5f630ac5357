#pragma once

#include <memory>

#include "plain_step/plain_step.hpp"
#include "problem/constraint_gradient.hpp"
#include "verification/models.hpp"

namespace hbvm::core {

inline plain::Mechanics<Mpfr> mechanics_of(const DenseModel& model) {
  return {static_cast<int>(model.m()), static_cast<int>(model.nu()), model.W, model.force,
          [&model](const Vector<Mpfr>& q) { return model.gradient(q); }};
}

/// A problem by its forces and gradients alone. It must live as long.
template <Scalar S>
plain::Mechanics<S> mechanics_of(const Problem<S>& problem) {
  const Index m = problem.m(), nu = problem.nu();
  plain::Mechanics<S> mechanics{static_cast<int>(m), static_cast<int>(nu), Matrix<S>::Identity(m, m), {}, {}};
  for (Index j = 0; j < m; ++j) {
    const Vector<S> unit = Vector<S>::Unit(m, j);
    Vector<S> column(m);
    problem.mass.velocity(lanes(unit), lanes(column));
    mechanics.inverse_mass.col(j) = column;
  }
  const auto potential = std::make_shared<PotentialEvaluator<S>>(problem.potential, 1);
  mechanics.grad_U = [potential, m](const Vector<S>& q) {
    Matrix<S> force(1, m);
    potential->force(lanes(q), force);
    return Vector<S>(force.transpose());
  };
  const auto gradient = std::make_shared<ConstraintGradient<S>>(problem, 1);
  mechanics.grad_g = [gradient, m, nu](const Vector<S>& q) {
    gradient->update(lanes(q));
    Matrix<S> columns(m, nu);
    for (Index a = 0; a < nu; ++a) {
      Vector<S> column = Vector<S>::Zero(m);
      gradient->add_times(Matrix<S>(Matrix<S>::Identity(nu, nu).row(a)), lanes(column));
      columns.col(a) = column;
    }
    return columns;
  };
  return mechanics;
}

/// The rows of a matrix one after the other, and back. What is s x m in the library is s blocks of m numbers there.
template <class S>
Vector<S> blocks_of(const Matrix<S>& rows) {
  const Matrix<S> columns = rows.transpose();
  return columns.reshaped();
}
template <class S>
Matrix<S> rows_of(const Vector<S>& blocks, Index columns) {
  return columns == 0 ? Matrix<S>(0, 0) : Matrix<S>(blocks.reshaped(columns, blocks.size() / columns).transpose());
}

}  // namespace hbvm::core
