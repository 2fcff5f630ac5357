#include "hbvm/problem/constraint_gradient.hpp"

#include <algorithm>
#include <set>

#include "hbvm/linear/constant_count.hpp"
#include "hbvm/scalar/in_place.hpp"

namespace hbvm {

template <Scalar S>
ConstraintGradient<S>::Pattern::Pattern(Index first_column, std::vector<Index> ascending)
    : first(first_column), coordinates(std::move(ascending)) {
  for (const Index coordinate : coordinates) {
    if (!runs.empty() && coordinate == runs.back().coordinate + runs.back().count)
      ++runs.back().count;
    else
      runs.push_back({coordinate, 1});
  }
}

template <Scalar S>
Index ConstraintGradient<S>::Coupling::terms() const {
  Index sum = 0;
  for (const Run& run : runs) sum += run.count;
  return sum;
}

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
    patterns_.emplace_back(columns, coordinates(constraint, problem.dimension));
    const std::vector<Index>& own = patterns_.back().coordinates;
    columns += static_cast<Index>(own.size());
    // M^-1 spreads a gradient over the whole of each full block that it touches.
    std::set<Index> reached(own.begin(), own.end());
    for (const auto& block : problem.mass.blocks()) {
      const auto touched = reached.lower_bound(block.offset);
      if (!block.full || touched == reached.end() || *touched >= block.offset + block.size) continue;
      for (Index j = 0; j < block.size; ++j) reached.insert(block.offset + j);
    }
    weighted_patterns_.emplace_back(weighted_columns, std::vector<Index>(reached.begin(), reached.end()));
    weighted_columns += static_cast<Index>(reached.size());
    std::visit(
        [&]<class Form>(const Form& form) {
          gradients_.emplace_back(std::in_place_type<typename Form::Gradient>, form, problem.dimension, own);
        },
        constraint.form);
    prepare_weighing(patterns_.back(), weighted_patterns_.back());
  }
  values_ = Matrix<S>::Zero(lanes, columns);
  weighted_ = Matrix<S>::Zero(lanes, weighted_columns);

  for (std::size_t a = 0; a < patterns_.size(); ++a) {
    std::visit([&](const auto& gradient) { gradient.begin(target(a, nullptr, lanes)); }, gradients_[a]);
    for (std::size_t b = 0; b < weighted_patterns_.size(); ++b) {
      Coupling pair{static_cast<Index>(a), static_cast<Index>(b), {}};
      for (const Index coordinate : patterns_[a].coordinates) {
        if (!std::binary_search(weighted_patterns_[b].coordinates.begin(), weighted_patterns_[b].coordinates.end(),
                                coordinate))
          continue;
        const Index left = patterns_[a].column(coordinate), right = weighted_patterns_[b].column(coordinate);
        if (!pair.runs.empty() && left == pair.runs.back().left + pair.runs.back().count &&
            right == pair.runs.back().right + pair.runs.back().count)
          ++pair.runs.back().count;
        else
          pair.runs.push_back({left, right, 1});
      }
      if (!pair.runs.empty()) couplings_.push_back(std::move(pair));
    }
  }
}

template <Scalar S>
void ConstraintGradient<S>::prepare_weighing(const Pattern& from, const Pattern& to) {
  for (const auto& block : problem_.mass.blocks()) {
    const auto first = std::lower_bound(from.coordinates.begin(), from.coordinates.end(), block.offset);
    const auto last = std::lower_bound(first, from.coordinates.end(), block.offset + block.size);
    if (!block.full) {
      if (first != last)
        weighings_.push_back({to.column(*first), from.column(*first), last - first, true,
                              block.mass == 1 ? nullptr : &block.inverse_mass});
      continue;
    }
    for (Index j = 0; first != last && j < block.size; ++j)
      for (auto l = first; l != last; ++l)
        weighings_.push_back(
            {to.column(block.offset + j), from.column(*l), 1, l == first, &block.W(j, *l - block.offset)});
  }
}

template <Scalar S>
void ConstraintGradient<S>::update(Lanes<const S> q) {
  update_all(q, nullptr);
  weigh();
}

template <Scalar S>
void ConstraintGradient<S>::update(Lanes<const S> q, Matrix<S>& g) {
  update_all(q, &g);
}

template <Scalar S>
template <class Count>
GradientTarget<S, Count> ConstraintGradient<S>::target(std::size_t a, S* g, Count lanes) {
  return {lanes, values_.data() + patterns_[a].first * lanes, g, x_, y_, t_};
}

template <Scalar S>
void ConstraintGradient<S>::update_all(Lanes<const S> q, Matrix<S>* g) {
  with_constant_count<S>(lanes_, [&]<class Count>(Count lanes) {
    for (std::size_t a = 0; a < patterns_.size(); ++a) {
      const GradientTarget<S, Count> to = target(a, g ? g->data() + static_cast<Index>(a) * lanes : nullptr, lanes);
      std::visit(
          [&](const auto& gradient) {
            gradient.update(Lanes<const S, Count>{q.data, lanes}, to);
          },
          gradients_[a]);
    }
  });
}

template <Scalar S>
void ConstraintGradient<S>::weigh() {
  for (const Weighing& w : weighings_) {
    S* const out = weighted_.data() + w.to * lanes_;
    const S* const in = values_.data() + w.from * lanes_;
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
  for (std::size_t a = 0; a < patterns_.size(); ++a) {
    counts += std::visit([](const auto& gradient) { return gradient.operations(); }, gradients_[a]);
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
void ConstraintGradient<S>::transposed_times(Index a, Lanes<const S> v, S* result) {
  const Pattern& pattern = patterns_[static_cast<std::size_t>(a)];
  with_constant_count<S>(lanes_, [&]<class Count>(Count lanes) {
    const S* column = values_.data() + pattern.first * lanes;
    if constexpr (is_constant_count<Count>) {
      S sums[Count::value] = {};
      for (const auto& run : pattern.runs) {
        const S* in = v[run.coordinate];
        for (Index c = 0; c < run.count; ++c, column += lanes, in += lanes)
          for (Index i = 0; i < lanes; ++i) sums[i] += column[i] * in[i];
      }
      for (Index i = 0; i < lanes; ++i) result[i] = sums[i];
      return;
    }
    bool first = true;
    for (const auto& run : pattern.runs) {
      const S* in = v[run.coordinate];
      for (Index c = 0; c < run.count; ++c, column += lanes, in += lanes) {
        if (first)
          for (Index i = 0; i < lanes; ++i) set_product(result[i], column[i], in[i]);
        else
          for (Index i = 0; i < lanes; ++i) add_product(result[i], column[i], in[i], t_);
        first = false;
      }
    }
  });
}

template <Scalar S>
void ConstraintGradient<S>::add_times(const std::vector<Pattern>& patterns, const Matrix<S>& values,
                                      const Matrix<S>& lambda, Lanes<S> out, S& t) {
  with_constant_count<S>(values.rows(), [&](auto lanes) {
    const S* column = values.data();
    const S* multiplier = lambda.data();
    for (const Pattern& pattern : patterns) {
      for (const auto& run : pattern.runs) {
        S* sum = out[run.coordinate];
        for (Index c = 0; c < run.count; ++c, column += lanes, sum += lanes)
          for (Index i = 0; i < lanes; ++i) add_product(sum[i], column[i], multiplier[i], t);
      }
      multiplier += lanes;
    }
  });
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
void ConstraintGradient<S>::coupling(const Coupling& pair, const ConstraintGradient& right, S* result) {
  with_constant_count<S>(lanes_, [&]<class Count>(Count lanes) {
    if constexpr (is_constant_count<Count>) {
      S sums[Count::value * Count::value] = {};
      for (const auto& run : pair.runs) {
        const S* x = values_.data() + run.left * lanes;
        const S* y = right.weighted_.data() + run.right * lanes;
        for (Index c = 0; c < run.count; ++c, x += lanes, y += lanes)
          for (Index j = 0; j < lanes; ++j)
            for (Index i = 0; i < lanes; ++i) sums[i + j * lanes] += x[i] * y[j];
      }
      for (Index i = 0; i < lanes * lanes; ++i) result[i] = sums[i];
      return;
    }
    bool first = true;
    for (const auto& run : pair.runs) {
      const S* x = values_.data() + run.left * lanes;
      const S* y = right.weighted_.data() + run.right * lanes;
      for (Index c = 0; c < run.count; ++c, x += lanes, y += lanes) {
        S* out = result;
        for (Index j = 0; j < lanes; ++j, out += lanes) {
          if (first)
            for (Index i = 0; i < lanes; ++i) set_product(out[i], x[i], y[j]);
          else
            for (Index i = 0; i < lanes; ++i) add_product(out[i], x[i], y[j], t_);
        }
        first = false;
      }
    }
  });
}

template <Scalar S>
void ConstraintGradient<S>::gram(Matrix<S>& result) {
  result.setZero(problem_.nu(), problem_.nu());
  Matrix<S> all(lanes_, lanes_);
  for (const Coupling& pair : couplings_) {
    coupling(pair, *this, all.data());
    set(result(pair.a, pair.b), all(0, 0));
  }
}

#define HBVM_DEFINE(S) template class ConstraintGradient<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
