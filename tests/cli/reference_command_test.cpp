#include <gtest/gtest.h>

#include "cli/json.hpp"
#include "cli/program.hpp"
#include "hbvm/results.hpp"
#include "read_file.hpp"
#include "scalar/literal.hpp"
#include "scalar/precision.hpp"

namespace hbvm::core {
namespace {

using nlohmann::ordered_json;

TEST(ReferenceCommand, PrintsJson) {
  const ordered_json j = json_of({"reference", "simple_pendulum", "--until", "10", "--at", "5/2,10", "--digits", "40"});
  expect_members(j, {{"scene", "simple_pendulum"}, {"until", "10"}, {"digits", 40}});
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
  EXPECT_FALSE(j.contains("proved"));
}

/// Proved digits are those of the routes, with the radius of each vector; and a refusal says until when.
TEST(ReferenceCommand, ProvesDigits) {
  const ordered_json j = json_of({"reference", "simple_pendulum", "--at", "5/2,10", "--digits", "40", "--prove"});
  EXPECT_EQ(j["proved"], 40);
  EXPECT_EQ(j["times"][1]["q"][0].get<std::string>().substr(0, 32), "0.114003850418645211312316725708");
  for (const auto& state : j["times"]) {
    EXPECT_TRUE(state["agreed"].is_null());
    for (const char* key : {"q", "p", "lambda", "H"})
      EXPECT_LT(std::stod(state["radius"][key].get<std::string>()), 1e-41) << key;
  }
  ASSERT_EQ(j["routes"].size(), 1u);
  EXPECT_EQ(j["routes"][0]["name"], "proof");
  EXPECT_EQ(j["command"], "hbvm reference simple_pendulum --at 5/2,10 --digits 40 --prove");
  expect_words(hbvm({"reference", "kepler", "--until", "1", "--prove"}).out,
               {"30 digits after the leading one, proved: q is within"});
  const Folder folder;
  // A stored reference is proved digit by digit, and says so from then on.
  const std::string file = folder / "pendulum.toml", proved = folder / "proved.toml";
  ended_with(0, {"reference", "simple_pendulum", "--until", "3", "--digits", "25", "--out", file});
  expect_words(ended_with(0, {"reference", "--verify", file, "--prove", "--out", proved}).out,
               {"all digits of 1 times are proved"});
  expect_words(text_of(proved), {"proved = 25", "radius = [", "name = \"proof\"", "name = \"taylor\""});
  std::string text = text_of(file);
  text.replace(text.find("H = \"-0.5"), 10, "H = \"-0.6");
  const std::string wrong = folder.write("wrong.toml", text);
  expect_words(ended_with(1, {"reference", "--verify", wrong, "--prove", "--out", proved}).out, {"1 numbers differ"});
  const std::string fall = folder.write("fall.toml", R"(
dimension = 2
point = [{ name = "sun", position = [0, 0] }]
body = [{ name = "a", mass = 1, position = [1, 0], velocity = [0, 0] }]
effect = [{ kind = "central_gravity", center = "sun", strength = 1 }]
)");
  const Outcome ended = hbvm({"reference", fall, "--until", "2", "--prove"});
  EXPECT_EQ(ended.code, 3);
  expect_words(hbvm({"reference", "kepler", "--until", "1", "--prove", "--route", "taylor"}).err,
               {"--prove takes neither --route nor --checkpoint"});
  // Before any work.
  expect_words(ended_with(2, {"reference", "--verify", file, "--prove", "--route", "taylor"}).err, {"--prove takes"});
  expect_words(ended_with(2, {"reference", "--verify", file, "--out", proved}).err,
               {"--out writes the file with what"});
}

/// A proof is a file that is gone through again. Its last line is what was proved.
TEST(ReferenceCommand, KeepsAProofAndChecksIt) {
  const Folder folder;
  const std::string file = folder / "pendulum.proof";
  ended_with(0, {"reference", "simple_pendulum", "--until", "2", "--digits", "12", "--prove", "--out", file});
  const std::string said = ended_with(0, {"reference", "--check", file}).out;
  const std::string last = "proved: q, p, lambda and H of simple_pendulum at t = 2 to 12 digits\n";
  EXPECT_EQ(said.substr(said.size() - last.size()), last);
  EXPECT_EQ(json_of({"reference", "--check", file})["proved"], 12);
  std::string text = text_of(file);
  const std::size_t digit = text.find("[[step]]") + 100;
  text[digit] = text[digit] == '1' ? '2' : '1';
  const std::string changed = folder.write("changed.proof", text);
  expect_words(ended_with(2, {"reference", "--check", changed}).err, {"it was changed"});
  expect_words(ended_with(2, {"reference", "--check", folder.write("other.proof", "proof")}).err,
               {"does not begin with format"});
  expect_words(ended_with(2, {"reference", "simple_pendulum", "--check", file}).err, {"are those of the proof"});
  expect_words(ended_with(2, {"reference", "simple_pendulum", "--until", "2", "--out", file}).err,
               {"a proof is made by --prove"});
}

/// The bob of length 1: its height is that of its angle, and the tension follows from the energy. The digits are all
/// those asked for.
TEST(ReferenceCommand, TellsWhatIsObserved) {
  const ordered_json j =
      json_of({"reference", "simple_pendulum", "--until", "3", "--digits", "40", "--observe", "angle=angle(pivot, bob)",
               "--observe", "T=tension(pivot, bob)", "--observe", "difference=bob.y - sin(angle(pivot, bob))"});
  const auto& state = j["times"][0];
  EXPECT_EQ(keys_of(state["observed"]), (std::vector<std::string>{"angle", "T", "difference"}));
  EXPECT_EQ(state["observed"]["difference"], "0");
  // One route alone has the same rounding, which is no value.
  const ordered_json alone = json_of({"reference", "simple_pendulum", "--until", "3", "--digits", "40", "--route",
                                      "taylor", "--observe", "difference=speed(bob)^2 - bob.vx^2 - bob.vy^2"});
  EXPECT_EQ(alone["times"][0]["observed"]["difference"], "0");
  const PrecisionScope digits(60);
  const auto number_of = [&](const std::string& what) {
    return literal<Mpfr>(state["observed"][what].get<std::string>());
  };
  const Mpfr y = literal<Mpfr>(state["q"][1].get<std::string>());
  EXPECT_LE(magnitude(Mpfr(y - sin(number_of("angle")))), literal<Mpfr>("1e-39"));
  EXPECT_LE(magnitude(Mpfr(number_of("T") - 2 * literal<Mpfr>(state["lambda"][0].get<std::string>()))),
            literal<Mpfr>("1e-39"));
  EXPECT_GE(state["observed"]["T"].get<std::string>().size(), 41u);
}

TEST(ReferenceCommand, GivesTheClosedFormAloneIfThereIsOne) {
  const Arguments alone{"--digits", "20", "--route", "closed_form"};
  expect_words(ended_with(0, Arguments{"reference", "spherical_pendulum", "--until", "3"} + alone).out,
               {"by one route", "closed form: spherical pendulum (elliptic integrals)"});
  expect_refused(Arguments{"reference", "heavy_top", "--until", "1"} + alone,
                 {"no closed form of the motion of 'heavy_top' is known"});
}

/// What is kept is found again, and a file that cannot be one is refused before any work.
TEST(ReferenceCommand, GoesOnFromACheckpoint) {
  const Folder folder;
  const std::string file = folder / "way.jsonl";
  const Arguments command = Arguments{"reference", "double_pendulum", "--until", "3", "--digits", "20", "--json"} +
                            Arguments{"--checkpoint", file};
  const Outcome first = ended_with(0, command);
  const auto legs = [&file] {
    std::vector<std::string> lines = lines_of(text_of(file));
    std::erase(lines, "");
    return lines.size();
  };
  EXPECT_EQ(legs(), 2u) << "one of either route";
  EXPECT_EQ(hbvm(command).out, first.out) << "to the processor times, which are those of the first";
  EXPECT_EQ(legs(), 2u);
  expect_refused({"reference", "double_pendulum", "--until", "3", "--checkpoint", folder / "."}, {folder / "."});
}

/// A digit of a number of the second time, in the middle or the last, of whatever is stored. It is found, and named
/// with its time, its component and both values.
TEST(ReferenceCommand, WritesAFileAndFindsAWrongDigitInIt) {
  const Folder folder;
  const std::string file = folder / "reference.toml";
  const Arguments make{"reference", "conical_pendulum", "--until", "1", "--at", "1/2,1", "--digits", "25"};
  expect_words(ended_with(0, make + Arguments{"--out", file}).out, {"the routes agree in"});
  expect_words(ended_with(0, {"reference", "--verify", file}).out, {"all digits of 2 times"});
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
      const Outcome wrong = ended_with(1, {"reference", "--verify", file, "--route", last ? "taylor" : "hbvm"});
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
    ended_with(0, run_of("simple_pendulum", "rattle", std::string("1/") + steps, "4") +
                      Arguments{"--every", "8", "--out", file});
    files += (files.empty() ? "" : ",") + file;
  }
  const auto against = [](const std::string& results) {
    return Arguments{"reference", "simple_pendulum", "--against", results};
  };
  expect_words(
      ended_with(0, against(files)).out,
      {"right digits beside a reference of ", ", computed now, and what one part", "the error at the end is mostly"});
  const ordered_json j = json_of({"reference", "--scene", "simple_pendulum", "--against", files});
  ASSERT_EQ(j["files"].size(), 4u);
  ASSERT_EQ(j["orders"].size(), 3u);
  for (const auto& order : j["orders"]) EXPECT_NEAR(order.get<double>(), 2, 0.05);
  // A step is stored beside each file, and the order of their names says nothing.
  const Arguments shuffled = against((folder / "32.csv") + "," + (folder / "128.csv") + "," + (folder / "64.csv"));
  expect_words(ended_with(0, shuffled + Arguments{"--expect-order", "2", "--require", "2.5"}).out, {"32.csv to "});
  expect_words(ended_with(1, against(files) + Arguments{"--expect-order", "4"}).err, {"the order is 2.0"});
  expect_words(ended_with(1, against(files) + Arguments{"--require", "12"}).err, {"digits are right, and not 12"});
  ended_with(2, against(files) + Arguments{"--steps", "1,2"});
  EXPECT_NEAR(j.at("order").at("value").get<double>(), 2, 0.05);
  EXPECT_EQ(j["files"][0].at("mostly"), name_of(LostBy::energy));
  const std::string page = folder / "page.html";
  EXPECT_EQ(ended_with(0, against(files) + Arguments{"--plot", page}).err, written({page}));
  expect_words(read_file(page),
               {"Right digits beside the reference of simple_pendulum", "the error is mostly", "16.csv"});
  const ordered_json priced = json_of(against(folder / "64.csv") + Arguments{"--cost"});
  EXPECT_GE(priced.at("cost").at("digits").get<int>(), 1);
  ended_with(2, {"reference", "simple_pendulum", "--steps", "1"});
  const std::string file = folder / "hbvm.csv";
  ended_with(0, run_of("simple_pendulum", "hbvm:8,8", "1/8", "4") + Arguments{"--precision", "mpfr:40", "--out", file});
  const ordered_json many = json_of(against(file));
  for (const auto& [name, digits] : many["files"][0]["right_digits"].items())
    for (const auto& right : digits) EXPECT_GT(right.get<double>(), 12) << name;
}

/// An angle goes on over full turns. In a file of results any of them will do.
TEST(ReferenceCommand, FollowsAnglesAndComparesWhatIsObserved) {
  const Folder folder;
  const std::string wheel = folder.write("wheel.toml", R"toml(dimension = 2
[[rigid_body]]
name = "w"
fixed_at = [0, 0]
mass = 1
center = [0, 0]
inertia = 1
orientation = 0
angular_velocity = 5
[[observe]]
name = "a"
value = "angle(w.d1)"
)toml");
  const nlohmann::ordered_json found = json_of({"reference", wheel, "--at", "1,10", "--digits", "25"});
  const auto angle = [&](std::size_t n) { return std::stod(found["times"][n]["observed"]["a"].get<std::string>()); };
  EXPECT_NEAR(angle(0), 5, 1e-14);
  EXPECT_NEAR(angle(1), 50, 1e-13);
  const auto right = [&](const std::string& name, const std::string& value) {
    const std::string file = folder.write(name, "t,a\n10," + value + "\n");
    return ended_with(0, {"reference", wheel, "--against", file}).out;
  };
  expect_words(right("whole.csv", "50.0001"), {"at the end: a 3.4"});
  expect_words(right("principal.csv", "-0.2653824574366918"), {"at the end: a 3.4"});
  expect_words(
      ended_with(2, {"reference", wheel, "--against", folder.write("b.csv", "t,b\n10,1\n"), "--map", "b=c"}).err,
      {"it observes a"});
}

/// Numbers for other programs, of a reference that is computed or shipped.
TEST(ReferenceCommand, WritesNumbersForOtherPrograms) {
  const Folder folder;
  const std::string file = folder / "pendulum.py", shipped = folder / "car.csv";
  ended_with(0, {"reference", "simple_pendulum", "--until", "3", "--digits", "25", "--out", file});
  expect_words(read_file(file), {"mp.dps = 30", "names = [\"bob.x\", \"bob.y\"", "mpf(\"3\")"});
  ended_with(0, {"reference", "--show", "car_axis", "--out", shipped});
  expect_words(read_file(shipped), {"t,left.x,left.y", "0.04934557842752409213152"});
  expect_words(ended_with(2, {"reference", "--show", "car_axis", "--out", folder / "car.txt"}).err, {".csv, .jl"});
}

/// A number that is set is set in the reference, too; what would change nothing is refused.
TEST(ReferenceCommand, ComparesWithTheSceneAsItIsSet) {
  const Folder folder;
  const std::string file = folder / "heavy.csv";
  ended_with(0, run_of("double_pendulum", "hbvm:8,8", "1/16", "1") + Arguments{"--set", "a.mass=3", "--out", file});
  const Arguments against{"reference", "double_pendulum", "--against", file, "--require", "9"};
  ended_with(0, against + Arguments{"--set", "a.mass=3"});
  ended_with(1, against);
  expect_words(ended_with(2, against + Arguments{"--set", "nonsense=1"}).err, {"nonsense"});
  for (const Arguments& idle : {Arguments{"--until", "3"}, {"--digits", "5"}, {"--prove"}, {"--at", "1"}})
    expect_words(ended_with(2, against + idle).err, {"--against compares at the times of the file"});

  // A comma within parentheses divides nothing; a time is as short as it can be.
  const std::string angle = folder.write("angle.csv", "t,x,y\n10,0.11400385,-0.99348031\n");
  expect_words(ended_with(0, {"reference", "simple_pendulum", "--against", angle, "--map",
                              "sin(atan2(x, -y))=bob.x,-cos(atan2(x,-y))=bob.y"})
                   .out,
               {"\n  10  "});
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
  for (const Arguments& arguments : {Arguments{"reference"},
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
  expect_words(ended_with(3, {"reference", file, "--until", "2", "--digits", "20"}).err,
               {"singularity at about t = 1.11"});
}

TEST(ReferenceCommand, TellsWhenEventsCome) {
  const Arguments asked{"reference", "simple_pendulum", "--event", "swing up: bob.x", "--digits", "25"};
  expect_words(ended_with(0, asked + Arguments{"--until", "7"}).out,
               {"event swing, up: t = 6.7430014192503841714848146", "bob.x", "the routes agree in"});
  expect_refused(asked, {"--until"});
  expect_refused(asked + Arguments{"--at", "1"}, {"--until"});
  expect_refused(asked + Arguments{"--until", "7", "--prove"}, {"--event", "--prove"});
  expect_refused(asked + Arguments{"--until", "7", "--route", "taylor"}, {"--event", "--route"});
  expect_refused(asked + Arguments{"--until", "1"}, {"none comes until t = 1"});
}

}  // namespace
}  // namespace hbvm::core
