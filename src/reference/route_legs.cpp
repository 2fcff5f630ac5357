#include "reference/route_legs.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scalar/literal.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

using Json = nlohmann::json;

Json to_texts(const Vector<Mpfr>& v) {
  Json list = Json::array();
  for (const Mpfr& x : v) list.push_back(to_text(x));
  return list;
}

Vector<Mpfr> numbers(const Json& list) {
  Vector<Mpfr> v(static_cast<Index>(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i) v[static_cast<Index>(i)] = literal<Mpfr>(list[i].get<std::string>());
  return v;
}

std::string to_json(const Leg& leg) {
  Json points = Json::array();
  for (const ExactPoint& point : leg.points)
    points.push_back({{"q", to_texts(point.q)}, {"p", to_texts(point.p)}, {"lambda", to_texts(point.lambda)}});
  return Json{{"q", to_texts(leg.q)},
              {"p", to_texts(leg.p)},
              {"points", points},
              {"steps", leg.steps},
              {"cpu_seconds", leg.cpu_seconds}}
      .dump();
}

Leg leg_of(const std::string& text) {
  const Json json = Json::parse(text);
  Leg leg{numbers(json.at("q")), numbers(json.at("p")), {}, json.at("steps"), json.at("cpu_seconds")};
  for (const Json& point : json.at("points"))
    leg.points.push_back({numbers(point.at("q")), numbers(point.at("p")), numbers(point.at("lambda"))});
  return leg;
}

}  // namespace

Leg run_legs(const Assembled<Mpfr>& scene, const std::vector<Mpfr>& times, long count, const LegKeeper& keeper,
             const RunLeg& run) {
  Leg all{scene.q0, scene.p0, {}};
  Mpfr begin = 0;
  auto first = times.begin();
  for (long n = 1; n <= count; ++n) {
    const Mpfr end = n == count ? times.back() : Mpfr(times.back() * n / count);
    const auto last = std::upper_bound(first, times.end(), end);
    const std::string key = "leg " + std::to_string(n) + " of " + std::to_string(count);
    const std::optional<std::string> kept = keeper.find ? keeper.find(key) : std::nullopt;
    Leg leg = kept ? leg_of(*kept) : run(static_cast<std::size_t>(n - 1), begin, end, {first, last}, all.q, all.p);
    if (!kept && keeper.keep) keeper.keep(key, to_json(leg));
    all.q = std::move(leg.q);
    all.p = std::move(leg.p);
    std::move(leg.points.begin(), leg.points.end(), std::back_inserter(all.points));
    all.steps += leg.steps;
    all.cpu_seconds += leg.cpu_seconds;
    begin = end;
    first = last;
  }
  return all;
}

}  // namespace hbvm::core
