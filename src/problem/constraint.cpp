#include "hbvm/problem/constraint.hpp"

#include <set>

namespace hbvm {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};

template <Scalar S>
Vector<S> displaced(const Displacement<S>& x, Index dimension, const Vector<S>& q) {
  Vector<S> result = Vector<S>::Zero(dimension);
  displace(x, dimension, lanes(q), result.data(), 1);
  return result;
}

/// The same without the shift: how the displacement changes with q.
template <Scalar S>
Vector<S> moved(const Displacement<S>& x, Index dimension, const Vector<S>& v) {
  return displaced(Displacement<S>{x.blocks, {}}, dimension, v);
}

template <Scalar S>
struct Sum {
  S g = 0, size = 0;
  void add(const S& term) {
    g += term;
    size += magnitude(term);
  }
};

}  // namespace

template <Scalar S>
std::vector<Index> coordinates(const Constraint<S>& constraint, Index dimension) {
  std::set<Index> found;
  const auto block = [&](Index offset, Index size) {
    for (Index j = 0; j < size; ++j) found.insert(offset + j);
  };
  std::visit(Overloaded{[&](const DisplacementProduct<S>& f) {
                          for (const auto& b : f.x.blocks) block(b.offset, dimension);
                          for (const auto& b : f.y.blocks) block(b.offset, dimension);
                        },
                        [&](const Quadric<S>& f) { block(f.offset, f.A.rows()); },
                        [&](const Plane<S>& f) { block(f.block, f.normal.size()); }},
             constraint.form);
  return {found.begin(), found.end()};
}

template <Scalar S>
ConstraintValue<S> value(const Constraint<S>& constraint, Index dimension, const Vector<S>& q) {
  Sum<S> sum;
  std::visit(Overloaded{[&](const DisplacementProduct<S>& f) {
                          const Vector<S> x = displaced(f.x, dimension, q);
                          const Vector<S> y = f.same ? x : displaced(f.y, dimension, q);
                          // The displacements carry the round-off of what they are differences of.
                          const S spread = max_norm(q);
                          for (Index i = 0; i < dimension; ++i) {
                            sum.add(x[i] * y[i]);
                            sum.size += spread * (magnitude(x[i]) + magnitude(y[i]));
                          }
                          sum.add(-f.value);
                        },
                        [&](const Quadric<S>& f) {
                          for (Index i = 0; i < f.A.rows(); ++i) {
                            for (Index j = 0; j < f.A.cols(); ++j)
                              sum.add(q[f.offset + i] * f.A(i, j) * q[f.offset + j]);
                            sum.add(f.b[i] * q[f.offset + i]);
                          }
                          sum.add(f.c);
                        },
                        [&](const Plane<S>& f) {
                          for (Index i = 0; i < f.normal.size(); ++i) sum.add(f.normal[i] * q[f.block + i]);
                          sum.add(-f.offset);
                        }},
             constraint.form);
  return {sum.g, sum.size};
}

template <Scalar S>
S curvature(const Constraint<S>& constraint, Index dimension, const Vector<S>& v) {
  S sum = 0;
  std::visit(Overloaded{[&](const DisplacementProduct<S>& f) {
                          const Vector<S> x = moved(f.x, dimension, v);
                          const Vector<S> y = f.same ? x : moved(f.y, dimension, v);
                          for (Index i = 0; i < dimension; ++i) sum += x[i] * y[i];
                        },
                        [&](const Quadric<S>& f) {
                          for (Index i = 0; i < f.A.rows(); ++i)
                            for (Index j = 0; j < f.A.cols(); ++j) sum += v[f.offset + i] * f.A(i, j) * v[f.offset + j];
                        },
                        [](const Plane<S>&) {}},
             constraint.form);
  return 2 * sum;
}

template <Scalar S>
S curvature_size(const Constraint<S>& constraint, Index dimension, const Vector<S>& v) {
  // The same of what has no negative entries.
  const auto magnitudes = [](auto a) {
    for (Index i = 0; i < a.size(); ++i) a.data()[i] = magnitude(a.data()[i]);
    return a;
  };
  const auto displacement = [](Displacement<S> x) {
    for (auto& block : x.blocks) block.weight = magnitude(block.weight);
    return x;
  };
  Constraint<S> positive = constraint;
  std::visit(Overloaded{[&](DisplacementProduct<S>& f) {
                          f.x = displacement(f.x);
                          f.y = displacement(f.y);
                        },
                        [&](Quadric<S>& f) { f.A = magnitudes(f.A); }, [](Plane<S>&) {}},
             positive.form);
  return curvature(positive, dimension, magnitudes(v));
}

#define HBVM_DEFINE(S)                                                                 \
  template std::vector<Index> coordinates<S>(const Constraint<S>&, Index);             \
  template ConstraintValue<S> value<S>(const Constraint<S>&, Index, const Vector<S>&); \
  template S curvature<S>(const Constraint<S>&, Index, const Vector<S>&);              \
  template S curvature_size<S>(const Constraint<S>&, Index, const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
