#include "problem/effect/compile.hpp"

#include <algorithm>

#include "hbvm/error.hpp"
#include "problem/effect/execution.hpp"

namespace hbvm::core {
namespace {

/// Second derivatives by very many inputs take that many; what compiles would take as long to run.
constexpr std::size_t most_operations = 200'000;

}  // namespace

template <Scalar S>
void compile(Trace<S>& trace, typename Trace<S>::Id U, std::size_t inputs, std::size_t parameters,
             const std::vector<std::vector<S>>& values, EffectTerm<S>& term) {
  const auto gradient_ids = trace.gradient(U, inputs);
  std::vector<typename Trace<S>::Id> hessian_ids;
  for (std::size_t i = 0; i < inputs; ++i) {
    const auto row = trace.gradient(gradient_ids[i], inputs);
    hessian_ids.insert(hessian_ids.end(), row.begin(), row.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    if (trace.size() > most_operations) throw InputError("its second derivatives take too many operations");
  }
  auto value = trace.compile({U}, inputs, parameters);
  auto gradient = trace.compile(gradient_ids, inputs, parameters);
  auto hessian = trace.compile(hessian_ids, inputs, parameters);
  term.degree = trace.degree(U);
  term.constant_force = true;
  for (const auto id : gradient_ids) term.constant_force = term.constant_force && trace.degree(id) == 0;
  Matrix<S> own(static_cast<Index>(values.size()), static_cast<Index>(parameters));
  for (std::size_t n = 0; n < values.size(); ++n)
    std::copy(values[n].begin(), values[n].end(), own.row(static_cast<Index>(n)).begin());
  term.value_coefficients = outputs_of(value.coefficients, Matrix<S>(), own);
  term.gradient_coefficients = outputs_of(gradient.coefficients, Matrix<S>(), own);
  term.hessian_coefficients = outputs_of(hessian.coefficients, Matrix<S>(), own);
  term.value = std::move(value.program);
  term.gradient = std::move(gradient.program);
  term.hessian = std::move(hessian.program);
}

#define HBVM_DEFINE(S)                                                                 \
  template void compile<S>(Trace<S>&, typename Trace<S>::Id, std::size_t, std::size_t, \
                           const std::vector<std::vector<S>>&, EffectTerm<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
