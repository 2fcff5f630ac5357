#include "problem/redundant_constraints.hpp"

#include "hbvm/error.hpp"
#include "linear/lu.hpp"
#include "linear/product.hpp"

namespace hbvm::core {
namespace {

/// The rows and columns of `a` named.
template <Scalar S>
Matrix<S> part(const Matrix<S>& a, const std::vector<Index>& rows, const std::vector<Index>& columns) {
  Matrix<S> result(static_cast<Index>(rows.size()), static_cast<Index>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (std::size_t i = 0; i < rows.size(); ++i)
      result(static_cast<Index>(i), static_cast<Index>(j)) = a(rows[i], columns[j]);
  return result;
}

}  // namespace

template <Scalar S>
RedundantConstraints<S>::RedundantConstraints(const Problem<S>& problem) {
  if (problem.redundant.empty()) return;
  all_ = problem;
  all_.redundant.clear();
  all_.constraints = all_constraints(problem);
  for (const RedundantConstraint<S>& redundant : problem.redundant) places_.push_back(redundant.place);
  for (Index a = 0, r = 0; a < all_.nu(); ++a) {
    if (r < static_cast<Index>(places_.size()) && places_[static_cast<std::size_t>(r)] == a)
      ++r;
    else
      kept_.push_back(a);
  }
  gradient_.emplace(all_, 1);
  course_.emplace(all_, 1);
  const auto count = static_cast<Index>(places_.size());
  values_ = sizes_ = hidden_ = Vector<S>::Zero(count);
  v_ = Vector<S>::Zero(all_.m());
}

template <Scalar S>
const Vector<S>& RedundantConstraints<S>::values(const Vector<S>& q) {
  for (Index r = 0; r < values_.size(); ++r) {
    const Index place = places_[static_cast<std::size_t>(r)];
    const auto at_q = value(all_.constraints[static_cast<std::size_t>(place)], all_.dimension, q);
    values_[r] = at_q.g;
    sizes_[r] = at_q.size;
  }
  return values_;
}

template <Scalar S>
const Vector<S>& RedundantConstraints<S>::hidden(const Vector<S>& q, const Vector<S>& p) {
  if (empty()) return hidden_;
  gradient_->update(lanes(q));
  all_.mass.velocity(lanes(p), lanes(v_));
  place(*course_, all_, q);
  course_->set_velocities(lanes(v_));
  for (Index r = 0; r < hidden_.size(); ++r)
    gradient_->transposed_times(places_[static_cast<std::size_t>(r)], lanes(std::as_const(v_)), &hidden_[r]);
  return hidden_;
}

template <Scalar S>
Vector<S> RedundantConstraints<S>::multipliers(const Vector<S>& q, const Vector<S>& lambda) {
  if (empty()) return lambda;
  gradient_->update(lanes(q));
  Matrix<S> gram;
  gradient_->gram(gram);
  Lu<S> lu;
  lu.set(part(gram, kept_, kept_));
  if (!lu.factor()) throw IntegrationError("the constraints' gradients are linearly dependent: (3) does not hold here");
  Matrix<S> X = part(gram, kept_, places_);
  for (Index r = 0; r < X.cols(); ++r) {
    Vector<S> column = X.col(r);
    lu.solve(column);
    X.col(r) = column;
  }
  Matrix<S> square, mu;
  product<S>(square, X.transpose(), X);
  square += Matrix<S>::Identity(X.cols(), X.cols());
  product<S>(mu, X.transpose(), lambda);
  Vector<S> shares = mu.col(0);
  lu.set(square);
  if (!lu.factor()) throw IntegrationError("the shares of redundant constraints in the multipliers are not finite");
  lu.solve(shares);
  product<S>(mu, X, shares);
  Vector<S> result(all_.nu());
  for (std::size_t k = 0; k < kept_.size(); ++k)
    result[kept_[k]] = lambda[static_cast<Index>(k)] - mu(static_cast<Index>(k), 0);
  for (std::size_t r = 0; r < places_.size(); ++r) result[places_[r]] = shares[static_cast<Index>(r)];
  return result;
}

template <Scalar S>
std::vector<Constraint<S>> all_constraints(const Problem<S>& problem) {
  std::vector<Constraint<S>> all = problem.constraints;
  for (const RedundantConstraint<S>& redundant : problem.redundant)
    all.insert(all.begin() + redundant.place, redundant.constraint);
  return all;
}

template <Scalar S>
std::vector<std::string> names_of_constraints(const Problem<S>& problem) {
  std::vector<std::string> names;
  for (const Constraint<S>& constraint : all_constraints(problem)) names.push_back(constraint.name);
  return names;
}

#define HBVM_DEFINE(S)                                                       \
  template class RedundantConstraints<S>;                                    \
  template std::vector<Constraint<S>> all_constraints<S>(const Problem<S>&); \
  template std::vector<std::string> names_of_constraints<S>(const Problem<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
