#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "compare/lost_digits.hpp"
#include "compare/results_table.hpp"
#include "door/door.hpp"
#include "hbvm/error.hpp"
#include "hbvm/order.hpp"
#include "hbvm/results.hpp"
#include "hbvm/solver.hpp"
#include "long_work/json.hpp"
#include "reference/usual_step.hpp"
#include "report/junit.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"
#include "scene/assemble.hpp"
#include "scene/scene.hpp"

namespace hbvm {
namespace {

using core::Mpfr;

/// What a text is rounded to where doubles are printed, with whatever digits.
constexpr int digits_of_double = 15, most_digits_of_double = 20;

/// Digits that the numbers of a file can have right.
int digits_in(const std::string& csv) {
  const int all = core::ResultsTable(ResultsFile{"solver", csv}).digits();
  return all <= most_digits_of_double ? std::min(all, digits_of_double) : all - 2;
}

/// A power of 2 as a decimal that is exact.
std::string exact_decimal(int log2) {
  const core::PrecisionScope scope(60);
  return core::to_text(Mpfr(ldexp(Mpfr(1), log2)));
}

/// The runs of one integrator on one scene.
class SolverTrial {
 public:
  SolverTrial(const SolverRequest& request, Scene scene) : request_(request), scene_(std::move(scene)) {
    if (request.until) {
      until_ = *request.until;
      return;
    }
    // Sixteen of the steps that resolve the motion, a power of 2: all steps of the ladder are exact then.
    const core::Expression one = core::Expression::parse("1");
    const double step = core::evaluate<double>(core::usual_step(core::scene_of(scene_), one));
    until_ = Number(exact_decimal(static_cast<int>(std::floor(std::log2(16 * step)))));
  }

  std::vector<SolverVerdict> judge() {
    std::vector<SolverVerdict> verdicts;
    using Part = SolverVerdict (SolverTrial::*)();
    for (const auto& [quantity, part] : {std::pair<const char*, Part>("order", &SolverTrial::order),
                                         {"drift", &SolverTrial::drift},
                                         {"reversal", &SolverTrial::reversal}}) {
      try {
        verdicts.push_back((this->*part)());
      } catch (const Interrupted&) {
        throw;
      } catch (const std::exception& error) {
        verdicts.push_back({.verdict = "not run", .reason = error.what()});
      }
      SolverVerdict& verdict = verdicts.back();
      verdict.scene = scene_.name();
      verdict.quantity = quantity;
      if (part == &SolverTrial::order) verdict.claimed = request_.order;
      // What fails in the first runs will fail in the others.
      if (part == &SolverTrial::order && verdict.verdict == "not run") break;
    }
    return verdicts;
  }

 private:
  /// Parts of the time, as powers of 2; and how much longer the run is that shows what H does.
  static constexpr int coarsest = 3, middle = 6, finest = 9, longer = 5;

  std::string solve(const Scene& scene, int log2_parts, int log2_length) const {
    core::end_comparison_if_asked();
    const core::PrecisionScope scope(60);
    const Mpfr until = core::evaluate<Mpfr>(core::Expression::parse(until_.text()), core::scene_of(scene_).constants);
    const std::string csv = request_.solve(
        {scene, core::to_text(Mpfr(ldexp(until, -log2_parts))), core::to_text(Mpfr(ldexp(until, log2_length)))});
    core::end_comparison_if_asked();
    return csv;
  }

  /// The step as an expression.
  std::string step_text(int log2_parts) const { return fmt::format("({})/{}", until_.text(), 1 << log2_parts); }

  /// Names of columns and the last state.
  static std::string last_line(const std::string& csv) {
    std::istringstream lines(csv);
    std::string names, last;
    for (std::string line; std::getline(lines, line);) {
      if (line.find_first_not_of(" \t\r") == std::string::npos || line.front() == '#') continue;
      (names.empty() ? names : last) = line;
    }
    return names + "\n" + last + "\n";
  }

  Comparison against(std::vector<ResultsFile> files) const {
    return compare_results({.scene = scene_, .files = std::move(files), .map = request_.map, .stop = request_.stop});
  }

  SolverVerdict order() {
    std::vector<ResultsFile> files;
    for (int parts = coarsest; parts <= finest; ++parts)
      files.push_back({fmt::format("{}, step until/{}", request_.name, 1 << parts), last_line(solve(scene_, parts, 0)),
                       step_text(parts)});
    const Comparison found = against(files);
    const double binary = std::log2(double{10});
    std::vector<StepError> ladder;
    for (std::size_t f = 0; f < files.size(); ++f) {
      const int parts = coarsest + static_cast<int>(f);
      // Rounding of each step adds up.
      const double floor = parts - binary * digits_in(files[f].csv);
      if (std::isfinite(found.files[f].error)) ladder.push_back({-double(parts), found.files[f].error * binary, floor});
    }
    error_ = found.files[middle - coarsest].error;
    SolverVerdict verdict;
    if (ladder.empty()) {
      verdict.verdict = request_.order ? "undecidable" : "seen";
      verdict.reason = "no error is above rounding";
      return verdict;
    }
    const std::optional<MeasuredRate> rate = rate_of(ladder);
    if (rate) {
      verdict.measured = rate->value;
      verdict.uncertainty = rate->uncertainty;
    }
    verdict.verdict = request_.order ? order_verdict(rate, *request_.order) : rate ? "seen" : "undecidable";
    verdict.reason =
        fmt::format("error {:.1e} to {:.1e} with steps of until/{} to until/{}", std::exp2(ladder.front().error),
                    std::exp2(ladder.back().error), 1 << coarsest, 1 << finest);
    return verdict;
  }

  /// That of five errors and more above rounding. Of four or three the last slope, as uncertain as it changes.
  static std::optional<MeasuredRate> rate_of(const std::vector<StepError>& ladder) {
    if (const std::optional<MeasuredRate> rate = measured_rate(ladder); rate && std::isfinite(rate->uncertainty))
      return rate;
    std::vector<StepError> clear;
    constexpr double above = 4;
    for (const StepError& one : ladder)
      if (one.error > one.floor + above) clear.push_back(one);
    if (clear.size() < 3) return std::nullopt;
    const auto slope = [&](std::size_t i) {
      return (clear[i - 1].error - clear[i].error) / (clear[i - 1].step - clear[i].step);
    };
    const double last = slope(clear.size() - 1), before = slope(clear.size() - 2);
    return MeasuredRate{last, std::abs(last - before)};
  }

  /// How the error of H grows over a run of many times the length. It is the greatest error in the last half of it, in
  /// the half before, and so on.
  SolverVerdict drift() {
    const std::string csv = solve(scene_, middle, longer);
    const FileComparison found = against({{request_.name, csv, step_text(middle)}}).files.front();
    SolverVerdict verdict{.verdict = "seen"};
    if (found.H_drift.empty()) {
      verdict.reason = "its states do not have all positions and velocities or momenta";
      return verdict;
    }
    const core::PrecisionScope scope(30);
    const double end = core::approximately(core::literal<Mpfr>(found.times.back()));
    constexpr std::size_t windows = 4;
    std::vector<double> greatest(windows, -std::numeric_limits<double>::infinity());
    for (std::size_t n = 0; n < found.times.size(); ++n) {
      const double part = std::log2(end / core::approximately(core::literal<Mpfr>(found.times[n])));
      const auto window = static_cast<std::size_t>(part);
      if (window < greatest.size()) greatest[window] = std::max(greatest[window], found.H_drift[n]);
    }
    const double most = *std::max_element(greatest.begin(), greatest.end());
    // Steps add up their rounding.
    if (!(most > std::log10(std::exp2(middle + longer)) - digits_in(csv))) {
      verdict.reason = fmt::format("H is kept to {}, as rounding leaves it", power(most));
      return verdict;
    }
    const double binary = std::log2(double{10});
    std::vector<double> slopes;
    for (std::size_t w = 0; w + 1 < greatest.size(); ++w)
      if (std::isfinite(greatest[w]) && std::isfinite(greatest[w + 1]))
        slopes.push_back(binary * (greatest[w] - greatest[w + 1]));
    if (slopes.empty()) {
      verdict.reason = "too few times are given to see how the error of H grows";
      return verdict;
    }
    const auto [least, largest] = std::minmax_element(slopes.begin(), slopes.end());
    double sum = 0;
    for (const double slope : slopes) sum += slope;
    verdict.measured = sum / static_cast<double>(slopes.size());
    verdict.uncertainty = (*largest - *least) / 2;
    constexpr double half = 1 / double{2};
    verdict.reason = fmt::format(
        "the error of H is {} and {}", power(most),
        *verdict.measured > half ? fmt::format("grows as t^{:.1f}", *verdict.measured) : std::string("stays bounded"));
    return verdict;
  }

  static std::string power(double log10) {
    return std::isfinite(log10) ? fmt::format("{:.0e}", std::pow(10, log10)) : std::string("0");
  }

  /// There, and back from what it says is the end, with velocities turned round.
  SolverVerdict reversal() {
    SolverVerdict verdict{.verdict = "seen"};
    if (!core::scene_of(scene_).rigid_bodies.empty()) {
      verdict.reason = "not looked at where there are rigid bodies";
      return verdict;
    }
    const std::optional<Return> coarse = return_to_start(middle - 1), fine = return_to_start(middle);
    if (!coarse || !fine) {
      verdict.reason = "its states do not have all positions and velocities or momenta";
      return verdict;
    }
    verdict.measured = std::min<double>(-fine->off, fine->digits);
    // A solver of equations may stop above rounding, far below the error. That does not fall with the step.
    const double rounding = std::log10(std::exp2(middle + 1)) - fine->digits, twice = std::log10(double{2});
    constexpr double below = 2;
    const bool is_symmetric = fine->off < rounding || (coarse->off - fine->off < twice && fine->off < error_ - below);
    verdict.reason = fmt::format("{}: it comes back to {} where its error is {}",
                                 is_symmetric ? "symmetric" : "not symmetric", power(fine->off), power(error_));
    return verdict;
  }

  /// How far a run back ends from the start, as log10, and to how many digits that could be seen.
  struct Return {
    double off = 0;
    int digits = 0;
  };
  std::optional<Return> return_to_start(int log2_parts) const {
    const core::Scene scene = core::scene_of(scene_);
    const std::optional<core::Scene> there = turned_end(scene, solve(scene_, log2_parts, 0));
    if (!there) return std::nullopt;
    const std::string csv = solve(read_scene(core::write_scene(*there), scene_.name()), log2_parts, 0);
    const std::optional<core::Scene> back = turned_end(scene, csv);
    if (!back) return std::nullopt;
    return Return{distance(scene, *back), digits_in(csv)};
  }

  /// A scene that starts where a run ended, with velocities turned round. Nothing if its columns do not tell.
  std::optional<core::Scene> turned_end(const core::Scene& scene, const std::string& csv) const {
    const core::PrecisionScope scope(60);
    const ResultsFile file{request_.name, csv};
    const core::ResultsTable rows(file);
    core::ComparisonRequest request;
    request.scene = scene;
    request.map = request_.map;
    const core::ResultsColumns columns(request, file, rows);
    columns.check_numbers();
    const auto ended = [&](const std::vector<std::string>& names, std::size_t at, bool turn) {
      core::SceneVector entries;
      for (std::size_t i = at; i < at + static_cast<std::size_t>(scene.dimension); ++i) {
        const core::ResultsColumns::Reading* const reading = columns.find(names[i]);
        if (!reading) return core::SceneVector();
        const Mpfr value = columns.value(*reading, rows.cells.size() - 1);
        entries.push_back(core::Expression::parse(core::to_text(Mpfr(turn ? -value : value))));
      }
      return entries;
    };
    core::Scene result = scene;
    std::size_t at = 0;
    for (core::SceneBody& body : result.bodies) {
      body.position = ended(columns.positions(), at, false);
      body.velocity = ended(columns.velocities(), at, true);
      body.momentum = body.velocity.empty() ? ended(columns.momenta(), at, true) : core::SceneVector();
      if (body.position.empty() || (body.velocity.empty() && body.momentum.empty())) return std::nullopt;
      at += static_cast<std::size_t>(scene.dimension);
    }
    return result;
  }

  /// log10 of how far two starts are apart, over the size of q and p.
  static double distance(const core::Scene& one, const core::Scene& other) {
    const core::PrecisionScope scope(60);
    const auto a = core::assemble<Mpfr>(one, core::Consistency::unchecked),
               b = core::assemble<Mpfr>(other, core::Consistency::unchecked);
    const auto apart = [](const core::Vector<Mpfr>& x, const core::Vector<Mpfr>& y, const core::Vector<Mpfr>& size) {
      return core::log10_of(core::max_norm(core::Vector<Mpfr>(x - y))) - core::log10_of(core::max_norm(size));
    };
    const core::Vector<Mpfr>& moving = core::max_norm(a.p0) > 0 ? a.p0 : a.problem.mass.momentum(a.q0);
    return std::max(apart(a.q0, b.q0, a.q0), apart(a.p0, b.p0, moving));
  }

  const SolverRequest& request_;
  Scene scene_;
  Number until_{1};
  double error_ = 0;
};

std::string text_of(const SolverVerdict& verdict) {
  std::string text = fmt::format("{}: {}", verdict.quantity, verdict.verdict);
  if (verdict.quantity == "order") {
    if (verdict.measured) text += fmt::format(", {:.2f} +- {:.2f}", *verdict.measured, *verdict.uncertainty);
    if (verdict.claimed) text += fmt::format(", claimed {}", *verdict.claimed);
  }
  return text + "; " + verdict.reason;
}

}  // namespace

SolverAudit audit_solver(const SolverRequest& request) {
  const core::Admitted admitted(request.stop);
  if (!request.solve) throw InputError("no solver is given");
  if (request.order && *request.order < 1) throw InputError("an order is 1 or more");
  std::vector<Scene> scenes = request.scenes;
  if (scenes.empty())
    for (const char* const name : {"simple_pendulum", "conical_pendulum", "double_pendulum"})
      scenes.push_back(load_scene(name));
  SolverAudit audit{.name = request.name, .verdicts = {}};
  for (std::size_t n = 0; n < scenes.size(); ++n) {
    if (request.progress) request.progress(static_cast<double>(n) / static_cast<double>(scenes.size()));
    const std::vector<SolverVerdict> verdicts = SolverTrial(request, scenes[n]).judge();
    audit.verdicts.insert(audit.verdicts.end(), verdicts.begin(), verdicts.end());
  }
  const auto all = [&](const auto& is) { return std::all_of(audit.verdicts.begin(), audit.verdicts.end(), is); };
  audit.holds = all([](const SolverVerdict& v) { return v.verdict != "fails"; });
  audit.decided = all([](const SolverVerdict& v) { return v.verdict != "not run" && v.verdict != "undecidable"; });
  return audit;
}

std::string to_text(const SolverAudit& audit) {
  std::string text, scene;
  for (const SolverVerdict& verdict : audit.verdicts) {
    if (verdict.scene != scene) text += (scene = verdict.scene) + "\n";
    text += "  " + text_of(verdict) + "\n";
  }
  return text + (!audit.holds ? "fails\n" : audit.decided ? "holds\n" : "undecided\n");
}

std::string to_junit(const SolverAudit& audit) {
  std::vector<core::JunitCase> cases;
  for (const SolverVerdict& v : audit.verdicts)
    cases.push_back({.group = v.scene,
                     .name = v.quantity,
                     .outcome = v.verdict == "fails"                          ? core::JunitCase::Outcome::failed
                                : v.verdict == "holds" || v.verdict == "seen" ? core::JunitCase::Outcome::passed
                                                                              : core::JunitCase::Outcome::skipped,
                     .message = text_of(v)});
  return core::junit_xml(audit.name, cases);
}

std::string to_json(const SolverAudit& audit) {
  core::OrderedJson verdicts = core::OrderedJson::array();
  const auto number = [](const std::optional<double>& x) {
    return x ? core::json_number(*x) : core::OrderedJson(nullptr);
  };
  for (const SolverVerdict& v : audit.verdicts)
    verdicts.push_back({{"scene", v.scene},
                        {"quantity", v.quantity},
                        {"verdict", v.verdict},
                        {"claimed", v.claimed ? core::OrderedJson(*v.claimed) : core::OrderedJson(nullptr)},
                        {"measured", number(v.measured)},
                        {"uncertainty", number(v.uncertainty)},
                        {"reason", v.reason}});
  return core::dumped(
      {{"name", audit.name}, {"verdicts", verdicts}, {"holds", audit.holds}, {"decided", audit.decided}}, 2);
}

}  // namespace hbvm
