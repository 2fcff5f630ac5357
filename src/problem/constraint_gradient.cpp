#include "hbvm/problem/constraint_gradient.hpp"

#include <algorithm>
#include <set>

#include "hbvm/scalar/in_place.hpp"

namespace hbvm {

template <Scalar S>
Index ConstraintGradient<S>::Pattern::column(Index coordinate) const {
  const auto found = std::lower_bound(coordinates.begin(), coordinates.end(), coordinate);
  return first + static_cast<Index>(found - coordinates.begin());
}

template <Scalar S>
ConstraintGradient<S>::ConstraintGradient(const Problem<S>& problem, Index lanes)
    : problem_(problem), lanes_(lanes), x_(lanes, problem.dimension), y_(lanes, problem.dimension) {
  Index columns = 0, weighted_columns = 0;
  for (const Constraint<S>& constraint : problem.constraints) {
    patterns_.push_back({columns, coordinates(constraint, problem.dimension)});
    const std::vector<Index>& own = patterns_.back().coordinates;
    columns += static_cast<Index>(own.size());
    // M^-1 spreads a gradient over the whole of each full block that it touches.
    std::set<Index> reached(own.begin(), own.end());
    for (const auto& block : problem.mass.blocks()) {
      const auto touched = reached.lower_bound(block.offset);
      if (!block.full || touched == reached.end() || *touched >= block.offset + block.size) continue;
      for (Index j = 0; j < block.size; ++j) reached.insert(block.offset + j);
    }
    weighted_patterns_.push_back({weighted_columns, {reached.begin(), reached.end()}});
    weighted_columns += static_cast<Index>(reached.size());
  }
  values_ = Matrix<S>::Zero(lanes, columns);
  weighted_ = Matrix<S>::Zero(lanes, weighted_columns);

  for (std::size_t a = 0; a < patterns_.size(); ++a) {
    if (const auto* plane = std::get_if<Plane<S>>(&problem.constraints[a].form))
      for (Index j = 0; j < plane->normal.size(); ++j)
        values_.col(patterns_[a].column(plane->block + j)).setConstant(plane->normal[j]);
    for (std::size_t b = 0; b < weighted_patterns_.size(); ++b) {
      Coupling pair{static_cast<Index>(a), static_cast<Index>(b), {}};
      for (const Index coordinate : patterns_[a].coordinates)
        if (std::binary_search(weighted_patterns_[b].coordinates.begin(), weighted_patterns_[b].coordinates.end(),
                               coordinate))
          pair.terms.emplace_back(patterns_[a].column(coordinate), weighted_patterns_[b].column(coordinate));
      if (!pair.terms.empty()) couplings_.push_back(std::move(pair));
    }
  }
}

template <Scalar S>
void ConstraintGradient<S>::update(Lanes<const S> q) {
  for (std::size_t a = 0; a < patterns_.size(); ++a) {
    const auto& form = problem_.constraints[a].form;
    if (const auto* product = std::get_if<DisplacementProduct<S>>(&form)) update(*product, patterns_[a], q);
    if (const auto* quadric = std::get_if<Quadric<S>>(&form)) update(*quadric, patterns_[a], q);
  }
  weigh();
}

template <Scalar S>
void ConstraintGradient<S>::update(const DisplacementProduct<S>& form, const Pattern& pattern, Lanes<const S> q) {
  const Index d = problem_.dimension;
  for (std::size_t k = 0; k < pattern.coordinates.size(); ++k) {
    S* const column = values_.data() + (pattern.first + static_cast<Index>(k)) * lanes_;
    for (Index i = 0; i < lanes_; ++i) set_zero(column[i]);
  }
  // d(x.y) = y.dx + x.dy
  const auto spread = [&](const Displacement<S>& moving, const Matrix<S>& other) {
    for (const auto& block : moving.blocks) {
      for (Index j = 0; j < d; ++j) {
        S* const column = values_.data() + pattern.column(block.offset + j) * lanes_;
        const S* const factor = other.data() + j * lanes_;
        add_weighted(column, block.weight, factor, lanes_, t_);
      }
    }
  };
  displace(form.x, d, q, x_.data(), lanes_);
  if (form.same) {
    for (Index i = 0; i < x_.size(); ++i) set_sum(x_.data()[i], x_.data()[i], x_.data()[i]);
    spread(form.x, x_);
    return;
  }
  displace(form.y, d, q, y_.data(), lanes_);
  spread(form.x, y_);
  spread(form.y, x_);
}

template <Scalar S>
void ConstraintGradient<S>::update(const Quadric<S>& form, const Pattern& pattern, Lanes<const S> q) {
  for (Index j = 0; j < form.b.size(); ++j) {
    S* const column = values_.data() + pattern.column(form.offset + j) * lanes_;
    for (Index i = 0; i < lanes_; ++i) set_zero(column[i]);
    for (Index l = 0; l < form.b.size(); ++l) {
      if (form.A(j, l) == 0) continue;
      const S* const in = q[form.offset + l];
      for (Index i = 0; i < lanes_; ++i) add_product(column[i], form.A(j, l), in[i], t_);
    }
    for (Index i = 0; i < lanes_; ++i) {
      set_sum(column[i], column[i], column[i]);
      set_sum(column[i], column[i], form.b[j]);
    }
  }
}

template <Scalar S>
void ConstraintGradient<S>::weigh() {
  for (std::size_t a = 0; a < patterns_.size(); ++a) {
    const Pattern& from = patterns_[a];
    const Pattern& to = weighted_patterns_[a];
    for (const auto& block : problem_.mass.blocks()) {
      const auto first = std::lower_bound(from.coordinates.begin(), from.coordinates.end(), block.offset);
      const auto last = std::lower_bound(first, from.coordinates.end(), block.offset + block.size);
      if (first == last) continue;
      if (block.full) {
        for (Index j = 0; j < block.size; ++j) {
          S* const out = weighted_.data() + to.column(block.offset + j) * lanes_;
          for (Index i = 0; i < lanes_; ++i) set_zero(out[i]);
          for (auto l = first; l != last; ++l) {
            const S* const in = values_.data() + from.column(*l) * lanes_;
            for (Index i = 0; i < lanes_; ++i) add_product(out[i], block.W(j, *l - block.offset), in[i], t_);
          }
        }
        continue;
      }
      for (auto l = first; l != last; ++l) {
        S* const out = weighted_.data() + to.column(*l) * lanes_;
        const S* const in = values_.data() + from.column(*l) * lanes_;
        if (block.mass == 1)
          for (Index i = 0; i < lanes_; ++i) set(out[i], in[i]);
        else
          for (Index i = 0; i < lanes_; ++i) set_product(out[i], block.inverse_mass, in[i]);
      }
    }
  }
}

template <Scalar S>
OperationCounts ConstraintGradient<S>::operations() const {
  OperationCounts counts;
  const Index d = problem_.dimension;
  for (std::size_t a = 0; a < patterns_.size(); ++a) {
    const auto& form = problem_.constraints[a].form;
    if (const auto* product = std::get_if<DisplacementProduct<S>>(&form)) {
      counts += hbvm::operations(product->x, d);
      if (product->same)
        counts.add(Op::add, d);
      else
        counts += hbvm::operations(product->y, d);
      for (const auto& block : product->x.blocks) counts += weighted_sum(block.weight, d);
      if (!product->same)
        for (const auto& block : product->y.blocks) counts += weighted_sum(block.weight, d);
    }
    if (const auto* quadric = std::get_if<Quadric<S>>(&form)) {
      for (Index i = 0; i < quadric->A.size(); ++i)
        if (quadric->A.data()[i] != 0) counts.add_products(1);
      counts.add(Op::add, 2 * quadric->b.size());
    }
    for (const auto& block : problem_.mass.blocks()) {
      Index touched = 0;
      for (const Index coordinate : patterns_[a].coordinates)
        touched += coordinate >= block.offset && coordinate < block.offset + block.size;
      if (block.full)
        counts.add_products(touched * block.size);
      else if (block.mass != 1)
        counts.add(Op::multiply, touched);
    }
  }
  return static_cast<std::uint64_t>(lanes_) * counts;
}

template <Scalar S>
void ConstraintGradient<S>::transposed_times(Index i, Index a, Lanes<const S> v, S& result) {
  const Pattern& pattern = patterns_[static_cast<std::size_t>(a)];
  set_zero(result);
  const S* column = values_.data() + pattern.first * lanes_ + i;
  for (const Index coordinate : pattern.coordinates) {
    add_product(result, *column, v[coordinate][i], t_);
    column += lanes_;
  }
}

template <Scalar S>
void ConstraintGradient<S>::add_times(const std::vector<Pattern>& patterns, const Matrix<S>& values,
                                      const Matrix<S>& lambda, Lanes<S> out, S& t) {
  const Index lanes = values.rows();
  for (std::size_t a = 0; a < patterns.size(); ++a) {
    const S* const multiplier = lambda.data() + static_cast<Index>(a) * lanes;
    const S* column = values.data() + patterns[a].first * lanes;
    for (const Index coordinate : patterns[a].coordinates) {
      S* const sum = out[coordinate];
      for (Index i = 0; i < lanes; ++i) add_product(sum[i], column[i], multiplier[i], t);
      column += lanes;
    }
  }
}

template <Scalar S>
void ConstraintGradient<S>::add_times(const Matrix<S>& lambda, Lanes<S> out) {
  add_times(patterns_, values_, lambda, out, t_);
}

template <Scalar S>
void ConstraintGradient<S>::add_weighted_times(const Matrix<S>& lambda, Lanes<S> out) {
  add_times(weighted_patterns_, weighted_, lambda, out, t_);
}

template <Scalar S>
void ConstraintGradient<S>::coupling(const Coupling& pair, Index i, Index j, S& result) {
  set_zero(result);
  for (const auto& [column, weighted_column] : pair.terms)
    add_product(result, values_.data()[column * lanes_ + i], weighted_.data()[weighted_column * lanes_ + j], t_);
}

template <Scalar S>
void ConstraintGradient<S>::gram(Matrix<S>& result) {
  result.setZero(problem_.nu(), problem_.nu());
  for (const Coupling& pair : couplings_) coupling(pair, 0, 0, result(pair.a, pair.b));
}

#define HBVM_DEFINE(S) template class ConstraintGradient<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
