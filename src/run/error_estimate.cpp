#include "run/error_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <optional>

#include "interruption.hpp"
#include "linear/vector_text.hpp"
#include "reference/exact_end.hpp"
#include "reference/store.hpp"
#include "run_beside.hpp"
#include "scalar/text.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

/// More stages than the run has. HBVM(k,s) takes as many more of both, so that what k does to the energy shows, too.
MethodPtr method_beside(const Method& method) {
  constexpr int more = 3;
  if (const HbvmMethod* const hbvm = as_hbvm(method)) return hbvm_of({hbvm->name().k + more, hbvm->name().s + more});
  const int s = (method.order() + 1) / 2 + more;
  return hbvm_of({2 * s, s});
}

/// Errors of one vector, entry by entry. What an entry is compared with has an error, too. So one that happens to be
/// met is trusted with at most two digits more than its group, the entries of a vector in space.
class Errors {
 public:
  /// \param exact may have more entries, those of driven points
  /// \param unsure by which the exact values may be off
  template <Scalar S>
  Errors(const Vector<S>& found, const Vector<Mpfr>& exact, Index group, const Mpfr& unsure = Mpfr(0)) {
    const double all = significand_bits<S>() * std::log10(double{2});
    constexpr int trusted = 100;
    for (Index i = 0; i < found.size(); ++i) {
      const Mpfr x = rounded_to<Mpfr>(raw(exactly(found[i])));
      sizes_.push_back(magnitude(x));
      differences_.push_back(magnitude(Mpfr(x - exact[i])));
      raise_to(greatest, differences_.back());
    }
    for (Index i = 0; i < found.size(); ++i) {
      const Index first = i - i % group;
      Mpfr error = differences_[static_cast<std::size_t>(i)];
      for (Index j = first; j < std::min(first + group, found.size()); ++j)
        raise_to(error, Mpfr(differences_[static_cast<std::size_t>(j)] / trusted));
      // What is exactly 0, and was found so, has all its digits.
      if (sizes_[static_cast<std::size_t>(i)] == 0 && exact[i] == 0) error = 0;
      if (error > 0) raise_to(error, unsure);
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

/// The errors of all three, in words.
void say(ErrorEstimate& estimate, const Errors& q, const Errors& p, const Errors& lambda) {
  estimate.q = to_scientific(q.greatest, 3);
  estimate.p = to_scientific(p.greatest, 3);
  if (!lambda.digits.empty()) estimate.lambda = to_scientific(lambda.greatest, 3);
  estimate.q_digits = q.digits;
  estimate.p_digits = p.digits;
  estimate.lambda_digits = lambda.digits;
}

/// A vector of a stored reference, and what its texts leave open: a unit of the last digit.
struct Stored {
  Vector<Mpfr> value;
  Mpfr unsure;

  Stored(const std::vector<std::string>& texts, int digits)
      : value(vector_of<Mpfr>(texts)), unsure(max_norm(value) / pow(Mpfr(10), digits)) {}
};

/// Comparison with a reference that was stored. \return nothing if there is none from the scene's own start, or if it
/// has too few digits to tell what is right
template <Scalar S>
std::optional<ErrorEstimate> estimate_by_store(const RunRequest& request, const Vector<S>& q, const Vector<S>& output_p,
                                               const Vector<S>& output_lambda) {
  if (request.direction == Direction::backward || request.start) return std::nullopt;
  const std::optional<FoundReference> found = find_reference(request.scene, request.until, 1);
  if (!found) return std::nullopt;
  const unsigned digits = std::max(digits_of_a_run_beside<S>(), static_cast<unsigned>(found->digits)) + 10;
  const PrecisionScope more(digits);
  const Assembled<Mpfr> scene = assemble<Mpfr>(request.scene);
  if (!scene.problem.is_conservative() && !scene.problem.redundant.empty()) return std::nullopt;
  RedundantConstraints<Mpfr> redundant(scene.problem);
  const Stored exact_q(found->state.q, found->digits), exact_p(found->state.p, found->digits),
      lambda(found->state.lambda, found->digits);
  const Vector<Mpfr> exact_lambda = redundant.multipliers(exact_q.value, lambda.value);
  if (exact_q.value.size() != q.size() || exact_p.value.size() != q.size() ||
      exact_lambda.size() != output_lambda.size())
    return std::nullopt;
  const Index d = scene.problem.dimension;
  const Errors of_q(q, exact_q.value, d, exact_q.unsure), of_p(output_p, exact_p.value, d, exact_p.unsure),
      of_lambda(output_lambda, exact_lambda, 1, lambda.unsure);
  // A hundred times what the reference leaves open is seen; of a run with fewer digits, anything.
  constexpr int more_than_the_run = 2, seen = 100;
  const bool has_all = found->digits >= significand_bits<S>() * std::log10(double{2}) + more_than_the_run;
  const auto tells = [&](const Errors& errors, const Mpfr& unsure) {
    return has_all || errors.digits.empty() || errors.greatest >= seen * unsure;
  };
  if (!tells(of_q, exact_q.unsure) || !tells(of_p, exact_p.unsure) || !tells(of_lambda, lambda.unsure))
    return std::nullopt;
  ErrorEstimate estimate;
  estimate.reference = fmt::format("stored reference, {} digits{}", found->digits, found->proved > 0 ? ", proved" : "");
  say(estimate, of_q, of_p, of_lambda);
  return estimate;
}

/// Beyond so many coordinates the series take more memory than a run.
constexpr Index most_coordinates = 20'000;

/// Comparison the exact motion, found with the digits of the scope by a route that chooses its own steps. \return
/// nothing where there is none: from a start that leaves the hidden constraints, or where forces are not smooth
template <Scalar S>
std::optional<ErrorEstimate> estimate_by_motion(const RunRequest& request, Route route,
                                                const std::optional<State<S>>& start, const Vector<S>& q,
                                                const Vector<S>& output_p, const Vector<S>& output_lambda) {
  const Assembled<Mpfr> scene = assemble<Mpfr>(request.scene);
  if (scene.problem.m() > most_coordinates) return std::nullopt;
  State<Mpfr> from(scene.q0, scene.p0);
  if (start) from = exact_state(*start);
  StateEvaluator<Mpfr> point(scene.problem);
  const Vector<Mpfr> tangential = point.tangential(from.q, from.p);
  constexpr int units = 64;
  if (start && distance(tangential, from.p) > units * Mpfr(epsilon<S>()) * max_norm(from.p)) return std::nullopt;
  const bool back = request.direction == Direction::backward;
  if (back && !scene.problem.is_conservative()) return std::nullopt;
  const TimeGrid<Mpfr> grid(request.step, request.until, request.scene.constants, request.direction,
                            LastStep::shortened);
  try {
    ExactPoint end = exact_end(scene.problem, from.q, back ? Vector<Mpfr>(-tangential) : tangential,
                               magnitude(grid.until()), route, [] { end_if_asked("the check was interrupted"); });
    if (back) end.p = -end.p;
    RedundantConstraints<Mpfr> redundant(scene.problem);
    const Index d = scene.problem.dimension;
    ErrorEstimate estimate;
    say(estimate, Errors(q, end.q, d), Errors(output_p, end.p, d),
        Errors(output_lambda, redundant.multipliers(end.q, end.lambda), 1));
    return estimate;
  } catch (const IntegrationError&) {
    return std::nullopt;
  }
}

/// Another number of steps, whose points are not those of the first.
Expression step_beside(const RunRequest& request) {
  const TimeGrid<Mpfr> grid(request.step, request.until, request.scene.constants, Direction::forward,
                            LastStep::shortened);
  const auto more = static_cast<long>(std::ceil(static_cast<double>(grid.steps()) * std::numbers::sqrt2)) + 1;
  return Expression::parse("(" + request.until.text() + ")/" + std::to_string(more));
}

}  // namespace

template <Scalar S>
ErrorEstimate estimate_error(const RunRequest& request, const Method& method, const std::optional<State<S>>& start,
                             const Vector<S>& q, const Vector<S>& output_p, const Vector<S>& output_lambda) {
  if (std::optional<ErrorEstimate> estimate = estimate_by_store(request, q, output_p, output_lambda)) return *estimate;
  const unsigned digits = digits_of_a_run_beside<S>();
  const PrecisionScope more(digits);
  ErrorEstimate estimate;
  const auto made_by = [&](const std::string& name) {
    estimate.reference = "computed now";
    estimate.method = name;
    estimate.precision = "mpfr:" + std::to_string(digits);
  };
  const Route route = method.text() == "taylor" ? Route::hbvm : Route::taylor;
  try {
    if (const auto found = estimate_by_motion(request, route, start, q, output_p, output_lambda)) {
      estimate = *found;
      made_by(name_of(route));
      return estimate;
    }
    // A run with more stages, and another step.
    const MethodPtr beside = method_beside(method);
    made_by(beside->text());
    RunRequest other = request;
    other.step = step_beside(request);
    const Simulated<Mpfr> run = run_beside(other, *beside, start);
    const Snapshot<Mpfr>& end = run.integration.end;
    const Assembled<Mpfr> scene = assemble<Mpfr>(request.scene);
    StateEvaluator<Mpfr> point(scene.problem);
    RedundantConstraints<Mpfr> redundant(scene.problem);
    const OutputState<Mpfr> output = output_state(point, end.q, end.p);
    const Index d = scene.problem.dimension;
    say(estimate, Errors(q, end.q, d), Errors(output_p, output.p, d),
        Errors(output_lambda, redundant.multipliers(end.q, output.lambda), 1));
  } catch (const Error& error) {
    if (estimate.method.empty()) made_by(name_of(route));
    estimate.failure = error.what();
  }
  return estimate;
}

#define HBVM_DEFINE(S)                                                                                       \
  template ErrorEstimate estimate_error<S>(const RunRequest&, const Method&, const std::optional<State<S>>&, \
                                           const Vector<S>&, const Vector<S>&, const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
