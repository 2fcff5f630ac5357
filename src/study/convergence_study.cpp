#include "study/convergence_study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hbvm/error.hpp"
#include "interruption.hpp"
#include "linear/vector_text.hpp"
#include "reference/exact_end.hpp"
#include "run/scene_run.hpp"
#include "scalar/literal.hpp"
#include "scalar/log2_of.hpp"
#include "scalar/text.hpp"
#include "step/registry.hpp"

namespace hbvm::core {
namespace {

constexpr int more_digits = 16;

/// q, p and lambda in the digits of the scope.
using EndVectors = std::array<Vector<Mpfr>, 3>;

EndVectors end_of(const Run& run, bool propagated) {
  return {vector_of<Mpfr>(run.q), vector_of<Mpfr>(propagated ? run.p : run.output_p),
          vector_of<Mpfr>(propagated ? run.lambda : run.output_lambda)};
}

/// What the exact motion ends with, multipliers of all constraints included.
EndVectors exact_end_of(const RunRequest& request) {
  const Assembled<Mpfr> scene = assemble<Mpfr>(request.scene);
  const TimeGrid<Mpfr> grid(request.until, request.until, request.scene.constants);
  try {
    const ExactPoint end = exact_end(scene.problem, scene.q0, scene.p0, grid.until(), Route::taylor,
                                     [] { end_if_asked("the reference was interrupted"); });
    RedundantConstraints<Mpfr> redundant(scene.problem);
    const Index bodies = scene.problem.mass.of_bodies();
    return {end.q.head(bodies), end.p.head(bodies), redundant.multipliers(end.q, end.lambda)};
  } catch (const IntegrationError& error) {
    throw InputError("errors need the exact motion, which is not known: " + std::string(error.what()));
  }
}

Mpfr error_of(const Vector<Mpfr>& found, const Vector<Mpfr>& exact) {
  return exact.size() == 0 ? Mpfr(0) : distance(found, exact);
}

/// One method in one precision, step by step.
class LadderOfSteps {
 public:
  LadderOfSteps(const ConvergenceWork& work, const EndVectors& exact) : work_(work), exact_(exact) {}

  MeasuredConvergence measured(const NamedMethod& named, const Precision& precision,
                               const std::function<void(long, long)>& progress) {
    MeasuredConvergence result{named.name, named.method->text(), precision.name(), {}, {}, {}, {}};
    std::optional<Run> finest;
    for (const Expression& step : work_.steps) {
      try {
        const Run run = made(named.method, step, precision, progress);
        add(result, run);
        finest = run;
      } catch (const IntegrationError& error) {
        if (result.failure.empty()) result.failure = "step " + step.text() + ": " + error.what();
      }
    }
    if (finest) {
      result.resolved = finest->method;
      set_floors(result, *finest, precision);
    }
    for (std::size_t part = 0; part < result.rates.size(); ++part) {
      result.rates[part] = convergence_rate(result.rungs[part]);
      if (result.rates[part] && !std::isfinite(result.rates[part]->uncertainty)) result.rates[part].reset();
    }
    return result;
  }

 private:
  Run made(const MethodPtr& method, const Expression& step, const Precision& precision,
           const std::function<void(long, long)>& progress) const {
    RunRequest request = work_.request;
    request.method = method;
    request.step = step;
    request.precision = precision;
    RunHooks hooks;
    hooks.progress = progress;
    return core::run(request, hooks);
  }

  void add(MeasuredConvergence& result, const Run& run) const {
    const EndVectors end = end_of(run, work_.propagated);
    const double step = log2_of(literal<Mpfr>(run.step));
    ConvergenceStep& row = result.steps.emplace_back(ConvergenceStep{run.step, {}});
    for (std::size_t part = 0; part < end.size(); ++part) {
      if (exact_[part].size() == 0) continue;
      const Mpfr error = error_of(end[part], exact_[part]);
      constexpr int shown = 6;
      row.errors[part] = to_scientific(error, shown);
      result.rungs[part].push_back({step, log2_of(error), -std::numeric_limits<double>::infinity()});
    }
  }

  /// A few times what rounding did to the finest run, which has the most steps.
  void set_floors(MeasuredConvergence& result, const Run& finest, const Precision& precision) const {
    const Precision more = Precision::parse("mpfr:" + std::to_string(precision.digits() + more_digits));
    const Run run = made(parse_method(finest.method), work_.steps.back(), more, {});
    const EndVectors rounded = end_of(finest, work_.propagated), end = end_of(run, work_.propagated);
    constexpr double few = 2;
    for (std::size_t part = 0; part < end.size(); ++part)
      for (Rung& rung : result.rungs[part]) rung.floor = log2_of(error_of(rounded[part], end[part])) + few;
  }

  const ConvergenceWork& work_;
  const EndVectors& exact_;
};

}  // namespace

std::vector<MeasuredConvergence> measure_convergence(const ConvergenceWork& work) {
  int digits = 0;
  for (const Precision& precision : work.precisions) digits = std::max(digits, static_cast<int>(precision.digits()));
  const PrecisionScope scope(static_cast<unsigned>(digits + 2 * more_digits));
  const EndVectors exact = exact_end_of(work.request);
  long all = 0, done = 0;
  for (const Expression& step : work.steps)
    all += TimeGrid<Mpfr>(step, work.request.until, work.request.scene.constants).steps();
  all *= static_cast<long>(work.methods.size() * work.precisions.size());
  LadderOfSteps ladder(work, exact);
  std::vector<MeasuredConvergence> result;
  for (const Precision& precision : work.precisions)
    for (const NamedMethod& method : work.methods)
      result.push_back(ladder.measured(method, precision, [&](long made, long of) {
        if (work.progress) work.progress(done + made, all);
        if (made == of) done += of;
      }));
  return result;
}

std::vector<Expression> halved_steps(const std::string& range, const Constants& constants) {
  constexpr unsigned digits = 30;
  constexpr int least = 4, most = 40;
  const PrecisionScope scope(digits);
  const std::size_t colon = range.find(':');
  const std::string coarse = range.substr(0, colon), fine = colon == std::string::npos ? "" : range.substr(colon + 1);
  const std::string wanted = "steps '" + range + "': use A:B, as 1/8:1/256, where B is A over a power of 2";
  if (fine.empty()) throw InputError(wanted);
  const auto number = [&](const std::string& text) {
    try {
      return evaluate<Mpfr>(Expression::parse(text), constants);
    } catch (const ExpressionError& error) {
      throw InputError("steps " + std::string(error.what()));
    }
  };
  const Mpfr a = number(coarse), b = number(fine);
  if (!(a > 0) || !(b > 0)) throw InputError(wanted);
  const double halvings = log2_of(Mpfr(a / b));
  const auto n = static_cast<int>(std::lround(std::min(halvings, double{most + 1})));
  if (n < 0 || n > most || magnitude(Mpfr(ldexp(b, n) - a)) > 4 * epsilon<Mpfr>() * a) throw InputError(wanted);
  if (n < least) throw InputError("steps '" + range + "': a rate takes five steps at least, as 1/8:1/128");
  std::vector<Expression> steps{Expression::parse(coarse)};
  for (int i = 1; i <= n; ++i) steps.push_back(Expression::parse("(" + coarse + ")/2^" + std::to_string(i)));
  return steps;
}

Expression time_of_sixteen(const Expression& step, const Constants& constants) {
  constexpr unsigned digits = 30;
  constexpr int steps = 16;
  const PrecisionScope scope(digits);
  const Mpfr time = evaluate<Mpfr>(step, constants) * steps;
  if (time == floor(time) && time < Mpfr(1) / epsilon<Mpfr>()) return Expression::parse(to_text(time));
  return Expression::parse(std::to_string(steps) + "*(" + step.text() + ")");
}

}  // namespace hbvm::core
