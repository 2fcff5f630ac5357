#include "measure.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include "integrate/integrate.hpp"
#include "problem/state_evaluator.hpp"
#include "run/round_off.hpp"
#include "scalar/literal.hpp"
#include "scalar/with_scalar.hpp"
#include "scene/assemble.hpp"
#include "step/registry.hpp"

namespace hbvm::core {
namespace {

constexpr unsigned more_digits = 20;

/// Another route to the solution of the stage equations.
SolverKind other_solver(SolverKind kind) {
  return kind == SolverKind::fixed_point || kind == SolverKind::paper ? SolverKind::newton : SolverKind::fixed_point;
}

/// The same motion in more digits, by the other solver if that can.
SampledMotion reference_of(RunRequest request, const Twist& twist) {
  request.precision = Precision::parse("mpfr:" + std::to_string(request.precision.digits() + more_digits));
  request.solver = other_solver(request.solver);
  try {
    return motion_of(request, twist);
  } catch (const StepError&) {
    request.solver = SolverKind::automatic;
    return motion_of(request, twist);
  }
}

/// Bits of the significand.
long bits_of(const Precision& precision) {
  return with_scalar(precision, []<Scalar S>() { return static_cast<long>(significand_bits<S>()); });
}

/// A coordinate's greatest error over the run, in units of what round-off and the problem's growth explain.
double units(const std::vector<const BigFloat*>& x, const std::vector<const BigFloat*>& exact,
             const std::vector<const BigFloat*>& kicked, const BigFloat& scale, long bits) {
  Mpfr error = 0, growth = 0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const Mpfr truth = rounded_to<Mpfr>(raw(*exact[n]));
    raise_to(error, magnitude(Mpfr(rounded_to<Mpfr>(raw(*x[n])) - truth)));
    raise_to(growth, magnitude(Mpfr(rounded_to<Mpfr>(raw(*kicked[n])) - truth)));
  }
  if (error == 0) return 0;
  Mpfr ulp = rounded_to<Mpfr>(raw(scale));
  mpfr_mul_2si(raw(ulp), raw(ulp), 1 - bits, MPFR_RNDN);
  return approximately(Mpfr(error / (ulp + growth)));
}

using Coordinates = std::vector<BigFloat> ExactState::*;

std::vector<const BigFloat*> series(const SampledMotion& motion, Coordinates part, std::size_t i) {
  std::vector<const BigFloat*> result;
  for (const ExactState& state : motion.samples) result.push_back(&(state.*part)[i]);
  return result;
}

CaseResult against_more_digits(const RunRequest& request, bool back) {
  const SampledMotion motion = motion_of(request, {0, back});
  try {
    const SampledMotion exact = reference_of(request, {0, back});
    const SampledMotion kicked = reference_of(request, {bits_of(request.precision) - 1, back});
    return compared(request, motion, exact, kicked);
  } catch (const IntegrationError& error) {
    // A run that nothing confirms.
    const double infinity = std::numeric_limits<double>::infinity();
    CaseResult result;
    result.criteria = {{"units of round-off and growth", infinity, round_off_units(motion.steps)}};
    result.message = std::string("the run in more digits fails: ") + error.what();
    return result;
  }
}

class TemporaryFile {
 public:
  TemporaryFile() : path_((std::filesystem::temp_directory_path() / "hbvm_stability_XXXXXX").string()) {
    const int file = mkstemp(path_.data());
    if (file < 0) throw Error("cannot create a file in '" + std::filesystem::temp_directory_path().string() + "'");
    close(file);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  ~TemporaryFile() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The greatest |T| + |U| over the lines of a trajectory.
double energy_size(const Scene& scene, std::istream& csv) {
  const Assembled<double> assembled = assemble<double>(scene, Consistency::unchecked);
  StateEvaluator<double> point(assembled.problem);
  Vector<double> q(assembled.problem.m()), p(q);
  double size = 0;
  std::string line;
  std::getline(csv, line);  // the names
  while (std::getline(csv, line)) {
    const char* at = line.c_str();
    char* end = nullptr;
    const auto next = [&] {
      const double x = std::strtod(at, &end);
      at = *end == ',' ? end + 1 : end;
      return x;
    };
    next();  // t
    for (Vector<double>* const v : {&q, &p})
      for (Index i = 0; i < v->size(); ++i) (*v)[i] = next();
    raise_to(size, point.energy_size(q, p));
  }
  return size;
}

}  // namespace

CaseResult guarded(const std::function<CaseResult()>& body) {
  CaseResult result;
  try {
    return body();
  } catch (const StepError& error) {
    result.failure = name_of(error.cause());
    result.message = error.what();
  } catch (const IntegrationError& error) {
    result.failure = "integration_error";
    result.message = error.what();
  } catch (const InputError& error) {
    result.failure = "refused";
    result.message = error.what();
  }
  return result;
}

std::vector<std::string> warnings_of(const Run& run) {
  std::vector<std::string> names;
  for (const Warning& warning : run.health.warnings) names.push_back(warning.name);
  return names;
}

RunRequest request_of(Scene scene, std::string_view method, std::string_view solver, std::string_view step,
                      std::string_view until, std::string_view precision) {
  return {std::move(scene),
          parse_method(method),
          parse_solver(solver),
          Expression::parse(step),
          Expression::parse(until),
          Precision::parse(precision),
          false};
}

CaseResult compared(const RunRequest& request, const SampledMotion& motion, const SampledMotion& exact,
                    const SampledMotion& kicked) {
  if (motion.samples.size() != exact.samples.size()) throw Error("runs in different digits have different samples");
  const long bits = bits_of(request.precision);
  const PrecisionScope digits(request.precision.digits() + more_digits);
  Criterion worst{"units of round-off and growth", 0, round_off_units(motion.steps)};
  std::string name = "none";
  for (const auto& [part, letter] : {std::pair{&ExactState::q, "q_"}, std::pair{&ExactState::p, "p_"}})
    for (std::size_t i = 0; i < (exact.scale.*part).size(); ++i) {
      const double here =
          units(series(motion, part, i), series(exact, part, i), series(kicked, part, i), (exact.scale.*part)[i], bits);
      if (here > worst.value || here != here) {
        worst.value = here;
        name = letter + std::to_string(i + 1);
      }
    }
  CaseResult result;
  result.criteria = {worst};
  result.message = "worst coordinate " + name;
  return result;
}

CaseResult accuracy(const RunRequest& request) {
  return guarded([&] { return against_more_digits(request, false); });
}

CaseResult reversal(const RunRequest& request) {
  return guarded([&] { return against_more_digits(request, true); });
}

CaseResult energy(const RunRequest& request) {
  return guarded([&] {
    const TemporaryFile file;
    RunHooks hooks;
    hooks.open_csv = [&] { return std::make_unique<CsvFile>(file.path(), CsvFile::Opening::anew); };
    const Run run = hbvm::core::run(request, hooks);
    std::ifstream csv(file.path());
    // e_H over epsilon, where no number leaves its range.
    const double units =
        evaluate<double>(Expression::parse(run.e_H + "*2^" + std::to_string(bits_of(request.precision) - 1)));
    CaseResult result;
    result.criteria = {
        {"e_H, units of round-off", units / energy_size(request.scene, csv), round_off_units(run.steps)}};
    result.warnings = warnings_of(run);
    result.message = run.method;
    return result;
  });
}

}  // namespace hbvm::core
