#include "compare/compare_methods.hpp"

#include <algorithm>

#include "hbvm/error.hpp"
#include "interruption.hpp"
#include "linear/vector_text.hpp"
#include "reference/exact_end.hpp"
#include "run/scene_run.hpp"

namespace hbvm::core {
namespace {

RecordedMethod run_method(RunRequest request, const NamedMethod& named,
                          const std::function<void(long, long)>& progress) {
  request.method = named.method;
  RecordedMethod one;
  one.figures.method = named.name;
  one.figures.resolved = named.method->text();
  RunHooks hooks;
  hooks.progress = progress;
  hooks.recording = &one.recording;
  try {
    Run run = core::run(request, hooks);
    one.figures.e_H = run.e_H;
    one.figures.e_g = run.e_g;
    one.figures.e_hid = run.e_hid;
    one.figures.cpu_seconds = run.cpu_seconds;
    one.figures.resolved = run.method;
    one.figures.warnings = std::move(run.health.warnings);
    one.q = std::move(run.q);
  } catch (const IntegrationError& error) {
    one.figures.failure = error.what();
  }
  return one;
}

}  // namespace

std::vector<RecordedMethod> run_methods(const RunRequest& request, const std::vector<NamedMethod>& methods,
                                        const std::function<void(long, long)>& progress) {
  std::vector<RecordedMethod> runs;
  const auto all = static_cast<long>(methods.size());
  for (const NamedMethod& method : methods) {
    const auto before = static_cast<long>(runs.size());
    runs.push_back(run_method(request, method, [&](long done, long of) {
      if (progress) progress(before * of + done, all * of);
    }));
  }
  return runs;
}

std::string count_digits(const RunRequest& request, std::vector<RecordedMethod>& runs) {
  constexpr unsigned more = 16;
  const auto all = static_cast<double>(request.precision.digits());
  const PrecisionScope scope(request.precision.digits() + more);
  const Assembled<Mpfr> scene = assemble<Mpfr>(request.scene);
  const TimeGrid<Mpfr> grid(request.step, request.until, request.scene.constants, request.direction,
                            LastStep::shortened);
  try {
    const ExactPoint end = exact_end(scene.problem, scene.q0, scene.p0, grid.until(), Route::taylor,
                                     [] { end_if_asked("the reference was interrupted"); });
    const Vector<Mpfr> q = end.q.head(scene.problem.mass.of_bodies());
    const Mpfr size = max_norm(q);
    for (RecordedMethod& run : runs) {
      if (run.q.empty()) continue;
      const Mpfr error = distance(vector_of<Mpfr>(run.q), q);
      const double digits = error == 0 ? all : size == 0 ? 0 : -approximately(Mpfr(log10(Mpfr(error / size))));
      run.figures.digits = std::clamp(digits, double{0}, all);
    }
  } catch (const IntegrationError& error) {
    return error.what();
  }
  return {};
}

}  // namespace hbvm::core
