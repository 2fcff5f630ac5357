#include <gtest/gtest.h>

#include "cli/json.hpp"
#include "cli/program.hpp"

namespace hbvm::core {
namespace {

const Arguments orders_of_kepler{"convergence", "kepler", "--methods", "rk4", "verlet", "--steps", "1/8:1/128"};

TEST(ConvergenceCommand, PrintsATableOfOrders) {
  const Outcome outcome = ended_with(0, orders_of_kepler + Arguments{"--precision", "30", "double"});
  expect_words(outcome.out, {"order of q", "rk4", "verlet (rattle)", "1/128", "mpfr:30", "double", "+-"});
  EXPECT_EQ(outcome.err, "");
}

TEST(ConvergenceCommand, PrintsJson) {
  const nlohmann::ordered_json json = json_of(orders_of_kepler);
  EXPECT_EQ(keys_of(json["methods"][0]), words_of("method resolved precision orders points"));
  EXPECT_EQ(json["methods"][0]["points"].size(), 5u);
}

TEST(ConvergenceCommand, DrawsAFigureAndNoPage) {
  const Folder folder;
  const std::string svg = folder / "orders.svg";
  expect_words(ended_with(0, orders_of_kepler + Arguments{"--plot", svg}).err, {"written to " + svg});
  expect_words(text_of(svg), {"<svg", "rk4", "step h"});
  expect_refused(orders_of_kepler + Arguments{"--plot", folder / "orders.html"}, {"--plot", "nothing moves"});
}

TEST(ConvergenceCommand, RefusesWhatItCannotRead) {
  expect_refused({"convergence", "kepler", "--methods", "rk4", "--steps", "1/8"}, {"steps '1/8'", "1/8:1/256"});
  expect_refused({"convergence", "kepler", "--methods", "rk4"}, {"--steps"});
}

}  // namespace
}  // namespace hbvm::core
