#include <fmt/format.h>

#include "hard_cases/family.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

/// The growth of e_hid from t = 20 to the run's end.
CaseResult growth(const RunRequest& request) {
  RunRequest start = request;
  start.until = Expression::parse("20");
  const auto e_hid = [](const Run& r) { return evaluate<double>(Expression::parse(r.e_hid)); };
  const Run whole = run(request, {});
  const double factor = e_hid(whole) / e_hid(run(start, {}));
  const double time = evaluate<double>(request.until) / evaluate<double>(start.until);
  CaseResult result;
  // For odd s every second step takes back what the first added; for even s it adds up, at most like t.
  const bool odd = request.method->stages() % 2 == 1;
  result.criteria = {{"growth of e_hid", factor, odd ? 2 : 2 * time}};
  result.warnings = warnings_of(whole);
  return result;
}

}  // namespace

void add_hidden(const Family& family) {
  for (int s = 1; s <= 4; ++s) {
    Expected expected = holds();
    if (s % 2 == 0) expected.warning = "even_s_drift";
    family.add_run(
        "heavy_top", fmt::format("s = {}", s), family.precisions(), expected, [] { return load_scene("heavy_top"); },
        {fmt::format("hbvm:{},{}", s, s), "auto", "1/10", family.full() ? "1280" : "640"}, growth);
  }
}

}  // namespace hbvm::core
