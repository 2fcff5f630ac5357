#pragma once

#include <deque>
#include <map>
#include <vector>

#include "problem/effect/execution.hpp"
#include "problem/problem.hpp"

namespace hbvm::core {

/// The second derivatives of U and g of a problem by the pairs of coordinates where they can be nonzero. Columns are
/// coordinates of bodies, and so are the rows of U; a row of g may be a driven one.
/// Those of quadratic g are constant, those of other g and of U are evaluated at nodes. The problem must outlive it.
template <Scalar S>
class Curvature {
 public:
  /// \param nodes of U
  /// \param constraint_nodes of g
  Curvature(const Problem<S>& problem, Index nodes, Index constraint_nodes);

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

  /// The entries of a g that is not quadratic. They vary from node to node: each is a column of what varying() returns.
  struct VaryingEntry {
    Index constraint, pair;
  };
  const std::vector<VaryingEntry>& varying_constraints() const { return varying_entries_; }
  /// The values at q: constraint nodes x varying entries.
  const Matrix<S>& varying(Lanes<const S> q);

 private:
  Index pair(Index row, Index column);
  void add(Index constraint, Index row, Index column, const S& value);

  Index varying_entry(Index constraint, Index pair);

  /// One term: where each d x d block of its instances goes.
  struct Term {
    const EffectTerm<S>* effect;
    Matrix<S> displacement;
    Execution<S> hessian;
    struct Target {
      Index column, output, instance;
      S weight;
    };
    std::vector<Target> targets;
    /// \param column of the result, for a row and a column of the second derivative; none if it is not wanted
    template <class Column>
    Term(const EffectTerm<S>& term, Index dimension, Index nodes, Column column);
    /// values += the second derivative at q.
    void add_to(Matrix<S>& values, Index dimension, Lanes<const S> q, S& t);
  };

  Index dimension_, bodies_;
  std::vector<Pair> pairs_;
  std::map<std::pair<Index, Index>, Index> known_;
  std::deque<Term> terms_, constraint_terms_;
  std::vector<Entry> entries_;
  std::vector<VaryingEntry> varying_entries_;
  Matrix<S> values_, varying_;
  S t_ = 0;
};

}  // namespace hbvm::core
