#include "scene/nearest_position.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "hbvm/error.hpp"
#include "linear/lu.hpp"
#include "problem/constraint_gradient.hpp"
#include "problem/gram_factor.hpp"
#include "problem/state_evaluator.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

/// Searches for positions that fulfil the constraints of a problem.
template <Scalar S>
class PositionSearch {
 public:
  explicit PositionSearch(const Problem<S>& problem)
      : problem_(problem),
        nu_(problem.nu()),
        point_(problem),
        gradient_(problem, 1),
        mu_(nu_),
        squares_(nu_),
        row_(1, nu_) {}

  /// The point nearest to the target, from a point not too far from it. Each sweep minimises the distance under the
  /// constraints linearised at the last q. So q = target - M^-1 grad g mu with
  /// grad g^T M^-1 grad g mu = g(q) + grad g^T (target - q). The convergence is linear, the faster the nearer the
  /// target is to the constraints. \return nothing if it does not converge
  std::optional<Vector<S>> nearest(const Vector<S>& target, Vector<S> q) {
    S least = -1;
    const int sweeps = 50 + 10 * digits10<S>();
    for (int sweep = 0, waiting = 0; sweep < sweeps; ++sweep) {
      if (!solve_at(q, Vector<S>(target - q))) return std::nullopt;
      const Vector<S> next = moved(target, S(1));
      const S increment = distance(next, q);
      q = next;
      if (!is_finite(increment)) return std::nullopt;
      waiting = least < 0 || increment < least ? 0 : waiting + 1;
      if (waiting == 0) least = increment;
      if (increment == 0 || (increment <= round_off(q) && waiting >= 2)) return polished(q);
    }
    return std::nullopt;
  }

  /// Some point that fulfils the constraints, by Newton's method from q. A step is halved until it brings the
  /// constraints nearer to 0, in the metric M of the steps that would remain. \return nothing if none does
  std::optional<Vector<S>> consistent(Vector<S> q) {
    const int most = 100 + digits10<S>();
    constexpr int halvings = 20;
    last_ = q;
    for (int step = 0; step < most; ++step) {
      if (!solve_at(q, Vector<S>::Zero(q.size()))) return std::nullopt;
      const Vector<S> direction = moved(Vector<S>(Vector<S>::Zero(q.size())), S(1));
      if (max_norm(direction) <= round_off(q)) return polished(Vector<S>(q + direction));
      const S off = off_by(q);
      S share = 1;
      int halved = 0;
      Vector<S> next = q + direction;
      while (!(off_by(next) < off) && halved < halvings) {
        share /= 2;
        ++halved;
        next = q + share * direction;
      }
      if (halved == halvings) {
        const Vector<S> ended = polished(q);
        return fulfils(ended) ? std::optional(ended) : std::nullopt;
      }
      last_ = q = next;
    }
    return std::nullopt;
  }

  /// The constraints that are farthest from 0 where consistent() ended.
  std::string residuals() const {
    std::vector<std::pair<double, std::string>> all;  // shares of the terms, and texts
    for (const Constraint<S>& constraint : problem_.constraints) {
      const auto at = value(constraint, problem_.dimension, last_);
      if (!at.vanishes())
        all.emplace_back(approximately(S(magnitude(at.g) / at.size)),
                         fmt::format("{} ({})", constraint.name, to_scientific(at.g, 2)));
    }
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    constexpr std::size_t most = 4;
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < std::min(all.size(), most); ++i) texts.push_back(all[i].second);
    return fmt::format("{}{}", fmt::join(texts, ", "),
                       all.size() > most ? fmt::format(", and {} more", all.size() - most) : "");
  }

 private:
  /// What other coordinates were rounded by is taken from constraints whose own terms are small. A coordinate that is
  /// to be 0, as on the plane y = 0, is made so. It has no terms that its round-off could be measured against.
  Vector<S> polished(Vector<S> q) {
    constexpr int most = 3;
    for (int step = 0; step < most && !fulfils(q); ++step) {
      if (!solve_at(q, Vector<S>::Zero(q.size()))) break;
      q = moved(q, S(1));
    }
    const S tolerance = round_off(q);
    for (const Constraint<S>& constraint : problem_.constraints) {
      if (value(constraint, problem_.dimension, q).vanishes()) continue;
      for (const Index i : coordinates(constraint, problem_.dimension))
        if (magnitude(q[i]) <= tolerance) q[i] = 0;
    }
    return q;
  }

  S round_off(const Vector<S>& q) const {
    return S(static_cast<long>(16 * (problem_.m() + nu_))) * epsilon<S>() * max_norm(q);
  }

  /// mu of grad g^T M^-1 grad g mu = g(q) + grad g^T away. \return false if the matrix is singular
  bool solve_at(const Vector<S>& q, const Vector<S>& away) {
    gradient_.update(lanes(q));
    S product;
    gradient_.for_each_own_coupling(Index{1}, &product, [&](Index a, Index b, const auto& at) {
      if (a == b) set(squares_[a], at(0, 0));
    });
    const Vector<S>& g = point_.constraints(q);
    for (Index a = 0; a < nu_; ++a) {
      gradient_.transposed_times(a, lanes(away), &mu_[a]);
      mu_[a] += g[a];
    }
    if (nu_ >= many_constraints) {
      if (!band_.factor(gradient_, nu_)) return false;
      band_.solve(mu_);
      return true;
    }
    gradient_.gram(gram_matrix_);
    gram_.set(gram_matrix_);
    if (!gram_.factor()) return false;
    gram_.solve(mu_);
    return true;
  }

  /// from - share M^-1 grad g mu.
  Vector<S> moved(Vector<S> from, const S& share) {
    for (Index a = 0; a < nu_; ++a) row_(0, a) = -share * mu_[a];
    gradient_.add_weighted_times(row_, lanes(from));
    return from;
  }

  /// The sum of the squares of g over the squares of their gradients, those of solve_at().
  S off_by(const Vector<S>& q) {
    const Vector<S>& g = point_.constraints(q);
    S sum = 0;
    for (Index a = 0; a < nu_; ++a) sum += g[a] * g[a] / squares_[a];
    return sum;
  }

  bool fulfils(const Vector<S>& q) const {
    return std::all_of(problem_.constraints.begin(), problem_.constraints.end(), [&](const Constraint<S>& constraint) {
      return value(constraint, problem_.dimension, q).vanishes();
    });
  }

  const Problem<S>& problem_;
  Index nu_;
  StateEvaluator<S> point_;
  ConstraintGradient<S> gradient_;
  Lu<S> gram_;
  GramFactor<S> band_;
  Matrix<S> gram_matrix_;
  Vector<S> mu_, squares_, last_;
  Matrix<S> row_;
};

}  // namespace

template <Scalar S>
Vector<S> nearest_position(const Problem<S>& problem, const Vector<S>& target) {
  PositionSearch<S> search(problem);
  if (const auto q = search.nearest(target, target)) return *q;
  const auto some = search.consistent(target);
  if (!some)
    throw InputError(
        "no consistent position was found near the given one; the constraints may contradict one another: the search "
        "ended where these are off: " +
        search.residuals());
  const auto q = search.nearest(target, *some);
  return q ? *q : *some;
}

#define HBVM_DEFINE(S) template Vector<S> nearest_position<S>(const Problem<S>&, const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
