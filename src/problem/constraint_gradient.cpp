#include "problem/constraint_gradient.hpp"

#include <algorithm>
#include <set>

#include "linear/constant_count.hpp"
#include "problem/mass_block.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {

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
    std::set<Index> reached;
    for (const Index coordinate : own) {
      if (coordinate >= problem.mass.of_bodies()) continue;
      reached.insert(coordinate);
      if (const auto& block = block_of(problem.mass, coordinate); block.full)
        for (Index j = 0; j < block.size; ++j) reached.insert(block.offset + j);
    }
    weighted_patterns_.push_back({weighted_columns, std::vector<Index>(reached.begin(), reached.end())});
    weighted_columns += static_cast<Index>(reached.size());
    std::visit(
        [&]<class Form>(const Form& form) {
          gradients_.emplace_back(std::in_place_type<typename Form::Gradient>, form, problem.dimension, own);
          if constexpr (requires(const typename Form::Gradient& gradient) { gradient.is_opposite(); })
            patterns_.back().opposite = std::get<typename Form::Gradient>(gradients_.back()).is_opposite();
        },
        constraint.form);
    prepare_weighing(patterns_.back(), weighted_patterns_.back());
  }
  run_length_ = find_runs(patterns_, runs_);
  weighted_run_length_ = find_runs(weighted_patterns_, weighted_runs_);
  values_ = Matrix<S>::Zero(lanes, columns);
  weighted_ = Matrix<S>::Zero(lanes, weighted_columns);

  for (std::size_t a = 0; a < patterns_.size(); ++a)
    std::visit([&](const auto& gradient) { gradient.begin(target(a, nullptr, lanes)); }, gradients_[a]);
  find_couplings();
}

template <Scalar S>
void ConstraintGradient<S>::find_couplings() {
  // By each coordinate whose M^-1 grad g it is in, for only those meet that share one.
  std::vector<std::vector<std::size_t>> reaching(static_cast<std::size_t>(problem_.m()));
  for (std::size_t b = 0; b < weighted_patterns_.size(); ++b)
    for (const Index coordinate : weighted_patterns_[b].coordinates)
      reaching[static_cast<std::size_t>(coordinate)].push_back(b);
  for (std::size_t a = 0; a < patterns_.size(); ++a) {
    std::set<std::size_t> met;
    for (const Index coordinate : patterns_[a].coordinates) {
      const auto& there = reaching[static_cast<std::size_t>(coordinate)];
      met.insert(there.begin(), there.end());
    }
    for (const std::size_t b : met) {
      Coupling pair{static_cast<Index>(a), static_cast<Index>(b), {}, 0};
      for (const Index coordinate : patterns_[a].coordinates) {
        if (!std::binary_search(weighted_patterns_[b].coordinates.begin(), weighted_patterns_[b].coordinates.end(),
                                coordinate))
          continue;
        pair.terms.push_back({patterns_[a].column(coordinate), weighted_patterns_[b].column(coordinate)});
      }
      pair.products = static_cast<Index>(pair.terms.size());
      couplings_.push_back(std::move(pair));
    }
  }
  using Term = typename Coupling::Term;
  const Index d = problem_.dimension;
  const auto follows = [](const Term& x, const Term& y) { return y.left == x.left + 1 && y.right == x.right + 1; };
  for (const Coupling& pair : couplings_) {
    if (pair.products % d != 0) return;
    for (std::size_t n = 1; n < pair.terms.size(); ++n)
      if (n % static_cast<std::size_t>(d) != 0 && !follows(pair.terms[n - 1], pair.terms[n])) return;
  }
  coupling_length_ = d;
  for (Coupling& pair : couplings_) {
    std::vector<Term> first;
    for (std::size_t n = 0; n < pair.terms.size(); n += static_cast<std::size_t>(d)) first.push_back(pair.terms[n]);
    pair.terms = std::move(first);
  }
}

template <Scalar S>
Index ConstraintGradient<S>::find_runs(std::vector<Pattern>& patterns, std::vector<Run>& runs) const {
  const auto has_runs = [](const Pattern& pattern, std::size_t length) {
    const std::vector<Index>& own = pattern.coordinates;
    if ((pattern.opposite ? own.size() / 2 : own.size()) % length != 0) return false;
    for (std::size_t c = 0; c < own.size(); ++c)
      if (c % length != 0 && own[c] != own[c - 1] + 1) return false;
    return true;
  };
  const auto dimension = static_cast<std::size_t>(problem_.dimension);
  const bool vectors = std::all_of(patterns.begin(), patterns.end(),
                                   [&](const Pattern& pattern) { return has_runs(pattern, dimension); });
  const Index length = vectors ? problem_.dimension : 1;
  for (Pattern& pattern : patterns) {
    const auto constraint = static_cast<Index>(&pattern - patterns.data());
    const std::vector<Index>& own = pattern.coordinates;
    const std::size_t halves = pattern.opposite ? own.size() / 2 : own.size();
    pattern.first_run = runs.size();
    for (std::size_t c = 0; c < halves; c += static_cast<std::size_t>(length))
      runs.push_back(
          {pattern.first + static_cast<Index>(c), constraint, own[c], halves < own.size() ? own[c + halves] : none});
    pattern.runs = runs.size() - pattern.first_run;
  }
  return length;
}

template <Scalar S>
void ConstraintGradient<S>::prepare_weighing(const Pattern& from, const Pattern& to) {
  const auto end = std::lower_bound(from.coordinates.begin(), from.coordinates.end(), problem_.mass.of_bodies());
  for (auto first = from.coordinates.begin(); first != end;) {
    const auto& block = block_of(problem_.mass, *first);
    const auto last = std::lower_bound(first, end, block.offset + block.size);
    if (!block.full)
      add_weighing({to.column(*first), from.column(*first), last - first, true,
                    block.mass == 1 ? nullptr : &block.inverse_mass});
    for (Index j = 0; block.full && j < block.size; ++j)
      for (auto l = first; l != last; ++l)
        add_weighing({to.column(block.offset + j), from.column(*l), 1, l == first, &block.W(j, *l - block.offset)});
    first = last;
  }
}

template <Scalar S>
void ConstraintGradient<S>::add_weighing(const Weighing& next) {
  if (!weighings_.empty()) {
    Weighing& last = weighings_.back();
    const bool same = last.factor == next.factor || (last.factor && next.factor && *last.factor == *next.factor);
    if (same && last.first && next.first && last.to + last.count == next.to && last.from + last.count == next.from) {
      last.count += next.count;
      return;
    }
  }
  weighings_.push_back(next);
}

template <Scalar S>
void ConstraintGradient<S>::update(Lanes<const S> q) {
  with_constant_count<S>(lanes_, [&]<class Count>(Count lanes) {
    update(Lanes<const S, Count>{q.data, lanes}, static_cast<S*>(nullptr));
  });
}

template <Scalar S>
void ConstraintGradient<S>::update(Lanes<const S> q, Matrix<S>& g) {
  with_constant_count<S>(lanes_, [&]<class Count>(Count lanes) {
    update(Lanes<const S, Count>{q.data, lanes}, g.data());
  });
}

template <Scalar S>
void ConstraintGradient<S>::weigh() const {
  weighed_ = true;
  for (const Weighing& w : weighings_) {
    S* __restrict const out = weighted_.data() + w.to * lanes_;
    const S* __restrict const in = values_.data() + w.from * lanes_;
    const Index size = w.count * lanes_;
    if (w.factor == nullptr)
      for (Index i = 0; i < size; ++i) set(out[i], in[i]);
    else if (w.first)
      for (Index i = 0; i < size; ++i) set_product(out[i], *w.factor, in[i]);
    else
      for (Index i = 0; i < size; ++i) add_product(out[i], *w.factor, in[i], t_);
  }
}

template <Scalar S>
OperationCounts ConstraintGradient<S>::operations() const {
  OperationCounts counts;
  for (const auto& own : gradients_) counts += std::visit([](const auto& form) { return form.operations(); }, own);
  return static_cast<std::uint64_t>(lanes_) * counts;
}

template <Scalar S>
OperationCounts ConstraintGradient<S>::weighing_operations() const {
  OperationCounts counts;
  for (const Pattern& pattern : patterns_)
    for (const Index coordinate : pattern.coordinates) {
      if (coordinate >= problem_.mass.of_bodies()) continue;
      const auto& block = block_of(problem_.mass, coordinate);
      if (block.full)
        counts.add_products(block.size);
      else if (block.mass != 1)
        counts.add(Op::multiply, 1);
    }
  return static_cast<std::uint64_t>(lanes_) * counts;
}

template <Scalar S>
OperationCounts ConstraintGradient<S>::transposed_operations(Index a) const {
  const Pattern& own = pattern(a);
  const auto size = static_cast<Index>(own.coordinates.size());
  OperationCounts counts;
  counts.add_dots(lanes_, own.opposite ? size / 2 : size);
  if (own.opposite) counts.add(Op::subtract, lanes_ * (size / 2));
  return counts;
}

template <Scalar S>
OperationCounts ConstraintGradient<S>::times_operations() const {
  OperationCounts counts;
  for (const Run& run : runs_) {
    counts.add_products(run_length_ * lanes_);
    if (run.opposite != none) counts.add(Op::subtract, run_length_ * lanes_);
  }
  return counts;
}

template <Scalar S>
void ConstraintGradient<S>::transposed_times(Index a, Lanes<const S> v, S* result) {
  const Pattern& pattern = patterns_[static_cast<std::size_t>(a)];
  with_constant_count<S>(lanes_, [&]<class Count>(Count lanes) {
    with_constant_dimension<S>(run_length_, [&](auto length) {
      transposed_times(length, pattern, Lanes<const S, Count>{v.data, lanes}, result);
    });
  });
}

template <Scalar S>
void ConstraintGradient<S>::add_times(const Matrix<S>& lambda, Lanes<S> out) {
  with_constant_count<S>(lanes_, [&]<class Count>(Count lanes) {
    with_constant_dimension<S>(run_length_, [&](auto length) {
      add_times(length, runs_, values_.data(), lambda.data(), Lanes<S, Count>{out.data, lanes}, t_);
    });
  });
}

template <Scalar S>
void ConstraintGradient<S>::add_weighted_times(const Matrix<S>& lambda, Lanes<S> out) {
  with_constant_count<S>(lanes_, [&]<class Count>(Count lanes) {
    with_constant_dimension<S>(weighted_run_length_, [&](auto length) {
      add_times(length, weighted_runs_, weighted_values().data(), lambda.data(), Lanes<S, Count>{out.data, lanes}, t_);
    });
  });
}

template <Scalar S>
void ConstraintGradient<S>::coupling(const Coupling& pair, const ConstraintGradient& right, S* result) {
  const S* const right_columns = right.weighted_values().data();
  with_constant_count<S>(lanes_, [&](auto lanes) { couple(lanes, pair, right_columns, result); });
}

template <Scalar S>
OperationCounts ConstraintGradient<S>::own_coupling_operations() const {
  OperationCounts counts;
  for (const Coupling& pair : couplings_)
    if (pair.a <= pair.b) counts.add_dots(lanes_ * lanes_, pair.products);
  return counts;
}

template <Scalar S>
void ConstraintGradient<S>::gram(Matrix<S>& result) {
  result.setZero(problem_.nu(), problem_.nu());
  Matrix<S> all(lanes_, lanes_);
  for_each_own_coupling(lanes_, all.data(), [&](Index a, Index b, const auto& at) { set(result(a, b), at(0, 0)); });
}

#define HBVM_DEFINE(S) template class ConstraintGradient<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
