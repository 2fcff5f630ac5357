// Google Benchmark of the kernels that a step is made of, in double and in 34, 50, 100, 200 and 1000 digits.

#include <benchmark/benchmark.h>

#include "linear/lu.hpp"
#include "linear/product.hpp"
#include "problem/constraint_gradient.hpp"
#include "scene/assemble.hpp"
#include "scene/scene.hpp"

namespace {

using namespace hbvm::core;

/// Calls f.operator()<S>() in double (0 digits) or in so many.
template <class F>
void in_digits(long digits, F&& f) {
  if (digits == 0) {
    f.template operator()<double>();
    return;
  }
  const PrecisionScope scope(static_cast<unsigned>(digits));
  f.template operator()<Mpfr>();
}

template <Scalar S>
Matrix<S> numbers(Index rows, Index columns) {
  using std::sqrt;
  Matrix<S> a(rows, columns);
  for (Index i = 0; i < a.size(); ++i) a.data()[i] = sqrt(S(static_cast<long>(i % 89 + 2))) - 5;
  return a;
}

void multiply(benchmark::State& state) {
  in_digits(state.range(0), [&]<Scalar S>() {
    const Matrix<S> a = numbers<S>(16, 12), b = numbers<S>(12, 9);
    Matrix<S> c(16, 9);
    for (auto _ : state) product(c, a, b);
  });
  state.SetItemsProcessed(state.iterations() * 16 * 12 * 9);
}

void factor(benchmark::State& state) {
  in_digits(state.range(0), [&]<Scalar S>() {
    const Matrix<S> a = numbers<S>(12, 12) + S(20) * Matrix<S>::Identity(12, 12);
    Lu<S> lu;
    for (auto _ : state) {
      lu.set(a);
      benchmark::DoNotOptimize(lu.factor());
    }
  });
}

void force(benchmark::State& state) {
  in_digits(state.range(0), [&]<Scalar S>() {
    const Assembled<S> scene = assemble<S>(load_scene("tethered_satellites"));
    const Index k = 16;
    PotentialEvaluator<S> potential(scene.problem.potential, k);
    Matrix<S> q(k, scene.problem.m()), result(k, scene.problem.m());
    for (Index i = 0; i < k; ++i) q.row(i) = scene.q0.transpose();
    for (auto _ : state) potential.varying_force(lanes(std::as_const(q)), result);
  });
  state.SetItemsProcessed(state.iterations() * 16 * 3);
}

void gradient(benchmark::State& state) {
  in_digits(state.range(0), [&]<Scalar S>() {
    const Assembled<S> scene = assemble<S>(load_scene("tethered_satellites"));
    const Index s = 12;
    ConstraintGradient<S> g(scene.problem, s);
    Matrix<S> q(s, scene.problem.m());
    for (Index i = 0; i < s; ++i) q.row(i) = scene.q0.transpose();
    for (auto _ : state) g.update(lanes(std::as_const(q)));
  });
}

void all_digits(benchmark::internal::Benchmark* b) {
  b->ArgName("digits");
  for (const long digits : {0, 34, 50, 100, 200, 1000}) b->Arg(digits);
}

BENCHMARK(multiply)->Apply(all_digits);
BENCHMARK(factor)->Apply(all_digits);
BENCHMARK(force)->Apply(all_digits);
BENCHMARK(gradient)->Apply(all_digits);

}  // namespace

BENCHMARK_MAIN();
