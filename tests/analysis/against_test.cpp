#include "hbvm/analysis/against.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hbvm/error.hpp"
#include "hbvm/scalar/literal.hpp"
#include "hbvm/scalar/text.hpp"
#include "hbvm/scene/assemble.hpp"
#include "hbvm/step/rattle.hpp"
#include "printing.hpp"
#include "reference/known_motion.hpp"

namespace hbvm {
namespace {

AgainstRequest request_of(const std::string& csv) {
  AgainstRequest request;
  request.scene = load_scene("simple_pendulum");
  request.files = {{"theirs.csv", csv}};
  return request;
}

/// The pendulum at some times, with q_1 off by 10^-digit from the second on.
std::string pendulum(int digit, const std::string& names = "t,bob.x,bob.y,bob.px,bob.py") {
  const PrecisionScope scope(80);
  std::string csv = names + "\n";
  for (const char* t : {"1", "2", "4"}) {
    const ExactPoint exact = known_motion("simple_pendulum", literal<Mpfr>(t));
    Mpfr x = exact.q[0];
    if (std::string(t) != "1") x += literal<Mpfr>("1e-" + std::to_string(digit));
    csv += fmt::format("{},{},{},{},{}\n", t, to_scientific(x, 55), to_scientific(exact.q[1], 55),
                       to_scientific(exact.p[0], 55), to_scientific(exact.p[1], 55));
  }
  return csv;
}

TEST(Against, FindsTheDigitThatIsWrong) {
  for (const int digit : {9, 40}) {
    const Against against = compare_with_reference(request_of(pendulum(digit)));
    ASSERT_EQ(against.files.size(), 1u);
    const FileAgainst& file = against.files[0];
    ASSERT_EQ(file.components.size(), 4u);
    EXPECT_EQ(file.components[0].name, "bob.x");
    EXPECT_GT(file.components[0].digits[0], 53);
    EXPECT_NEAR(file.components[0].digits[1], digit, 0.5);
    EXPECT_NEAR(file.components[0].digits[2], digit, 0.5);
    for (std::size_t c = 1; c < 4; ++c)
      for (const double digits : file.components[c].digits) EXPECT_GT(digits, 53);
    ASSERT_EQ(file.H_drift.size(), 3u);
    EXPECT_LT(file.H_drift[0], -53);
    EXPECT_LT(file.g_drift[0], -53);
    EXPECT_GT(file.g_drift[1], -digit - 2);
  }
}

/// Theirs in an angle from the vertical, and a time of another name.
TEST(Against, ReadsAngles) {
  const PrecisionScope scope(60);
  std::string csv = "# by another program\nseconds, theta\n";
  for (const char* t : {"0", "1/2", "3"}) {
    const ExactPoint exact = known_motion("simple_pendulum", literal<Mpfr>(t));
    csv += fmt::format("{}, {}\n", to_text(literal<Mpfr>(t)), to_scientific(Mpfr(atan2(exact.q[0], -exact.q[1])), 30));
  }
  AgainstRequest request = request_of(csv);
  request.map = {{"seconds", "t"}, {"sin(theta)", "bob.x"}, {"-cos(theta)", "bob.y"}};
  const Against against = compare_with_reference(request);
  ASSERT_EQ(against.files[0].times.size(), 2u);
  for (const ComponentDigits& c : against.files[0].components)
    for (const double digits : c.digits) EXPECT_GT(digits, 27) << c.name;
}

/// RATTLE at four steps is of order 2.
TEST(Against, FindsTheOrderOfConvergence) {
  AgainstRequest request;
  request.scene = load_scene("simple_pendulum");
  const Assembled<double> scene = assemble<double>(request.scene);
  for (const int n : {16, 32, 64, 128}) {
    Rattle<double> rattle(scene.problem);
    State<double> state(scene.q0, scene.p0);
    std::string csv = "time,q_1,q_2,p_1,p_2\n";
    for (int i = 1; i <= 2 * n; ++i) {
      rattle.step(state, 1.0 / n);
      csv += fmt::format("{},{:.17g},{:.17g},{:.17g},{:.17g}\n", static_cast<double>(i) / n, state.q[0], state.q[1],
                         state.p[0], state.p[1]);
    }
    request.files.push_back({std::to_string(n), csv});
  }
  const Against against = compare_with_reference(request);
  ASSERT_EQ(against.orders.size(), 3u);
  for (const double order : against.orders) EXPECT_NEAR(order, 2, 0.1);
  EXPECT_EQ(against.files[3].times.size(), most_times);
  EXPECT_EQ(against.files[3].times.back(), "2");
  ASSERT_FALSE(against.files[3].unused.empty());
}

TEST(Against, SaysWhichTimesItCouldNotUse) {
  const Against against = compare_with_reference(request_of("t,bob.x\n-2,0\n-1,0\n0,0\n1,0\n2,0\n"));
  EXPECT_EQ(against.files[0].times, (std::vector<std::string>{"1", "2"}));
  ASSERT_EQ(against.files[0].unused.size(), 2u);
  EXPECT_EQ(against.files[0].unused[0], "1 times at the start");
  EXPECT_EQ(against.files[0].unused[1], "2 times before the start");
}

/// The same times are found in the store, however they are written; others are computed.
TEST(Against, TakesWhatIsStored) {
  const Against stored = compare_with_reference(request_of("t,bob.x\n1e1,0.114003850418645211312316725708\n")),
                computed = compare_with_reference(request_of("t,bob.x\n5,0\n1e1,0.114003850418645211312316725708\n"));
  EXPECT_TRUE(stored.files[0].stored);
  EXPECT_FALSE(computed.files[0].stored);
  for (const Against* against : {&stored, &computed}) EXPECT_GT(against->files[0].components[0].digits.back(), 28);
}

/// With velocities the energy is known, too.
TEST(Against, KnowsTheEnergyByVelocities) {
  AgainstRequest request = request_of(pendulum(40, "t,bob.x,bob.y,bob.vx,bob.vy"));
  request.scene.bodies.front().mass = Expression::parse("4");
  const Against against = compare_with_reference(request);
  ASSERT_EQ(against.files[0].H_drift.size(), 3u);
  EXPECT_LT(against.files[0].H_drift[0], -53);
  for (std::size_t c = 1; c < 4; ++c) EXPECT_GT(against.files[0].components[c].digits.back(), 53);
}

/// Orders are of errors at one time and of different steps.
TEST(Against, FindsNoOrderWhereThereIsNone) {
  AgainstRequest request = request_of("t,bob.x\n1,0.8\n2,0.8\n");
  request.files.push_back({"others.csv", "t,bob.x\n1/2,0.4\n3/2,0.9\n"});
  request.files.push_back({"longer.csv", "t,bob.x\n1/2,0.4\n1,0.8\n3,0.7\n"});
  const Against against = compare_with_reference(request);
  ASSERT_EQ(against.orders.size(), 2u);
  EXPECT_TRUE(std::isnan(against.orders[0]));
  EXPECT_TRUE(std::isnan(against.orders[1]));
}

/// Of what is 0 nothing that moves is right, however small.
TEST(Against, FindsNoDigitsOfRest) {
  AgainstRequest request;
  request.scene = read_scene(
      "dimension = 2\npoint = [{ name = \"pivot\", position = [0, 0] }]\nbody = [{ name = \"bob\", mass = 1, position "
      "= [0, -1], velocity = [0, 0] }]\nconstraint = [{ kind = \"rod\", between = [\"pivot\", \"bob\"], length = 1 "
      "}]\neffect = [{ kind = "
      "\"uniform_gravity\", acceleration = [0, -1] }]\n",
      "at_rest");
  request.files = {{"theirs.csv", "t,bob.x,bob.y,bob.px,bob.py\n1,0,-1,0,0\n2,0,-1,1e-18,0\n"}};
  const Against against = compare_with_reference(request);
  const ComponentDigits& momentum = against.files[0].components[2];
  EXPECT_EQ(momentum.name, "bob.px");
  EXPECT_GT(momentum.digits[0], 15);
  EXPECT_EQ(momentum.digits[1], 0);
}

TEST(Against, RefusesWhatItCannotRead) {
  for (const auto& [csv, says] :
       {std::pair("", "theirs.csv: no line"),
        {"t,bob.x\n", "theirs.csv: no line"},
        {"t,bob.x\n1\n", "theirs.csv:2: 1 cells"},
        {"# c\n\nt,bob.x\n1,0\n2,nan\n", "theirs.csv:5: column 'bob.x' holds 'nan'"},
        {"t,bob.x\n1,x\n", "theirs.csv:2: column 'bob.x' holds 'x'"},
        {"t,bob.x\n1,\n", "theirs.csv:2: column 'bob.x' holds ''"},
        {"t,bob.x\ninf,1\n", "theirs.csv:2: column 't' holds 'inf'"},
        {"bob.x\n1\n", "no column is called t"},
        {"t,z\n1,2\n", "no column is one of bob.x"},
        {"t,bob.x\n1,0\n2,0\n2.0,0\n", "theirs.csv:4: t is 2.0, which is not later than 2 in line 3"},
        {"t,bob.x\n2,0\n1,0\n", "theirs.csv:3: t is 1, which is not later than 2 in line 2"},
        {"t,bob.x\n-1,0\n", "no time in it is after the start"}})
    try {
      compare_with_reference(request_of(csv));
      FAIL() << csv;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
    }
}

TEST(Against, DrawsDigitsAgainstTime) {
  const AgainstRequest request = request_of(pendulum(9));
  const Figure figure = against_figure(request, compare_with_reference(request), "against");
  ASSERT_EQ(figure.panels.size(), 1u);
  EXPECT_EQ(figure.panels[0].curves.size(), 4u);
  EXPECT_EQ(figure.panels[0].curves[0].points.size(), 3u);
  EXPECT_EQ(figure.panels[0].lines.size(), 1u);
}

}  // namespace
}  // namespace hbvm
