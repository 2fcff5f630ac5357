#include "scene/orientation.hpp"

#include "scene/assembled.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

SceneVector numbers(const std::vector<std::string>& texts) {
  SceneVector result;
  for (const std::string& text : texts) result.push_back(Expression::parse(text));
  return result;
}

/// A disc on a ball joint, turned as `orientation` says.
std::string disc(const std::string& orientation) {
  return "dimension = 3\n[[rigid_body]]\nname = \"disc\"\nfixed_at = [0, 0, 0]\nmass = 2\ncenter = [0, 0, 1]\n"
         "second_moment = [[1, 0, 0], [0, 1, 0], [0, 0, 3]]\nangular_velocity = [1, 2, 3]\norientation = " +
         orientation + "\n";
}

std::string bar(const std::string& orientation) {
  return "dimension = 2\n[[rigid_body]]\nname = \"bar\"\nfixed_at = [0, 0]\nmass = 2\ncenter = [1, 0]\n"
         "second_moment = [[3, 0], [0, 1]]\nangular_velocity = 1\norientation = " +
         orientation + "\n";
}

class OrientationTest : public InDigits<40> {
 protected:
  using Rows = std::vector<std::vector<Mpfr>>;

  static Rows values(const SceneMatrix& directors) {
    Rows result;
    for (const SceneVector& row : directors) {
      result.emplace_back();
      for (const Expression& e : row) result.back().push_back(evaluate<Mpfr>(e, {}));
    }
    return result;
  }

  static void expect_same(const SceneMatrix& directors, const Rows& expected) {
    const Rows got = values(directors);
    ASSERT_EQ(got.size(), expected.size());
    for (std::size_t i = 0; i < got.size(); ++i)
      for (std::size_t j = 0; j < got.size(); ++j)
        EXPECT_LE(abs(got[i][j] - expected[i][j]), 4 * epsilon<Mpfr>()) << i << ", " << j;
  }

  /// R v of the turn whose rows are R e_i.
  static std::vector<Mpfr> turned(const Rows& directors, const std::vector<Mpfr>& v) {
    std::vector<Mpfr> result(v.size(), Mpfr(0));
    for (std::size_t i = 0; i < v.size(); ++i)
      for (std::size_t j = 0; j < v.size(); ++j) result[j] += v[i] * directors[i][j];
    return result;
  }
};

/// The columns of tables: rotations by a third of a turn about the diagonal, and by a quarter about z.
TEST_F(OrientationTest, TurnsAsTablesHaveIt) {
  const Rows cycle{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}, quarter{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}};
  expect_same(turned_by_quaternion(numbers({"3", "3", "3", "3"})), cycle);
  expect_same(turned_about_axis(numbers({"2", "2", "2"}), Expression::parse("2*pi/3")), cycle);
  expect_same(turned_about_axis(numbers({"0", "0", "5"}), Expression::parse("pi/2")), quarter);
  expect_same(turned_by_quaternion(numbers({"1", "0", "0", "1"})), quarter);
  expect_same(turned_by_euler_angles(numbers({"pi/2", "0", "0"}), "zxz"), quarter);
  expect_same(turned_by_euler_angles(numbers({"0", "0", "pi/2"}), "zxz"), quarter);
  expect_same(turned_by_angle(Expression::parse("pi/2")), {{0, 1}, {-1, 0}});
}

/// The axis stays, and a quaternion (cos a/2, n sin a/2) turns by a.
TEST_F(OrientationTest, ByAxisAndByQuaternionIsTheSame) {
  const SceneMatrix about = turned_about_axis(numbers({"2", "-3", "6"}), Expression::parse("1.1"));
  const std::vector<Mpfr> axis = turned(values(about), {2, -3, 6});
  for (const auto& [got, expected] : {std::pair(axis[0], 2), {axis[1], -3}, {axis[2], 6}})
    EXPECT_LE(abs(got - expected), 64 * epsilon<Mpfr>());
  expect_same(about,
              values(turned_by_quaternion(numbers({"7*cos(1.1/2)", "2*sin(1.1/2)", "-3*sin(1.1/2)", "6*sin(1.1/2)"}))));
}

/// R = R_z(a) R_y(b) R_x(c) takes v through the turns from the last to the first, each about an axis of space.
TEST_F(OrientationTest, EulerAnglesAreAboutAxesOfTheBody) {
  const SceneMatrix R = turned_by_euler_angles(numbers({"0.3", "-0.7", "2"}), "zyx");
  const auto about = [](const char* x, const char* y, const char* z, const char* angle) {
    return values(turned_about_axis(numbers({x, y, z}), Expression::parse(angle)));
  };
  const std::vector<Mpfr> v{1, 2, -3};
  const std::vector<Mpfr> expected =
      turned(about("0", "0", "1", "0.3"), turned(about("0", "1", "0", "-0.7"), turned(about("1", "0", "0", "2"), v)));
  const std::vector<Mpfr> got = turned(values(R), v);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(abs(got[i] - expected[i]), 64 * epsilon<Mpfr>());
}

/// Decimals of a few digits make a scene that is consistent in any precision.
TEST_F(OrientationTest, IsOrthonormalInAnyPrecision) {
  for (const char* const orientation : {"{ quaternion = [0.3, -1, 0.21, 5] }", "{ axis = [1, 0.1, -2], angle = 0.123 }",
                                        "{ euler = [0.1, 0.2, 0.3], sequence = \"xyz\" }"}) {
    EXPECT_EQ(inconsistency<double>(disc(orientation)), "") << orientation;
    EXPECT_EQ(inconsistency<Mpfr>(disc(orientation)), "") << orientation;
  }
  EXPECT_EQ(inconsistency<Mpfr>(bar("0.4")), "");
  EXPECT_EQ(inconsistency<Mpfr>(bar("{ angle = 0.4 }")), "");
  EXPECT_EQ(inconsistency<Mpfr>(bar("{ directors = [[\"3/5\", \"4/5\"], [\"-4/5\", \"3/5\"]] }")), "");
}

TEST_F(OrientationTest, IsRefusedWithWhatIsWrong) {
  const auto refusal = [](const std::string& text) { return message_of([&] { read_scene(text, "test.toml"); }); };
  expect_words(refusal(disc("0.3")), {"'disc'", "'orientation' must be a table", "quaternion"});
  expect_words(refusal(disc("{ quaternion = [0, 0, 0, 0] }")), {"'disc'", "'quaternion' must not be 0"});
  expect_words(refusal(disc("{ quaternion = [1, 0, 0] }")), {"'quaternion'", "4"});
  expect_words(refusal(disc("{ axis = [0, 0, 0], angle = 1 }")), {"'axis' must not be 0"});
  expect_words(refusal(disc("{ axis = [0, 0, 1] }")), {"'angle'"});
  expect_words(refusal(disc("{ euler = [0, 0, 1] }")), {"'sequence'"});
  for (const char* const sequence : {"zzx", "zx", "abc", "ZXZ"})
    expect_words(refusal(disc("{ euler = [0, 0, 1], sequence = \"" + std::string(sequence) + "\" }")), {"\"zxz\""});
  expect_words(refusal(disc("{ quaternions = [1, 0, 0, 0] }")), {"'quaternions'", "'quaternion'"});
  expect_words(refusal(disc("{ }")), {"quaternion"});
  expect_words(refusal(disc("{ quaternion = [1, 0, 0, 0] }\ndirectors = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]")),
               {"'orientation' or 'directors', not both"});
}

}  // namespace
}  // namespace hbvm::core
