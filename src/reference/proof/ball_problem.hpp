#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "ball_effect.hpp"
#include "ball_matrix.hpp"
#include "problem/problem.hpp"

namespace hbvm::core {

/// One term of a displacement: a coordinate times a number.
struct BallPart {
  Index coordinate;
  RealBall weight;
};

/// The effect of a scene on one body, pair or group, or g by a formula: programs of U or g and its derivatives.
struct BallForce {
  BallForce(const EffectTerm<Mpfr>& term, Index instance, Index dimension);

  /// The displacements along coordinates that are power series.
  BallSeries input(std::size_t i, const std::vector<BallSeries>& q) const;
  std::vector<BallSeries> inputs(const std::vector<BallSeries>& q) const;

  /// Calls visit(output, row, column, weight) for each entry to which an output of the Hessian adds itself, weighted.
  template <class Visit>
  void for_each_second(const Visit& visit) const {
    std::size_t output = 0;
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (std::size_t l = 0; l <= i; ++l, ++output)
        for (const BallPart& x : parts[i])
          for (const BallPart& y : parts[l]) {
            const RealBall weight = x.weight * y.weight;
            visit(output, x.coordinate, y.coordinate, weight);
            if (l < i) visit(output, y.coordinate, x.coordinate, weight);
          }
  }

  std::vector<std::vector<BallPart>> parts;  ///< of each input
  std::vector<RealBall> shifts;              ///< likewise
  BallEffect value, gradient, hessian;
};

/// One component of g: quadratic, c + b^T q + q^T H q / 2, or by a formula.
struct BallConstraint {
  struct Entry {
    Index i, j;
    RealBall h;  ///< d^2g/dq_i dq_j
  };
  std::vector<Index> coordinates;  ///< on which g depends
  std::vector<Entry> second;       ///< all that are not 0
  std::vector<RealBall> slopes;    ///< b, of each of `coordinates`
  RealBall at_origin;              ///< c
  std::optional<BallForce> formula;
};

/// A component of grad g along a motion.
struct BallSlope {
  Index coordinate;
  BallSeries series;
};

/// The problem (5) with each number as a ball that holds it. It is made of a problem that was assembled with more
/// digits than are to be proved, and that outlives this.
class BallProblem {
 public:
  explicit BallProblem(const Problem<Mpfr>& problem);

  Index m() const { return M_.rows(); }
  Index nu() const { return static_cast<Index>(constraints_.size()); }
  const BallMatrix& M() const { return M_; }
  /// M^-1.
  const BallMatrix& W() const { return W_; }
  const std::vector<BallForce>& forces() const { return forces_; }
  const std::vector<BallConstraint>& constraints() const { return constraints_; }

  /// grad U along q, its terms below degree `length`.
  std::vector<BallSeries> force(const std::vector<BallSeries>& q, Index length) const;
  /// Column a of grad g along q, likewise.
  std::vector<BallSlope> slopes(Index a, const std::vector<BallSeries>& q, Index length) const;
  /// g at q.
  std::vector<RealBall> constraint_values(const std::vector<RealBall>& q) const;
  /// -U at q.
  RealBall potential_energy(const std::vector<RealBall>& q) const;

  /// M x and M^-1 x, of balls and of series.
  template <class Value>
  std::vector<Value> momentum(const std::vector<Value>& v) const {
    return times(M_, v);
  }
  template <class Value>
  std::vector<Value> velocity(const std::vector<Value>& p) const {
    return times(W_, p);
  }

 private:
  template <class Value>
  std::vector<Value> times(const BallMatrix& matrix, const std::vector<Value>& x) const {
    std::vector<Value> result(x.size());
    for (Index j = 0; j < m(); ++j)
      for (Index i = first_[static_cast<std::size_t>(j)]; i < end_[static_cast<std::size_t>(j)]; ++i)
        if (arb_is_zero(matrix(j, i)) == 0)
          result[static_cast<std::size_t>(j)] += x[static_cast<std::size_t>(i)] * matrix.at(j, i);
    return result;
  }

  BallMatrix M_, W_;
  std::vector<Index> first_, end_;  ///< of the block of M that a coordinate is in
  std::vector<BallForce> forces_;
  std::vector<BallConstraint> constraints_;
};

/// The problem in the bits of twice the digits of the scope, from one with at least as many, which outlives it.
BallProblem ball_problem_of(const Problem<Mpfr>& exact);

/// Each number as a series of one term.
std::vector<BallSeries> as_series(const std::vector<RealBall>& x);

}  // namespace hbvm::core
