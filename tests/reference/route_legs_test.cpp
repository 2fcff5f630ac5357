#include "reference/route_legs.hpp"

#include <map>
#include <mutex>

#include "printing.hpp"
#include "reference/request_of.hpp"

namespace hbvm::core {
namespace {

/// As a file would keep them.
struct KeptLegs {
  std::map<std::string, std::string> legs;
  std::mutex using_legs;
  long found = 0;

  LegKeeper keeper() {
    return {[this](const std::string& key) -> std::optional<std::string> {
              const std::lock_guard lock(using_legs);
              const auto leg = legs.find(key);
              if (leg == legs.end()) return std::nullopt;
              ++found;
              return leg->second;
            },
            [this](const std::string& key, const std::string& json) {
              const std::lock_guard lock(using_legs);
              EXPECT_TRUE(legs.emplace(key, json).second) << key << " was made twice";
            }};
  }
};

/// Uneven masses and lengths, and long enough for some legs; two times in one of them.
ReferenceRequest request() { return request_of("charged_double_pendulum", {"1/7", "1/3", "40"}, 15); }

std::vector<std::string> numbers(const Reference& reference) {
  std::vector<std::string> all;
  for (const ReferenceState& state : reference.times)
    for (const auto* vector : {&state.q, &state.p, &state.lambda})
      all.insert(all.end(), vector->begin(), vector->end());
  return all;
}

TEST(RouteLegs, GoOnAfterTheLastThatWasKept) {
  const Reference whole = compute_reference(request());
  KeptLegs kept;
  ReferenceRequest ended = request();
  ended.keeper = kept.keeper();
  struct Ended {};
  ended.progress = [](double part) {
    if (part > 0.5) throw Ended();
  };
  EXPECT_THROW(compute_reference(ended), Ended);
  const auto of_first = static_cast<long>(kept.legs.size());
  ASSERT_GT(of_first, 1);
  ended.progress = {};
  const Reference resumed = compute_reference(ended);
  EXPECT_EQ(kept.found, of_first);
  EXPECT_GT(static_cast<long>(kept.legs.size()), of_first);
  EXPECT_EQ(numbers(resumed), numbers(whole));
  for (std::size_t r = 0; r < whole.routes.size(); ++r) EXPECT_EQ(resumed.routes[r].settings, whole.routes[r].settings);
}

/// A leg of another scene, of other digits or of other times is not taken for one's own.
TEST(RouteLegs, AreKeptByWhatTheyDependOn) {
  KeptLegs kept;
  ReferenceRequest one = request();
  one.keeper = kept.keeper();
  const Reference first = compute_reference(one);
  ReferenceRequest other = one;
  other.digits = 14;
  compute_reference(other);
  other = one;
  other.times.erase(other.times.begin());
  compute_reference(other);
  other = one;
  other.scene = load_scene("double_pendulum");
  compute_reference(other);
  EXPECT_EQ(kept.found, 0);
  compute_reference(one);
  EXPECT_GT(kept.found, 0);
}

}  // namespace
}  // namespace hbvm::core
