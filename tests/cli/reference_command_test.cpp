#include <gtest/gtest.h>

#include "cli/json.hpp"
#include "cli/program.hpp"

namespace hbvm::core {
namespace {

using nlohmann::ordered_json;

TEST(ReferenceCommand, PrintsJson) {
  const Outcome outcome =
      hbvm({"reference", "simple_pendulum", "--until", "10", "--at", "5/2,10", "--digits", "40", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const ordered_json j = ordered_json::parse(outcome.out);
  EXPECT_EQ(j["scene"], "simple_pendulum");
  EXPECT_EQ(j["until"], "10");
  EXPECT_EQ(j["digits"], 40);
  ASSERT_EQ(j["times"].size(), 2u);
  EXPECT_EQ(j["times"][0]["t"], "5/2");
  for (const auto& state : j["times"]) {
    EXPECT_EQ(state["q"].size(), 2u);
    EXPECT_EQ(state["p"].size(), 2u);
    EXPECT_EQ(state["lambda"].size(), 1u);
    EXPECT_TRUE(state["H"].is_string());
    EXPECT_GT(state["agreed"], 40);
  }
  // q_1 = -sin(theta) of Jacobi's functions, t = 10.
  EXPECT_EQ(j["times"][1]["q"][0].get<std::string>().substr(0, 32), "0.114003850418645211312316725708");
  ASSERT_EQ(j["routes"].size(), 3u);
  EXPECT_EQ(j["routes"][2]["name"], "closed_form");
  for (const auto& route : j["routes"]) {
    EXPECT_TRUE(route["settings"].is_string());
    EXPECT_GT(route["cpu_seconds"], 0);
  }
  for (const char* key : {"scene_hash", "version", "command"}) EXPECT_TRUE(j[key].is_string()) << key;
}

TEST(ReferenceCommand, GivesTheClosedFormAloneIfThereIsOne) {
  const Outcome known =
      hbvm({"reference", "spherical_pendulum", "--until", "3", "--digits", "20", "--route", "closed_form"});
  EXPECT_EQ(known.code, 0) << known.err;
  expect_words(known.out, {"by one route", "closed form: spherical pendulum (elliptic integrals)"});
  expect_refused({"reference", "heavy_top", "--until", "1", "--digits", "20", "--route", "closed_form"},
                 {"no closed form of the motion of 'heavy_top' is known"});
}

/// What is kept is found again, and a file that cannot be one is refused before any work.
TEST(ReferenceCommand, GoesOnFromACheckpoint) {
  const Folder folder;
  const std::string file = folder / "way.jsonl";
  const std::vector<std::string> command{"reference", "double_pendulum", "--until",      "3", "--digits",
                                         "20",        "--json",          "--checkpoint", file};
  const Outcome first = hbvm(command);
  ASSERT_EQ(first.code, 0) << first.err;
  const auto legs = [&file] {
    std::vector<std::string> lines = lines_of(text_of(file));
    std::erase(lines, "");
    return lines.size();
  };
  EXPECT_EQ(legs(), 2u) << "one of either route";
  const Outcome second = hbvm(command);
  EXPECT_EQ(second.out, first.out) << "to the processor times, which are those of the first";
  EXPECT_EQ(legs(), 2u);
  expect_refused({"reference", "double_pendulum", "--until", "3", "--checkpoint", folder / "."}, {folder / "."});
}

/// A digit of a number of the second time, in the middle or the last, of whatever is stored. It is found, and named
/// with its time, its component and both values.
TEST(ReferenceCommand, WritesAFileAndFindsAWrongDigitInIt) {
  const Folder folder;
  const std::string file = folder / "reference.toml";
  const Outcome made =
      hbvm({"reference", "conical_pendulum", "--until", "1", "--at", "1/2,1", "--digits", "25", "--out", file});
  ASSERT_EQ(made.code, 0) << made.err;
  expect_words(made.out, {"the routes agree in"});
  const Outcome verified = hbvm({"reference", "--verify", file});
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
  expect_words(verified.out, {"all digits of 2 times"});
  const std::string right = text_of(file);
  const std::size_t second = right.find("t = \"1\"");
  ASSERT_NE(second, std::string::npos);
  struct Place {
    const char *key, *name;
  };
  for (const Place& place : {Place{"\nq = [\n  \"", "q_1"},
                             {"\np = [\n  \"", "p_1"},
                             {"\nlambda = [\n  \"", "lambda_1"},
                             {"\nH = \"", "H"},
                             {"\nmomenta = [\n  \"", "momentum_1"}})
    for (const bool last : {false, true}) {
      const std::size_t begin = right.find(place.key, second) + std::string(place.key).size(),
                        end = right.find_first_of("\"e", begin), at = last ? end - 1 : (begin + end) / 2;
      ASSERT_GT(end - begin, 15u) << place.name;
      std::string text = right;
      ASSERT_NE(text[at], '.');
      text[at] = text[at] == '7' ? '8' : '7';
      folder.write("reference.toml", text);
      const Outcome wrong = hbvm({"reference", "--verify", file, "--route", last ? "taylor" : "hbvm"});
      EXPECT_EQ(wrong.code, 1) << place.name;
      expect_words(wrong.out, {std::string("t = 1: ") + place.name + " is " + right.substr(begin, end - begin),
                               ", not " + text.substr(begin, end - begin), ": 1 numbers differ"});
    }
}

/// Trajectories as hbvm run writes them, of RATTLE with four steps: order 2. Of HBVM, whose p is not tangential, the
/// momenta of the output state are compared.
TEST(ReferenceCommand, TellsHowManyDigitsOfATrajectoryAreRight) {
  const Folder folder;
  std::string files;
  for (const char* steps : {"16", "32", "64", "128"}) {
    const std::string file = folder / (std::string(steps) + ".csv");
    ASSERT_EQ(hbvm({"run", "simple_pendulum", "--method", "rattle", "--step", std::string("1/") + steps, "--until", "4",
                    "--every", "8", "--out", file})
                  .code,
              0);
    files += (files.empty() ? "" : ",") + file;
  }
  const Outcome text = hbvm({"reference", "simple_pendulum", "--against", files});
  EXPECT_EQ(text.code, 0) << text.err;
  expect_words(text.out, {"right digits beside a reference of ", ", computed now\n", "1 times at the start",
                          "most is lost between t = "});
  const Outcome json = hbvm({"reference", "--scene", "simple_pendulum", "--against", files, "--json"});
  ASSERT_EQ(json.code, 0) << json.err;
  const ordered_json j = ordered_json::parse(json.out);
  ASSERT_EQ(j["files"].size(), 4u);
  ASSERT_EQ(j["orders"].size(), 3u);
  for (const auto& order : j["orders"]) EXPECT_NEAR(order.get<double>(), 2, 0.05);
  // A step is stored beside each file, and the order of their names says nothing.
  const Outcome shuffled = hbvm({"reference", "simple_pendulum", "--against",
                                 (folder / "32.csv") + "," + (folder / "128.csv") + "," + (folder / "64.csv"),
                                 "--expect-order", "2", "--require", "2.5"});
  EXPECT_EQ(shuffled.code, 0) << shuffled.err;
  expect_words(shuffled.out, {"32.csv to "});
  const Outcome fourth = hbvm({"reference", "simple_pendulum", "--against", files, "--expect-order", "4"});
  EXPECT_EQ(fourth.code, 1);
  expect_words(fourth.err, {"the order is 2.0"});
  const Outcome more = hbvm({"reference", "simple_pendulum", "--against", files, "--require", "12"});
  EXPECT_EQ(more.code, 1);
  expect_words(more.err, {"digits are right, and not 12"});
  EXPECT_EQ(hbvm({"reference", "simple_pendulum", "--against", files, "--steps", "1,2"}).code, 2);
  EXPECT_EQ(hbvm({"reference", "simple_pendulum", "--steps", "1"}).code, 2);
  const std::string file = folder / "hbvm.csv";
  ASSERT_EQ(hbvm({"run", "simple_pendulum", "--method", "hbvm:8,8", "--step", "1/8", "--until", "4", "--precision",
                  "mpfr:40", "--out", file})
                .code,
            0);
  const ordered_json many =
      ordered_json::parse(hbvm({"reference", "simple_pendulum", "--against", file, "--json"}).out);
  for (const auto& [name, digits] : many["files"][0]["right_digits"].items())
    for (const auto& right : digits) EXPECT_GT(right.get<double>(), 12) << name;
}

/// That the start is another is said before any digits; times are as short as they can be.
TEST(ReferenceCommand, SaysFirstThatAStartIsAnother) {
  const Folder folder;
  const std::string file = folder.write(
      "theirs.csv", "t,bob.x,bob.y,bob.px,bob.py\n0,0,1,1.001,0\n0.30000000000000004,0.29,-0.95,0.9,0.3\n");
  const Outcome outcome = hbvm({"reference", "simple_pendulum", "--against", file});
  const std::size_t start = outcome.out.find("ITS START IS ANOTHER"), table = outcome.out.find("least right");
  ASSERT_NE(start, std::string::npos) << outcome.out;
  EXPECT_LT(start, table);
  expect_words(outcome.out, {"bob.y is 1, and -1 in the scene: of the other sign",
                             "bob.px is 1.001, and 1 in the scene: 3.0 digits are right", "\n  0.3  "});
}

TEST(ReferenceCommand, RefusesWhatItCannotDo) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"reference"},
        {"reference", "simple_pendulum"},
        {"reference", "simple_pendulum", "--until", "-1"},
        {"reference", "simple_pendulum", "--until", "x"},
        {"reference", "simple_pendulum", "--until", "1", "--digits", "0"},
        {"reference", "simple_pendulum", "--until", "1", "--route", "euler"},
        {"reference", "nonsense", "--until", "1"},
        {"reference", "--verify", "/nonexistent"},
        {"reference", "--show", "nonsense"}})
    expect_refused(arguments, {});
}

/// The fall into a centre has no state after 1.11.
TEST(ReferenceCommand, SaysWhereTheMotionEnds) {
  const Folder folder;
  const std::string file = folder.write("fall.toml", fall());
  const Outcome outcome = hbvm({"reference", file, "--until", "2", "--digits", "20"});
  EXPECT_EQ(outcome.code, 3);
  expect_words(outcome.err, {"singularity at about t = 1.11"});
}

}  // namespace
}  // namespace hbvm::core
