#include "hbvm/reference/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <mutex>

#include "hbvm/checksum.hpp"
#include "hbvm/problem/momenta.hpp"
#include "hbvm/problem/point.hpp"
#include "hbvm/reference/reference_motion.hpp"
#include "hbvm/reference/route_run.hpp"
#include "hbvm/scalar/literal.hpp"
#include "hbvm/scalar/text.hpp"

namespace hbvm {
namespace {

/// floor(log10 |x|), the exponent of the leading digit; x is not 0.
long decimal_exponent(const Mpfr& x) {
  const std::string text = to_scientific(x, 25);
  return std::stol(text.substr(text.find('e') + 1));
}

/// x to the digit of 10^last.
std::string to_digit(const Mpfr& x, long last) {
  if (x == 0) return "0";
  const long leading = decimal_exponent(x);
  if (leading < last) return "0";
  return rounded_text(to_text(x), static_cast<int>(leading - last + 1));
}

/// A vector of each route at one time, and the size by which its digits are counted.
struct Compared {
  std::string name;
  Vector<Mpfr> value, other;
  Mpfr natural = 0;  ///< the size of the terms that it is a sum of, if it is a sum
  long leading = 0;  ///< decimal exponent of the greatest component
  long agreed = 0;   ///< digits after it
};

/// All vectors at one time.
struct ComparedState {
  std::vector<Compared> vectors;
  long agreed() const {
    long least = vectors.front().agreed;
    for (const Compared& c : vectors) least = std::min(least, c.agreed);
    return least;
  }
};

/// What is 0 but for rounding is measured by its terms, or by what it is at other times.
void count_digits(std::vector<ComparedState>& states, int digits) {
  const long all = digits10<Mpfr>();
  for (std::size_t v = 0; v < states.front().vectors.size(); ++v) {
    Mpfr greatest = 0;
    for (const ComparedState& state : states) {
      raise_to(greatest, max_norm(state.vectors[v].value));
      raise_to(greatest, state.vectors[v].natural);
    }
    const long natural = greatest == 0 ? 0 : decimal_exponent(greatest);
    for (ComparedState& state : states) {
      Compared& c = state.vectors[v];
      const Mpfr size = max_norm(c.value), difference = distance(c.value, c.other);
      c.leading = size == 0 ? natural : decimal_exponent(size);
      if (c.leading < natural - digits) c.leading = natural;
      c.agreed = difference == 0 ? all : std::min(all, c.leading - decimal_exponent(difference) - 1);
    }
  }
}

Vector<Mpfr> single(const Mpfr& x) { return Vector<Mpfr>::Constant(1, x); }

std::vector<Mpfr> evaluated(const std::vector<Expression>& times, const Constants& constants) {
  std::vector<Mpfr> result;
  for (const Expression& t : times) result.push_back(evaluate<Mpfr>(t, constants));
  return result;
}

void check(const ReferenceRequest& request) {
  if (request.digits < least_reference_digits || request.digits > most_reference_digits)
    throw InputError(fmt::format("a reference has {} to {} digits, not {}", least_reference_digits,
                                 most_reference_digits, request.digits));
  if (request.times.empty()) throw InputError("a reference needs a time");
  const PrecisionScope scope(50);
  Mpfr last = 0;
  for (const Expression& time : request.times) {
    const Mpfr t = evaluate<Mpfr>(time, request.scene.constants);
    if (!(t > last))
      throw InputError("the times of a reference are positive and ascend: '" + time.text() + "' does not");
    last = t;
  }
}

/// Both runs at once, each in a thread of its own with the digits of the scope.
struct Pair {
  RouteRun taylor, hbvm;
};

class Attempt {
 public:
  Attempt(const ReferenceRequest& request, const MotionNature& nature, int guard)
      : request_(request),
        nature_(nature),
        digits_(static_cast<unsigned>(request.digits + std::ceil(nature.digits_lost) + guard)) {}

  unsigned digits() const { return digits_; }

  std::vector<RouteRun> run() {
    std::vector<std::future<RouteRun>> futures;
    for (const Route route : {Route::taylor, Route::hbvm})
      if (!request_.only || *request_.only == route)
        futures.push_back(std::async(std::launch::async, [this, route] { return run(route); }));
    std::vector<RouteRun> runs;
    std::exception_ptr failure;
    for (auto& future : futures) try {
        runs.push_back(future.get());
      } catch (...) {
        if (!failure) failure = std::current_exception();
      }
    if (failure) std::rethrow_exception(failure);
    return runs;
  }

 private:
  RouteRun run(Route route) {
    const PrecisionScope scope(digits_);
    const Assembled<Mpfr> scene = assemble<Mpfr>(request_.scene);
    const std::vector<Mpfr> times = evaluated(request_.times, request_.scene.constants);
    double& own = route == Route::taylor ? taylor_done_ : hbvm_done_;
    const RouteProgress progress = [&](double part) {
      if (!request_.progress) return;
      const std::lock_guard lock(reporting_);
      own = part;
      request_.progress(request_.only ? part : std::min(taylor_done_, hbvm_done_));
    };
    if (route == Route::taylor) return taylor_route(scene, times, progress);
    // What errors grow by, and a few for their sum.
    constexpr int few = 3;
    return hbvm_route(scene, times, static_cast<double>(digits_) - few, nature_.log2_radius, progress);
  }

  const ReferenceRequest& request_;
  const MotionNature& nature_;
  unsigned digits_;
  double taylor_done_ = 0, hbvm_done_ = 0;
  std::mutex reporting_;
};

std::vector<ComparedState> compare(const ReferenceRequest& request, const std::vector<RouteRun>& runs,
                                   std::vector<std::string>& momentum_names) {
  const Assembled<Mpfr> scene = assemble<Mpfr>(request.scene);
  Point<Mpfr> point(scene.problem);
  const std::vector<MomentumComponent<Mpfr>> momenta = conserved_momenta(scene.problem);
  momentum_names.clear();
  for (const MomentumComponent<Mpfr>& component : momenta) momentum_names.push_back(component.name());
  std::vector<ComparedState> states;
  for (std::size_t n = 0; n < request.times.size(); ++n) {
    const RoutePoint &a = runs.front().points[n], &b = runs.back().points[n];
    ComparedState state{{{"q", a.q, b.q, Mpfr(0)}, {"p", a.p, b.p, Mpfr(0)}}};
    if (a.lambda.size() > 0) state.vectors.push_back({"lambda", a.lambda, b.lambda, Mpfr(0)});
    state.vectors.push_back(
        {"H", single(point.energy(a.q, a.p)), single(point.energy(b.q, b.p)), point.energy_size(a.q, a.p)});
    for (const MomentumComponent<Mpfr>& component : momenta) {
      const MomentumValue<Mpfr> here = momentum(scene.problem, component, a.q, a.p),
                                there = momentum(scene.problem, component, b.q, b.p);
      state.vectors.push_back({component.name(), single(here.value), single(there.value), here.size});
    }
    states.push_back(std::move(state));
  }
  return states;
}

[[noreturn]] void disagree(const ReferenceRequest& request, const std::vector<ComparedState>& states) {
  for (std::size_t n = 0; n < states.size(); ++n)
    for (const Compared& c : states[n].vectors) {
      if (c.agreed > request.digits) continue;
      Index worst = 0;
      for (Index j = 0; j < c.value.size(); ++j)
        if (magnitude(Mpfr(c.value[j] - c.other[j])) > magnitude(Mpfr(c.value[worst] - c.other[worst]))) worst = j;
      const int shown = std::max(6, static_cast<int>(std::min<long>(c.agreed, 60)) + 5);
      throw IntegrationError(
          fmt::format("the two routes agree in {} digits of {}, not in {}, at t = {}: component {} is {} by Taylor "
                      "series and {} by "
                      "HBVM; nothing is given out",
                      std::max(0L, c.agreed), c.name, request.digits, request.times[n].text(), worst + 1,
                      to_scientific(c.value[worst], shown), to_scientific(c.other[worst], shown)));
    }
  throw IntegrationError("the two routes do not agree");
}

}  // namespace

const char* name_of(Route route) { return route == Route::taylor ? "taylor" : "hbvm"; }

Route parse_route(std::string_view name) {
  for (const Route route : {Route::taylor, Route::hbvm})
    if (name == name_of(route)) return route;
  throw InputError("unknown route '" + std::string(name) + "': there are taylor and hbvm");
}

std::string scene_hash(const Scene& scene) {
  Scene plain = scene;
  plain.name = plain.title = plain.source = "";
  return Checksum(write_scene(plain)).text();
}

Reference compute_reference(const ReferenceRequest& request) {
  check(request);
  MotionNature nature = nature_of(request.scene, request.times, [&](double part) {
    if (request.progress) request.progress(part);
  });
  constexpr int rounds = 3, first_guard = 12, more_guard = 8;
  Reference result{.scene = request.scene.name,
                   .title = request.scene.title,
                   .scene_hash = scene_hash(request.scene),
                   .digits = request.digits,
                   .times = {},
                   .momentum_names = {},
                   .routes = {},
                   .digits_lost = nature.digits_lost};
  int guard = first_guard;
  for (int round = 1;; ++round) {
    Attempt attempt(request, nature, guard);
    const std::vector<RouteRun> runs = attempt.run();
    const PrecisionScope scope(attempt.digits());
    std::vector<ComparedState> states = compare(request, runs, result.momentum_names);
    count_digits(states, request.digits);
    long agreed = states.front().agreed();
    for (const ComparedState& state : states) agreed = std::min(agreed, state.agreed());
    if (agreed <= request.digits) {
      if (round == rounds) disagree(request, states);
      // What the radius of convergence is later on may not have shown.
      nature.log2_radius -= 1;
      guard += static_cast<int>(std::max(0L, request.digits + 1 - agreed)) + more_guard;
      continue;
    }
    for (std::size_t n = 0; n < states.size(); ++n) {
      const ComparedState& state = states[n];
      ReferenceState& out = result.times.emplace_back();
      out.t = request.times[n].text();
      out.agreed = request.only ? 0 : state.agreed();
      for (const Compared& c : state.vectors) {
        std::vector<std::string> texts;
        for (Index j = 0; j < c.value.size(); ++j) texts.push_back(to_digit(c.value[j], c.leading - request.digits));
        if (c.name == "q")
          out.q = texts;
        else if (c.name == "p")
          out.p = texts;
        else if (c.name == "lambda")
          out.lambda = texts;
        else if (c.name == "H")
          out.H = texts.front();
        else
          out.momenta.push_back(texts.front());
      }
    }
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const Route route = request.only ? *request.only : r == 0 ? Route::taylor : Route::hbvm;
      result.routes.push_back({name_of(route), runs[r].settings, runs[r].cpu_seconds});
    }
    return result;
  }
}

}  // namespace hbvm
