#include <fmt/format.h>

#include "hard_cases/family.hpp"
#include "hard_cases/round_off_growth.hpp"

namespace hbvm::core {
namespace {

/// The same method with as many nodes as its energy needs to be exact in double, in quad and with 50 digits.
struct Methods {
  std::string in_double, in_quad, in_50_digits;
  Methods(const char* all) : in_double(all), in_quad(all), in_50_digits(all) {}
  Methods(const char* d, const char* q, const char* m) : in_double(d), in_quad(q), in_50_digits(m) {}
};

struct LongRun {
  std::string scene;
  Methods methods;
  std::string step, solver;
  long quick, full;  ///< steps in double
};

}  // namespace

void add_long_runs(const Family& family) {
  constexpr long most = 10'000'000, many = 1'000'000, some = 50'000;
  const Methods kepler{"hbvm:12,4", "hbvm:12,4", "hbvm:20,4"}, satellites{"hbvm:5,3", "hbvm:10,3", "hbvm:14,3"};
  std::vector<LongRun> runs;
  for (const std::string solver : {"auto", "newton"}) {
    const std::vector<LongRun> both{{"kepler", kepler, "1/32", solver, 100'000, most},
                                    {"double_pendulum", "hbvm:3,3", "1/32", solver, some, most},
                                    {"heavy_top", "hbvm:1,1", "1/32", solver, some, most},
                                    {"heavy_top", "hbvm:3,3", "1/32", solver, some / 2, most},
                                    {"tethered_satellites", satellites, "1/32", solver, some / 2, most}};
    runs.insert(runs.end(), both.begin(), both.end());
  }
  if (family.full()) {
    runs.push_back({"kepler", kepler, "1/32", "paper", 0, most});
    // By parity of s, and for k = s and k > s. Where U has degree 2 at most k > s is another way to the same method.
    for (const char* const method : {"hbvm:2,2", "hbvm:4,4", "hbvm:4,2", "hbvm:6,3"}) {
      runs.push_back({"double_pendulum", method, "1/32", "auto", 0, many});
      runs.push_back({"heavy_top", method, "1/32", "auto", 0, many});
    }
    runs.push_back({"kepler", {"hbvm:14,3", "hbvm:14,3", "hbvm:20,3"}, "1/64", "auto", 0, many});
    runs.push_back({"tethered_satellites", {"hbvm:6,2", "hbvm:12,2", "hbvm:16,2"}, "1/32", "auto", 0, many});
  }
  for (const LongRun& r : runs) {
    const auto add = [&](const std::string& precision, const std::string& method, long steps) {
      family.add_run(
          r.scene, fmt::format("{} steps", steps), {precision}, holds(), [name = r.scene] { return load_scene(name); },
          {method, r.solver, r.step, fmt::format("{}*({})", steps, r.step)}, long_run, family.full() ? 7200 : 60);
    };
    add("double", r.methods.in_double, family.full() ? r.full : r.quick);
    if (family.full()) {
      add("quad", r.methods.in_quad, 100'000);
      add("mpfr:50", r.methods.in_50_digits, 100'000);
    }
  }
}

}  // namespace hbvm::core
