#include "problem/potential.hpp"

#include <utility>

#include "clock.hpp"
#include "linear/arrays.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {

template <Scalar S>
PotentialEvaluator<S>::Work::Work(const EffectTerm<S>& term, Index dimension, Index lanes)
    : displacement(Matrix<S>::Zero(term.instances() * lanes, term.arguments * dimension)),
      value(term.value, term.value_coefficients, displacement, lanes) {
  if constexpr (std::same_as<S, double>)
    if (term.arguments == 1)
      kernel = KernelUse::find(term.gradient, dimension, term.displacements, term.gradient_coefficients);
}

namespace {

template <Scalar S>
OperationCounts displacements_of(const EffectTerm<S>& term, Index dimension) {
  OperationCounts counts;
  for (const Displacement<S>& x : term.displacements) counts += operations(x, dimension);
  return counts;
}

/// One evaluation at a node: the displacements, the program for each body or pair, the sum into the force.
template <Scalar S>
OperationCounts operations_of(const EffectTerm<S>& term, Index dimension) {
  OperationCounts counts = displacements_of(term, dimension);
  for (const Displacement<S>& x : term.displacements)
    for (const auto& block : x.blocks) counts += weighted_sum(block.weight, dimension);
  counts += static_cast<std::uint64_t>(term.instances()) * term.gradient.operations();
  return counts;
}

template <Scalar S>
JointProgram<S> joined(const std::vector<const EffectTerm<S>*>& terms, Index inputs) {
  std::vector<JointPart<S>> parts;
  for (const EffectTerm<S>* term : terms)
    parts.push_back({&term->gradient, static_cast<std::size_t>(term->gradient_coefficients.cols())});
  return join(parts, static_cast<std::size_t>(inputs));
}

/// The coefficients of one term beside those of another, instance by instance.
template <Scalar S>
Matrix<S> coefficients_of(const std::vector<const EffectTerm<S>*>& terms) {
  Index columns = 0;
  for (const EffectTerm<S>* term : terms) columns += term->gradient_coefficients.cols();
  Matrix<S> result(terms.front()->instances(), columns);
  columns = 0;
  for (const EffectTerm<S>* term : terms) {
    const Matrix<S>& own = term->gradient_coefficients;
    result.middleCols(columns, own.cols()) = own;
    columns += own.cols();
  }
  return result;
}

}  // namespace

template <Scalar S>
PotentialEvaluator<S>::Joint::Joint(const std::vector<const EffectTerm<S>*>& terms, const Matrix<S>& displacement,
                                    Index lanes)
    : code(joined(terms, displacement.cols())), gradient(code.program, coefficients_of(terms), displacement, lanes) {
  if constexpr (std::same_as<S, double>)
    if (terms.front()->arguments == 1)
      kernel = KernelUse::find(code.program, displacement.cols(), terms.front()->displacements, coefficients_of(terms));
}

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
    Execution<S> gradient(term.gradient, term.gradient_coefficients, work.displacement, lanes);
    gradient.run();
    counts_[t].calls = counts_[t].evaluations = 1;
    for_each_force(term, [&](Index output, Index instance, Index coordinate, const S& weight) {
      add_weighted(&constant_force_[coordinate], weight, &gradient.output(output, instance * lanes), 1, t_);
    });
  }
  join_gradients();
}

template <Scalar S>
void PotentialEvaluator<S>::join_gradients() {
  for (auto leader = varying_.begin(); leader != varying_.end(); ++leader) {
    if (leader->joint != nullptr) continue;
    const bool compiled = leader->work->kernel.has_value();
    std::vector<Varying*> alike;
    std::vector<const EffectTerm<S>*> terms;
    for (auto other = leader; other != varying_.end(); ++other) {
      if (other->joint != nullptr || other->work->kernel.has_value() != compiled ||
          !acts_alike(*leader->term, *other->term))
        continue;
      alike.push_back(&*other);
      terms.push_back(other->term);
    }
    if (compiled && alike.size() == 1) continue;
    Joint& joint = joints_.emplace_back(terms, leader->work->displacement, lanes_);
    if (compiled && !joint.kernel) {
      joints_.pop_back();
      continue;
    }
    std::size_t done = 0;
    Index output = 0;
    for (std::size_t n = 0; n < alike.size(); ++n) {
      Varying& own = *alike[n];
      own.joint = &joint;
      own.first = std::exchange(done, joint.code.ends[n]);
      own.end = done;
      own.output = output;
      output += static_cast<Index>(own.term->gradient.outputs());
      if (n == 0) continue;
      const OperationCounts known = own.term->gradient.operations() - joint.code.program.operations(own.first, own.end);
      own.count->done_before =
          displacements_of(*own.term, potential_.dimension) + static_cast<std::uint64_t>(own.term->instances()) * known;
    }
  }
}

template <Scalar S>
void PotentialEvaluator<S>::take_apart() {
  for (Varying& own : varying_) {
    if (own.joint == nullptr || !own.joint->kernel) continue;
    own.joint = nullptr;
    own.count->done_before = {};
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
void PotentialEvaluator<S>::values(Lanes<const S> q, Vector<S>& U) {
  U.setZero(lanes_);
  for (std::size_t t = 0; t < potential_.terms.size(); ++t) {
    displace(potential_.terms[t], potential_.dimension, q, work_[t].displacement);
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
  if (MeasuredParts::on()) take_apart();
  for (const Varying& own : varying_) {
    const PartTimer timer(own.count->seconds);
    ++own.count->calls;
    own.count->evaluations += static_cast<std::uint64_t>(lanes_);
    add_force(own, q, force);
  }
}

template <Scalar S>
void PotentialEvaluator<S>::force(Lanes<const S> q, Matrix<S>& force) {
  varying_force(q, force);
  for (Index j = 0; j < force.cols(); ++j)
    for (Index i = 0; i < force.rows(); ++i) set_sum(force(i, j), force(i, j), constant_force_[j]);
}

template <Scalar S>
void PotentialEvaluator<S>::add_force(const Varying& own, Lanes<const S> q, Matrix<S>& force) {
  const bool leads = own.output == 0;
  if constexpr (std::same_as<S, double>) {
    if (own.joint == nullptr) return own.work->kernel->add_force(q, force.data());
    if (own.joint->kernel) {
      if (leads) own.joint->kernel->add_force(q, force.data());
      return;
    }
  }
  Joint& joint = *own.joint;
  if (leads) displace(*own.term, potential_.dimension, q, own.work->displacement);
  joint.gradient.run(own.first, own.end);
  for_each_force(*own.term, [&](Index output, Index instance, Index coordinate, const S& weight) {
    S* const f = force.data() + coordinate * lanes_;
    const S& g = joint.gradient.output(own.output + output, instance * lanes_);
    if (!joint.code.program.is_constant(static_cast<std::size_t>(own.output + output)))
      add_weighted(f, weight, &g, lanes_, t_);
    else
      for (Index i = 0; i < lanes_; ++i) add_weighted(f + i, weight, &g, 1, t_);
  });
}

#define HBVM_DEFINE(S) template class PotentialEvaluator<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
