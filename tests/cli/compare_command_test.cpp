#include <gtest/gtest.h>

#include "cli/json.hpp"
#include "cli/program.hpp"

namespace hbvm::core {
namespace {

const Arguments kepler{"compare", "kepler", "--methods", "rk4", "verlet", "hbvm:auto,3", "--until", "10"};

TEST(CompareCommand, PrintsATableOfItsMethods) {
  const Outcome outcome = ended_with(0, kepler + Arguments{"--reference"});
  expect_words(outcome.out, {"method", "e_H", "digits", "seconds", "rk4", "verlet", "hbvm:auto,3"});
  EXPECT_EQ(outcome.err, "");
}

TEST(CompareCommand, PrintsJson) {
  const nlohmann::ordered_json json = json_of(kepler + Arguments{"--precision", "50", "--step", "1/16"});
  EXPECT_EQ(json["precision"], "mpfr:50");
  EXPECT_EQ(json["runs"].size(), 3u);
  EXPECT_EQ(keys_of(json["runs"][0]), words_of("method resolved e_H e_g e_hid cpu_seconds warnings"));
}

TEST(CompareCommand, DrawsAFigureAndAPage) {
  const Folder folder;
  const std::string svg = folder / "two.svg", html = folder / "two.html";
  const Outcome outcome = ended_with(0, kepler + Arguments{"--plot", svg, "--plot", html});
  expect_words(outcome.err, {"written to " + svg, "written to " + html});
  expect_words(text_of(svg), {"<svg", "rk4", "hbvm compare kepler"});
  expect_words(text_of(html), {"<!DOCTYPE html>", "rk4, verlet, hbvm:auto,3"});
}

TEST(CompareCommand, RefusesWhatItCannotRead) {
  expect_refused(kepler + Arguments{"--plot", "a.jpg"}, {"--plot", ".svg"});
  expect_refused({"compare", "kepler", "--methods", "rk5", "--until", "1"}, {"unknown method 'rk5'"});
  expect_refused({"compare", "kepler", "--until", "1"}, {"--methods"});
}

}  // namespace
}  // namespace hbvm::core
