#include "hbvm/problem/potential.hpp"

#include "hbvm/clock.hpp"
#include "hbvm/linear/arrays.hpp"
#include "hbvm/scalar/in_place.hpp"

namespace hbvm {

template <Scalar S>
PotentialEvaluator<S>::Work::Work(const EffectTerm<S>& term, Index dimension, Index lanes)
    : displacement(Matrix<S>::Zero(term.instances() * lanes, term.arguments * dimension)),
      value(term.value, term.value_coefficients, displacement, lanes),
      gradient(term.gradient, term.gradient_coefficients, displacement, lanes) {
  if constexpr (std::same_as<S, double>) {
    if (term.arguments == 1) kernel = find_kernel(term.gradient, dimension);
    for (std::size_t n = 0; kernel != nullptr && n < term.displacements.size(); ++n) {
      if (const auto site = kernel_site(term.displacements[n]))
        sites.push_back(*site);
      else
        kernel = nullptr;
    }
    if (kernel == nullptr) return;
    const Matrix<double>& coefficients = term.gradient_coefficients;
    kernel_coefficients.resize(static_cast<std::size_t>(coefficients.size()));
    for (std::size_t n = 0; n < sites.size(); ++n) {
      double* const first = kernel_coefficients.data() + n * static_cast<std::size_t>(coefficients.cols());
      for (Index j = 0; j < coefficients.cols(); ++j) first[j] = coefficients(static_cast<Index>(n), j);
      sites[n].coefficients = first;
    }
  }
}

namespace {

/// One evaluation at a node: the displacements, the program for each body or pair, the sum into the force.
template <Scalar S>
OperationCounts operations_of(const EffectTerm<S>& term, Index dimension) {
  OperationCounts counts;
  for (const Displacement<S>& x : term.displacements) {
    counts += operations(x, dimension);
    for (const auto& block : x.blocks) counts += weighted_sum(block.weight, dimension);
  }
  counts += static_cast<std::uint64_t>(term.instances()) * term.gradient.operations();
  return counts;
}

}  // namespace

template <Scalar S>
PotentialEvaluator<S>::PotentialEvaluator(const Potential<S>& potential, Index lanes)
    : potential_(potential), lanes_(lanes), counts_(potential.terms.size()) {
  constant_force_ = Vector<S>::Zero(potential.m);
  for (std::size_t t = 0; t < potential.terms.size(); ++t) {
    const EffectTerm<S>& term = potential.terms[t];
    Work& work = work_.emplace_back(term, potential.dimension, lanes);
    counts_[t].per_evaluation = operations_of(term, potential.dimension);
    if (!term.constant_force) {
      varying_.push_back({&term, &work, &counts_[t]});
      continue;
    }
    // The same everywhere: evaluated once, here.
    work.gradient.run();
    counts_[t].calls = counts_[t].evaluations = 1;
    for_each_force(term, [&](Index output, Index instance, Index coordinate, const S& weight) {
      add_weighted(&constant_force_[coordinate], weight, &work.gradient.output(output, instance * lanes), 1, t_);
    });
  }
}

template <Scalar S>
template <class F>
void PotentialEvaluator<S>::for_each_force(const EffectTerm<S>& term, F f) const {
  const Index d = potential_.dimension;
  for (Index n = 0; n < term.instances(); ++n)
    for (Index a = 0; a < term.arguments; ++a)
      for (const auto& block : term.displacement(n, a).blocks)
        for (Index j = 0; j < d; ++j) f(a * d + j, n, block.offset + j, block.weight);
}

template <Scalar S>
void PotentialEvaluator<S>::displace_all(const EffectTerm<S>& term, Work& work, Lanes<const S> q) {
  Matrix<S>& x = work.displacement;
  displace(term, potential_.dimension, q, x.data(), x.rows());
}

template <Scalar S>
void PotentialEvaluator<S>::values(Lanes<const S> q, Vector<S>& U) {
  U.setZero(lanes_);
  for (std::size_t t = 0; t < potential_.terms.size(); ++t) {
    displace_all(potential_.terms[t], work_[t], q);
    work_[t].value.run();
    for (Index lane = 0; lane < work_[t].displacement.rows(); ++lane) {
      S& u = U[lane % lanes_];
      set_sum(u, u, work_[t].value.output(0, lane));
    }
  }
}

template <Scalar S>
void PotentialEvaluator<S>::varying_force(Lanes<const S> q, Matrix<S>& force) {
  if (force.rows() != lanes_ || force.cols() != potential_.m) force.resize(lanes_, potential_.m);
  set_zero(force);
  for (const Varying& own : varying_) {
    const double before = timed_ ? elapsed_seconds() : 0;
    ++own.count->calls;
    own.count->evaluations += static_cast<std::uint64_t>(lanes_);
    add_force(*own.term, *own.work, q, force);
    if (timed_) own.count->seconds += elapsed_seconds() - before;
  }
}

template <Scalar S>
void PotentialEvaluator<S>::force(Lanes<const S> q, Matrix<S>& force) {
  varying_force(q, force);
  for (Index j = 0; j < force.cols(); ++j)
    for (Index i = 0; i < force.rows(); ++i) set_sum(force(i, j), force(i, j), constant_force_[j]);
}

template <Scalar S>
void PotentialEvaluator<S>::add_force(const EffectTerm<S>& term, Work& work, Lanes<const S> q, Matrix<S>& force) {
  if constexpr (std::same_as<S, double>)
    if (work.kernel != nullptr) return work.kernel->add_force(work.sites.data(), work.sites.size(), q, force.data());
  displace_all(term, work, q);
  work.gradient.run();
  for_each_force(term, [&](Index output, Index instance, Index coordinate, const S& weight) {
    S* const f = force.data() + coordinate * lanes_;
    const S& g = work.gradient.output(output, instance * lanes_);
    if (!term.gradient.is_constant(static_cast<std::size_t>(output)))
      add_weighted(f, weight, &g, lanes_, t_);
    else
      for (Index i = 0; i < lanes_; ++i) add_weighted(f + i, weight, &g, 1, t_);
  });
}

#define HBVM_DEFINE(S) template class PotentialEvaluator<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
