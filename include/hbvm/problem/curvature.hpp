#pragma once

#include <deque>
#include <map>
#include <vector>

#include "hbvm/problem/effect/execution.hpp"
#include "hbvm/problem/problem.hpp"

namespace hbvm {

/// The second derivatives of U and g of a problem, by the pairs of coordinates where they can be nonzero.
/// Those of g are constant, those of U are evaluated at nodes. The problem must outlive it.
template <Scalar S>
class Curvature {
 public:
  Curvature(const Problem<S>& problem, Index nodes);

  /// Row and column: every nonzero of any second derivative, each pair once in either order.
  struct Pair {
    Index row, column;
  };
  const std::vector<Pair>& pairs() const { return pairs_; }

  /// d2U/dq_row dq_column at each node: nodes x pairs.
  const Matrix<S>& potential(Lanes<const S> q);

  /// d2g_a/dq_row dq_column of one pair.
  struct Entry {
    Index constraint, pair;
    S value;
  };
  const std::vector<Entry>& constraints() const { return entries_; }

 private:
  Index pair(Index row, Index column);
  void add(Index constraint, Index row, Index column, const S& value);

  /// One term: where each d x d block of its instances goes.
  struct Term {
    const EffectTerm<S>* effect;
    Matrix<S> displacement;
    Execution<S> hessian;
    struct Target {
      Index pair, output, instance;
      S weight;
    };
    std::vector<Target> targets;
    Term(const EffectTerm<S>& term, Index dimension, Index nodes);
  };

  Index dimension_, nodes_;
  std::vector<Pair> pairs_;
  std::map<std::pair<Index, Index>, Index> known_;
  std::deque<Term> terms_;
  std::vector<Entry> entries_;
  Matrix<S> values_;
  S t_ = 0;
};

#define HBVM_DECLARE(S) extern template class Curvature<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
