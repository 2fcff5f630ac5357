#include "reference/agreement.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "problem/momenta.hpp"
#include "problem/state_evaluator.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {

long decimal_exponent(const Mpfr& x) {
  const std::string text = to_scientific(x, 25);
  return std::stol(text.substr(text.find('e') + 1));
}

std::string to_digit(const Mpfr& x, long last) {
  if (x == 0) return "0";
  const long leading = decimal_exponent(x);
  if (leading < last) {
    // Half a unit of the last digit and more is one.
    const std::string text = to_scientific(magnitude(x), 2);
    if (leading + 1 < last || text < "5") return "0";
    return fmt::format("{}1e{}", x < 0 ? "-" : "", last);
  }
  return rounded_text(to_text(x), static_cast<int>(leading - last + 1));
}

namespace {

Vector<Mpfr> single(const Mpfr& x) { return Vector<Mpfr>::Constant(1, x); }

/// max |a - b| over all pairs of the values.
Mpfr spread(const std::vector<Vector<Mpfr>>& values) {
  Mpfr result = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t j = i + 1; j < values.size(); ++j) raise_to(result, distance(values[i], values[j]));
  return result;
}

/// Of the vectors at a time: those before it are q, p and lambda; H is the first that the motion conserves.
constexpr std::size_t first_conserved = 3;

}  // namespace

long Agreement::State::agreed() const {
  long least = vectors.front().agreed;
  for (const Compared& c : vectors) least = std::min(least, c.agreed);
  return least;
}

Agreement::Agreement(const Assembled<Mpfr>& scene, const std::vector<Expression>& times,
                     const std::vector<NamedRun>& runs, int digits)
    : digits_(digits) {
  for (const Expression& t : times) times_.push_back(t.text());
  const std::vector<MomentumComponent<Mpfr>> momenta = conserved_momenta(scene.problem);
  for (const MomentumComponent<Mpfr>& component : momenta) momentum_names_.push_back(component.name());
  StateEvaluator<Mpfr> point(scene.problem);
  states_.resize(times.size());
  for (const NamedRun& run : runs) {
    routes_.push_back(run.name);
    if (run.run.points.size() != times.size())
      throw IntegrationError(
          fmt::format("route {} found {} of {} times", run.name, run.run.points.size(), times.size()));
    for (std::size_t n = 0; n < times.size(); ++n) {
      const ExactPoint& at = run.run.points[n];
      std::size_t v = 0;
      const auto add = [&](const std::string& name, const Vector<Mpfr>& value, const Mpfr& natural) {
        std::vector<Compared>& vectors = states_[n].vectors;
        if (v == vectors.size()) vectors.push_back({name, {}, Mpfr(0)});
        Compared& c = vectors[v++];
        if (!c.values.empty() && c.values.front().size() != value.size())
          throw IntegrationError(fmt::format("route {} has {} components of {} at t = {}, and route {} has {}",
                                             run.name, value.size(), name, times_[n], routes_.front(),
                                             c.values.front().size()));
        for (Index j = 0; j < value.size(); ++j)
          if (!is_finite(value[j]))
            throw IntegrationError(
                fmt::format("{}_{} is not finite at t = {} by route {}", name, j + 1, times_[n], run.name));
        c.values.push_back(value);
        raise_to(c.natural, natural);
      };
      const Index bodies = scene.problem.mass.of_bodies();
      add("q", at.q.head(bodies), Mpfr(0));
      add("p", at.p.head(bodies), Mpfr(0));
      add("lambda", at.lambda, Mpfr(0));
      add("H", single(point.energy(at.q, at.p)), point.energy_size(at.q, at.p));
      // A component that vanishes is measured by the others of its vector.
      std::vector<MomentumValue<Mpfr>> values;
      Mpfr linear = 0, angular = 0;
      for (const MomentumComponent<Mpfr>& component : momenta) {
        values.push_back(momentum(scene.problem, component, at.q, at.p));
        raise_to(component.is_linear() ? linear : angular, values.back().size);
      }
      for (std::size_t i = 0; i < momenta.size(); ++i)
        add(momenta[i].name(), single(values[i].value), momenta[i].is_linear() ? linear : angular);
    }
  }
  // What is conserved must be what it was at the start, too. Nothing that the routes' states are compared by is as
  // blind to a formula of H that does not belong to the forces.
  for (State& state : states_) {
    if (!scene.problem.is_conservative()) break;
    const auto add = [&](std::size_t v, const Mpfr& value) {
      state.vectors[first_conserved + v].values.push_back(single(value));
    };
    add(0, point.energy(scene.q0, scene.p0));
    for (std::size_t i = 0; i < momenta.size(); ++i)
      add(i + 1, momentum(scene.problem, momenta[i], scene.q0, scene.p0).value);
  }
  count_digits();
}

void Agreement::count_digits() {
  const long all = digits10<Mpfr>();
  for (std::size_t v = 0; v < states_.front().vectors.size(); ++v) {
    Mpfr greatest = 0;
    for (const State& state : states_) {
      raise_to(greatest, max_norm(state.vectors[v].values.front()));
      raise_to(greatest, state.vectors[v].natural);
    }
    const long natural = greatest == 0 ? 0 : decimal_exponent(greatest);
    for (State& state : states_) {
      Compared& c = state.vectors[v];
      const Mpfr size = max_norm(c.values.front()), difference = spread(c.values);
      c.leading = size == 0 ? natural : decimal_exponent(size);
      if (c.leading < natural - digits_) c.leading = natural;
      c.agreed = difference == 0 ? all : std::min(all, c.leading - decimal_exponent(difference) - 1);
    }
  }
}

long Agreement::digits() const {
  long least = states_.front().agreed();
  for (const State& state : states_) least = std::min(least, state.agreed());
  return least;
}

void Agreement::require() const {
  for (std::size_t n = 0; n < states_.size(); ++n)
    for (const Compared& c : states_[n].vectors)
      if (c.agreed <= digits_) fail(n, c);
}

void Agreement::fail(std::size_t time, const Compared& c) const {
  Index worst = 0;
  Mpfr most = 0;
  for (Index j = 0; j < c.values.front().size(); ++j)
    for (const Vector<Mpfr>& a : c.values) {
      const Mpfr difference = magnitude(Mpfr(a[j] - c.values.front()[j]));
      if (difference > most) {
        most = difference;
        worst = j;
      }
    }
  constexpr long fewest = 6, most_shown = 60;
  const int shown = static_cast<int>(std::max(fewest, std::min(c.agreed, most_shown) + 5));
  const std::string what =
      c.values.front().size() > 1 || c.name == "lambda" ? fmt::format("{}_{}", c.name, worst + 1) : c.name;
  std::vector<Disagreement::Value> values;
  std::string list;
  for (std::size_t r = 0; r < c.values.size(); ++r) {
    const bool is_start = r == routes_.size();
    values.push_back({is_start ? "start" : routes_[r], to_scientific(c.values[r][worst], shown)});
    list += fmt::format("{}{} {} {}",
                        r == 0                     ? ""
                        : r + 1 == c.values.size() ? " and "
                                                   : ", ",
                        values[r].number, is_start ? "at the" : "by", values[r].route);
  }
  throw Disagreement(fmt::format("the routes agree in {} digits of {}, not in {}, at t = {}: {} is {}; nothing is "
                                 "given out",
                                 std::max(0L, c.agreed), c.name, digits_, times_[time], what, list),
                     times_[time], what, values);
}

std::vector<ReferenceState> Agreement::states() const {
  std::vector<ReferenceState> result;
  for (std::size_t n = 0; n < states_.size(); ++n) {
    ReferenceState& out = result.emplace_back();
    out.t = times_[n];
    out.agreed = routes_.size() > 1 ? states_[n].agreed() : 0;
    for (std::size_t v = 0; v < states_[n].vectors.size(); ++v) {
      const Compared& c = states_[n].vectors[v];
      std::vector<std::string> texts;
      for (const Mpfr& x : c.values.front()) texts.push_back(to_digit(x, c.leading - digits_));
      // In the order in which they were added.
      if (v == 0)
        out.q = texts;
      else if (v == 1)
        out.p = texts;
      else if (v == 2)
        out.lambda = texts;
      else if (v == first_conserved)
        out.H = texts.front();
      else
        out.momenta.push_back(texts.front());
    }
  }
  return result;
}

}  // namespace hbvm::core
