#include "hbvm/analysis/run/error_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "hbvm/scalar/text.hpp"
#include "hbvm/step/hbvm_method.hpp"
#include "run_beside.hpp"

namespace hbvm {
namespace {

/// More stages than the run has. HBVM(k,s) takes as many more of both, so that what k does to the energy shows, too.
MethodPtr method_beside(const Method& method) {
  constexpr int more = 3;
  if (const HbvmMethod* const hbvm = as_hbvm(method)) return hbvm_of({hbvm->name().k + more, hbvm->name().s + more});
  const int s = (method.order() + 1) / 2 + more;
  return hbvm_of({2 * s, s});
}

/// Errors of one vector, entry by entry. An entry that happens to be met is not trusted with more than two digits
/// beyond what its group of entries, those of a vector in space, has: the run beside has an error, too.
class Errors {
 public:
  template <Scalar S>
  Errors(const Vector<S>& found, const Vector<Mpfr>& exact, Index group) {
    const double all = significand_bits<S>() * std::log10(double{2});
    constexpr int trusted = 100;
    for (Index i = 0; i < exact.size(); ++i) {
      const Mpfr x = rounded_to<Mpfr>(raw(exactly(found[i])));
      sizes_.push_back(magnitude(x));
      differences_.push_back(magnitude(Mpfr(x - exact[i])));
      raise_to(greatest, differences_.back());
    }
    for (Index i = 0; i < exact.size(); ++i) {
      const Index first = i - i % group;
      Mpfr error = differences_[static_cast<std::size_t>(i)];
      for (Index j = first; j < std::min(first + group, exact.size()); ++j)
        raise_to(error, Mpfr(differences_[static_cast<std::size_t>(j)] / trusted));
      digits.push_back(right_digits(error, sizes_[static_cast<std::size_t>(i)], all));
    }
  }

  Mpfr greatest = 0;
  std::vector<double> digits;

 private:
  static double right_digits(const Mpfr& error, const Mpfr& size, double all) {
    if (error == 0) return all;
    if (size == 0) return 0;
    const double right = -approximately(Mpfr(log10(Mpfr(error / size))));
    return right > 0 ? std::min(right, all) : 0;
  }

  std::vector<Mpfr> sizes_, differences_;
};

}  // namespace

template <Scalar S>
ErrorEstimate estimate_error(const RunRequest& request, const Method& method, const std::optional<State<S>>& start,
                             const Vector<S>& q, const Vector<S>& output_p, const Vector<S>& output_lambda) {
  const MethodPtr beside = method_beside(method);
  const unsigned digits = digits_of_a_run_beside<S>();
  const PrecisionScope more(digits);
  ErrorEstimate estimate;
  estimate.method = beside->text();
  estimate.precision = "mpfr:" + std::to_string(digits);
  try {
    const Simulated<Mpfr> run = run_beside(request, *beside, start);
    const Snapshot<Mpfr>& end = run.integration.end;
    const Assembled<Mpfr> scene = assemble<Mpfr>(request.scene);
    Point<Mpfr> point(scene.problem);
    RedundantConstraints<Mpfr> redundant(scene.problem);
    const OutputState<Mpfr> output = output_state(point, end.q, end.p);
    const Errors of_q(q, end.q, scene.problem.dimension), of_p(output_p, output.p, scene.problem.dimension),
        of_lambda(output_lambda, redundant.multipliers(end.q, output.lambda), 1);
    estimate.q = to_scientific(of_q.greatest, 3);
    estimate.p = to_scientific(of_p.greatest, 3);
    if (!of_lambda.digits.empty()) estimate.lambda = to_scientific(of_lambda.greatest, 3);
    estimate.q_digits = of_q.digits;
    estimate.p_digits = of_p.digits;
    estimate.lambda_digits = of_lambda.digits;
  } catch (const Error& error) {
    estimate.failure = error.what();
  }
  return estimate;
}

std::string to_right_digits(const std::string& number, double right) {
  return rounded_text(number, static_cast<int>(right) + 1);
}

std::string to_text(const ErrorEstimate& estimate) {
  const std::string beside = estimate.method + ", " + estimate.precision;
  if (!estimate.failure.empty()) return fmt::format("error\n  unknown: {} failed: {}\n", beside, estimate.failure);
  return fmt::format("error, against {}\n  {:<14} {}\n  {:<14} {}\n{}", beside, "q", estimate.q, "p", estimate.p,
                     estimate.lambda.empty() ? "" : fmt::format("  {:<14} {}\n", "lambda", estimate.lambda));
}

#define HBVM_DEFINE(S)                                                                                       \
  template ErrorEstimate estimate_error<S>(const RunRequest&, const Method&, const std::optional<State<S>>&, \
                                           const Vector<S>&, const Vector<S>&, const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
