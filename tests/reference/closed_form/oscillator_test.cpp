#include "reference/closed_form/against_taylor.hpp"

namespace hbvm::core {
namespace {

constexpr const char* oscillator_name = "harmonic oscillators";

/// Three bodies, one with a full mass matrix; springs between them and to a point, a trap and a field.
std::string net(Fractions& random, int dimension, const std::string& more = "") {
  const std::string full =
      dimension == 2 ? "[[2, \"1/3\"], [\"1/3\", 1]]" : "[[2, \"1/3\", 0], [\"1/3\", 1, 0], [0, 0, 5]]";
  std::string text = "dimension = " + std::to_string(dimension) +
                     "\n[[point]]\nname = \"wall\"\nposition = " + random.vector(dimension) + "\n";
  for (const char* name : {"a", "b", "c"})
    text += std::string("[[body]]\nname = \"") + name +
            "\"\nmass = " + (name[0] == 'b' ? full : "\"" + random.positive() + "\"") +
            "\nposition = " + random.vector(dimension) + "\nvelocity = " + random.vector(dimension) + "\n";
  for (const char* ends : {"[[\"wall\", \"a\"]]", "[[\"a\", \"b\"], [\"b\", \"c\"]]"})
    text += std::string("[[effect]]\nkind = \"spring\"\nstiffness = \"") + random.positive() + "\"\nbetween = " + ends +
            "\n";
  return text + "[[effect]]\nkind = \"trap\"\nexponent = 2\non = [\"c\"]\ncenter = \"wall\"\nstiffness = \"" +
         random.any() + "\"\n[[effect]]\nkind = \"uniform_gravity\"\nacceleration = " + random.vector(dimension) +
         "\n" + more;
}

/// With a trap of any sign: it may be a hill.
TEST(Oscillator, AnyNetOfSprings) {
  Fractions random(31);
  for (int dimension : {2, 3})
    for (int n = 0; n < 4; ++n) expect_follows_taylor(net(random, dimension), oscillator_name, {"1/3", "8"}, 40, 12);
}

std::string free(int dimension, const std::string& more) {
  Fractions random(32);
  std::string text = "dimension = " + std::to_string(dimension) +
                     "\n[[point]]\nname = \"o\"\nposition = " + random.vector(dimension) + "\n";
  for (const char* name : {"a", "b"})
    text += std::string("[[body]]\nname = \"") + name + "\"\nmass = \"" + random.positive() +
            "\"\nposition = " + random.vector(dimension) + "\nvelocity = " + random.vector(dimension) + "\n";
  return text + more;
}

TEST(Oscillator, FreeMotionAndFall) {
  expect_follows_taylor(free(3, ""), "motion under constant forces", {"1", "1000"});
  expect_follows_taylor(free(2, "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [\"1/3\", -9]\n"),
                        "motion under constant forces", {"1", "1000"});
}

/// Two bodies that a spring alone holds: four modes of six have the frequency 0, and three are alike.
TEST(Oscillator, ModesOfEqualAndOfNoFrequency) {
  expect_follows_taylor(free(3, "[[effect]]\nkind = \"spring\"\nstiffness = 40\n"), oscillator_name, {"1", "100"}, 40,
                        11);
}

/// One stiff spring beside a weak one: 10^12 apart.
TEST(Oscillator, OfUnevenStiffness) {
  expect_follows_taylor(free(2,
                             "[[effect]]\nkind = \"spring\"\nstiffness = \"1e6\"\n[[effect]]\nkind = \"trap\"\ncenter "
                             "= \"o\"\nexponent = 2\nstiffness = \"1e-6\"\n"),
                        oscillator_name, {"1/3"}, 40, 12);
}

TEST(Oscillator, NothingElseMayAct) {
  Fractions random(33);
  expect_unknown(
      net(random, 2, "[[effect]]\nkind = \"trap\"\nexponent = 4\ncenter = \"wall\"\nstiffness = \"1e-30\"\n"));
  expect_unknown(net(
      random, 2, "[[effect]]\nkind = \"spring\"\nbetween = [[\"a\", \"c\"]]\nstiffness = 1\nrest_length = \"1e-9\"\n"));
  expect_unknown(
      net(random, 3, "[[effect]]\nkind = \"spring\"\nbetween = [[\"a\", \"c\"]]\nstiffness = 1\nexponent = 3\n"));
  expect_unknown(
      net(random, 2, "[[effect]]\nkind = \"mutual_gravity\"\nbetween = [[\"a\", \"c\"]]\nstrength = \"1e-20\"\n"));
  expect_unknown(
      "dimension = 2\n[[body]]\nname = \"a\"\nmass = 1\nposition = [0, 0]\nvelocity = [1, 0]\n[[constraint]]\n"
      "kind = \"plane\"\nbody = \"a\"\nnormal = [0, 1]\noffset = 0\n");
}

TEST(Oscillator, HasAThousandDigits) {
  Fractions random(34);
  expect_solves_equations(net(random, 2), {"10"}, 1000);
}

}  // namespace
}  // namespace hbvm::core
