#pragma once

#include <optional>
#include <string>
#include <vector>

#include "problem/effect/program.hpp"
#include "problem/space/displacement.hpp"

namespace hbvm::core {

/// A force F(x, v) that has no potential, for all the bodies, pairs or groups it acts on. It depends on displacements
/// x_1 .. x_n of an instance and on their velocities. It acts on the first of them, F_1 .. F_a; the others say where
/// something else is, such as the time.
template <Scalar S>
struct ForceTerm {
  std::string kind, name;                      ///< "drag", "effect 3 (drag)"
  Index arguments = 1;                         ///< n
  Index acting = 1;                            ///< a <= n
  std::vector<Displacement<S>> displacements;  ///< n an instance, instance after instance
  Program<S> force;              ///< F, a d outputs, from x, then v, n d inputs each, and the coefficients
  Program<S> slopes;             ///< dF_i by all x and then all v: a d rows of 2 n d outputs
  Matrix<S> force_coefficients;  ///< instances x coefficients
  Matrix<S> slope_coefficients;
  std::optional<Index> account = {};  ///< the driven coordinate whose momentum has minus its work; none if it does none

  Index instances() const { return static_cast<Index>(displacements.size()) / arguments; }
  const Displacement<S>& displacement(Index instance, Index argument) const {
    return displacements[static_cast<std::size_t>(instance * arguments + argument)];
  }
};

/// The term with all numbers rounded to double.
template <Scalar S>
ForceTerm<double> in_double(const ForceTerm<S>& term);

/// The inputs of a term's programs in some lanes: instances * lanes rows of all x, then all v. Owns the storage.
template <Scalar S>
class ForceInputs {
 public:
  ForceInputs(const ForceTerm<S>& term, Index dimension, Index lanes)
      : term_(term),
        dimension_(dimension),
        values_(Matrix<S>::Zero(term.instances() * lanes, 2 * term.arguments * dimension)) {
    for (const Displacement<S>& x : term.displacements) rates_.push_back({x.blocks, {}});
  }

  const Matrix<S>& values() const { return values_; }
  void update(Lanes<const S> q, Lanes<const S> v) {
    const Index rows = values_.rows(), n = term_.arguments;
    for (Index i = 0; i < term_.instances(); ++i)
      for (Index a = 0; a < n; ++a) {
        S* const x = values_.data() + a * dimension_ * rows + i * q.count;
        displace(term_.displacement(i, a), dimension_, q, x, rows);
        displace(rates_[static_cast<std::size_t>(i * n + a)], dimension_, v, x + n * dimension_ * rows, rows);
      }
  }

 private:
  const ForceTerm<S>& term_;
  Index dimension_;
  Matrix<S> values_;
  std::vector<Displacement<S>> rates_;
};

}  // namespace hbvm::core
