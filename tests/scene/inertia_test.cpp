#include "scene/inertia.hpp"

#include "scene/assembled.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// A rigid body that spins about its reference point, with the keys of its mass.
std::string spinning(const std::string& keys) {
  return "dimension = 3\n[[rigid_body]]\nname = \"top\"\nposition = [0, 0, 0]\nvelocity = [0, 0, 0]\nmass = 3\n" +
         keys + "\ndirectors = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\nangular_velocity = [2, 3, 5]\n";
}

std::string turning(const std::string& keys) {
  return "dimension = 2\n[[rigid_body]]\nname = \"bar\"\nposition = [0, 0]\nvelocity = [0, 0]\nmass = 3\n" + keys +
         "\ndirectors = [[1, 0], [0, 1]]\nangular_velocity = 2\n";
}

Mpfr energy(const std::string& text) {
  const Assembled<Mpfr> scene = assembled<Mpfr>(text);
  StateEvaluator<Mpfr> point(scene.problem);
  return point.energy(scene.q0, scene.p0);
}

class InertiaTest : public InDigits<40> {};

/// T = 1/2 omega^T J omega about the centre of mass. With the centre at c, turning about 0 adds 1/2 m |omega x c|^2.
TEST_F(InertiaTest, GivesTheEnergyOfARotation) {
  EXPECT_EQ(energy(spinning("inertia = [7, 11, 13]")), Mpfr(7 * 4 + 11 * 9 + 13 * 25) / 2);
  EXPECT_EQ(energy(spinning("inertia = [[7, 1, 0], [1, 11, -2], [0, -2, 13]]")),
            Mpfr(7 * 4 + 11 * 9 + 13 * 25 + 2 * 6 - 4 * 15) / 2);
  // omega x c = (2, 3, 5) x (1, 0, 2) = (6, 1, -3)
  EXPECT_EQ(energy(spinning("inertia = [7, 11, 13]\ncenter = [1, 0, 2]")), Mpfr(7 * 4 + 11 * 9 + 13 * 25 + 3 * 46) / 2);
  EXPECT_EQ(energy(turning("inertia = 7")), Mpfr(7 * 4) / 2);
  EXPECT_LE(magnitude(Mpfr(energy(turning("inertia = 7\ncenter = [1, 2]")) - Mpfr((7 + 3 * 5) * 4) / 2)),
            64 * epsilon<Mpfr>());
}

/// A cube has the second moment that its inertia gives.
TEST_F(InertiaTest, IsTheSecondMomentOfTheSameBody) {
  const SceneMatrix S = second_moment_of({{Expression::parse("2"), Expression::parse("0"), Expression::parse("0")},
                                          {Expression::parse("0"), Expression::parse("2"), Expression::parse("0")},
                                          {Expression::parse("0"), Expression::parse("0"), Expression::parse("2")}},
                                         Expression::parse("m + 1"),
                                         {Expression::parse("1"), Expression::parse("0"), Expression::parse("2")});
  Constants constants;
  constants.emplace("m", Expression::parse("5"));
  const int expected[3][3] = {{1 + 6, 0, 12}, {0, 1, 0}, {12, 0, 1 + 24}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(evaluate<Mpfr>(S[i][j], constants), expected[i][j]) << i << j;
}

TEST_F(InertiaTest, IsRefusedWithWhatIsWrong) {
  const auto refusal = [](const std::string& text) { return message_of([&] { assembled<Mpfr>(text); }); };
  expect_words(refusal(spinning("inertia = [1, 1, 3]")), {"'top'", "'inertia'", "sum of the others"});
  expect_words(refusal(spinning("inertia = 3")), {"'top'", "'inertia'"});
  expect_words(refusal(spinning("inertia = [1, 1]")), {"'inertia'", "3"});
  expect_words(refusal(turning("inertia = -1")), {"'bar'", "not positive"});
  expect_words(refusal(turning("inertia = 1\nsecond_moment = [[1, 0], [0, 1]]")), {"not both"});
  expect_words(refusal(spinning("inertia = [[7, 1, 0], [0, 11, 0], [0, 0, 13]]")), {"symmetric"});
  expect_words(refusal(spinning("")), {"'second_moment'", "'inertia'"});
}

}  // namespace
}  // namespace hbvm::core
