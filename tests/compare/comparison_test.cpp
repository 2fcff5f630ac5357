#include "compare/comparison.hpp"

#include <fmt/format.h>

#include <cmath>

#include "printing.hpp"
#include "reference/known_motion.hpp"
#include "reference/scene_tables.hpp"
#include "scalar/text.hpp"
#include "step/rattle.hpp"

namespace hbvm::core {
namespace {

ComparisonRequest request_of(const std::string& csv, const Scene& scene = load_scene("simple_pendulum")) {
  ComparisonRequest request;
  request.scene = scene;
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

TEST(Comparison, FindsTheDigitThatIsWrong) {
  for (const int digit : {9, 40}) {
    const Comparison against = compare_with_reference(request_of(pendulum(digit)));
    ASSERT_EQ(against.files.size(), 1u);
    const FileComparison& file = against.files[0];
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
TEST(Comparison, ReadsAngles) {
  const PrecisionScope scope(60);
  std::string csv = "# by another program\nseconds, theta\n";
  for (const char* t : {"0", "1/2", "3"}) {
    const ExactPoint exact = known_motion("simple_pendulum", literal<Mpfr>(t));
    csv += fmt::format("{}, {}\n", to_text(literal<Mpfr>(t)), to_scientific(Mpfr(atan2(exact.q[0], -exact.q[1])), 30));
  }
  ComparisonRequest request = request_of(csv);
  request.map = {{"seconds", "t"}, {"sin(theta)", "bob.x"}, {"-cos(theta)", "bob.y"}};
  const Comparison against = compare_with_reference(request);
  ASSERT_EQ(against.files[0].times.size(), 2u);
  for (const ComponentDigits& c : against.files[0].components)
    for (const double digits : c.digits) EXPECT_GT(digits, 27) << c.name;
}

/// RATTLE at four steps is of order 2.
TEST(Comparison, FindsTheOrderOfConvergence) {
  ComparisonRequest request;
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
  const Comparison against = compare_with_reference(request);
  ASSERT_EQ(against.orders.size(), 3u);
  for (const OrderBetween& c : against.orders) EXPECT_NEAR(c.order, 2, 0.1);
  EXPECT_EQ(against.files[3].times.size(), most_times);
  EXPECT_EQ(against.files[3].times.back(), "2");
  ASSERT_FALSE(against.files[3].unused.empty());
}

TEST(Comparison, SaysWhichTimesItCouldNotUse) {
  const Comparison against = compare_with_reference(request_of("t,bob.x\n-2,0\n-1,0\n0,0\n1,0\n2,0\n"));
  EXPECT_EQ(against.files[0].times, (std::vector<std::string>{"1", "2"}));
  ASSERT_EQ(against.files[0].unused.size(), 2u);
  EXPECT_EQ(against.files[0].unused[0], "1 time at the start");
  EXPECT_EQ(against.files[0].unused[1], "2 times before the start");
}

/// What is read is looked at in every line, also where nothing is compared; what is not read is named.
TEST(Comparison, LooksAtEveryLineAndColumn) {
  std::string csv = "t,bob.x,lambda1,bob.ux\n";
  for (int n = 1; n <= 200; ++n) csv += fmt::format("{}/64,{},1,2\n", n, n == 7 ? "nan" : "1/3");
  expect_words(message_of([&] { compare_with_reference(request_of(csv)); }),
               {"theirs.csv:8: column 'bob.x' holds 'nan'"});
  const std::string cut = csv.replace(csv.find("nan"), 3, "1.2.3");
  expect_words(message_of([&] { compare_with_reference(request_of(cut)); }), {"theirs.csv:8: column 'bob.x' holds"});
  const Comparison against = compare_with_reference(request_of("t,bob.x,lambda1,bob.ux\n1,0,nan,2\n"));
  EXPECT_EQ(against.files[0].unused, std::vector<std::string>{"columns lambda1, bob.ux"});
}

/// The same times are found in the store, however they are written; others are computed.
TEST(Comparison, TakesWhatIsStored) {
  const Comparison stored = compare_with_reference(request_of("t,bob.x\n1e1,0.114003850418645211312316725708\n")),
                   computed =
                       compare_with_reference(request_of("t,bob.x\n5,0\n1e1,0.114003850418645211312316725708\n"));
  EXPECT_TRUE(stored.files[0].stored);
  EXPECT_FALSE(computed.files[0].stored);
  for (const Comparison* against : {&stored, &computed}) EXPECT_GT(against->files[0].components[0].digits.back(), 28);
}

/// With velocities the energy is known, too.
TEST(Comparison, KnowsTheEnergyByVelocities) {
  ComparisonRequest request = request_of(pendulum(40, "t,bob.x,bob.y,bob.vx,bob.vy"));
  request.scene.bodies.front().mass = Expression::parse("4");
  const Comparison against = compare_with_reference(request);
  ASSERT_EQ(against.files[0].H_drift.size(), 3u);
  EXPECT_LT(against.files[0].H_drift[0], -53);
  for (std::size_t c = 1; c < 4; ++c) EXPECT_GT(against.files[0].components[c].digits.back(), 53);
}

/// Orders are of errors at one time and of different steps.
TEST(Comparison, FindsNoOrderWhereThereIsNone) {
  ComparisonRequest request = request_of("t,bob.x\n1,0.8\n2,0.8\n");
  request.files.push_back({"others.csv", "t,bob.x\n1/2,0.4\n3/2,0.9\n"});
  request.files.push_back({"longer.csv", "t,bob.x\n1/2,0.4\n1,0.8\n3,0.7\n"});
  const Comparison against = compare_with_reference(request);
  ASSERT_EQ(against.orders.size(), 2u);
  for (const double order : {against.orders[0].order, against.orders[1].order, against.order()})
    EXPECT_TRUE(std::isnan(order));
}

/// A Runge-Kutta method of order 4, say: an error that falls by 16 when the step is halved, at times that all files
/// share. The names of the files say nothing.
ComparisonRequest shared_times(const std::vector<int>& steps) {
  const PrecisionScope scope(40);
  ComparisonRequest request;
  request.scene = load_scene("simple_pendulum");
  for (const int n : steps) {
    std::string csv = "t,bob.x\n";
    for (const char* t : {"1", "2"})
      csv += fmt::format(
          "{},{}\n", t,
          to_scientific(Mpfr(known_motion("simple_pendulum", literal<Mpfr>(t)).q[0] + 1 / pow(Mpfr(n), 4)), 30));
    request.files.push_back({fmt::format("h_{}.csv", n), csv});
  }
  return request;
}

TEST(Comparison, TakesTheStepsThatAreGiven) {
  ComparisonRequest request = shared_times({10, 160, 20, 80});
  EXPECT_TRUE(std::isnan(compare_with_reference(request).order())) << "by the times all steps are 1";
  for (ResultsFile& file : request.files) file.step = "1/" + file.name.substr(2, file.name.find('.') - 2);
  const Comparison against = compare_with_reference(request);
  ASSERT_EQ(against.orders.size(), 3u);
  constexpr std::size_t descending[] = {0, 2, 3, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(against.orders[i].coarse, descending[i]);
    EXPECT_EQ(against.orders[i].fine, descending[i + 1]);
    EXPECT_NEAR(against.orders[i].order, 4, 1e-6);
  }
  EXPECT_NEAR(against.order(), 4, 1e-6);
  // To t = 1 and 2, over a vector of size 1 or less.
  EXPECT_NEAR(against.least_digits(), 4, 0.5);
  // One that is stored may be no number; one that is given must be one.
  for (const std::string step : {"0", "0.01 s"}) {
    request.files[1].step.clear();
    request.files[1].description = R"({"hbvm:step": ")" + step + "\"}";
    EXPECT_EQ(compare_with_reference(request).files[1].step, 1) << step;
    request.files[1].step = step;
    EXPECT_THROW(compare_with_reference(request), InputError) << step;
  }
}

/// By the judge of five steps, and by the two smallest of fewer.
TEST(Comparison, MeasuresTheOrderOfAll) {
  const auto order_of = [](const std::vector<int>& steps) {
    ComparisonRequest request = shared_times(steps);
    for (ResultsFile& file : request.files) file.step = "1/" + file.name.substr(2, file.name.find('.') - 2);
    return compare_with_reference(request).measured_order;
  };
  for (const std::vector<int>& steps : {std::vector<int>{10, 20, 40, 80, 160}, {160, 10, 40}}) {
    const std::optional<MeasuredOrder> order = order_of(steps);
    ASSERT_TRUE(order);
    EXPECT_NEAR(order->value, 4, 1e-6);
    EXPECT_LT(order->uncertainty, 1e-4);
  }
  EXPECT_FALSE(order_of({10, 20}));
}

TEST(Comparison, FindsTheStepThatIsStored) {
  EXPECT_EQ(step_stored("t,x\n0,1\n", R"({"hbvm:step": "2*pi/64", "url": "f.csv"})"), "2*pi/64");
  EXPECT_EQ(step_stored("# by some program\n# step = 1/64\nt,x\n", ""), "1/64");
  EXPECT_EQ(step_stored("#step=0.5\nt,x\n", "{}"), "0.5");
  EXPECT_EQ(step_stored("t,x\n# step = 1\n", "[1]"), "");
  EXPECT_EQ(step_stored("# a step = 1 is too long\nt,x\n", "no JSON"), "");
}

/// A start that is another is said before any digits, with its component.
TEST(Comparison, ComparesTheStart) {
  const auto start_of = [](const std::string& rows) {
    return compare_with_reference(request_of("t,bob.x,bob.y,bob.px,bob.py\n" + rows + "1,0.8,-0.6,0.3,0.4\n")).files[0];
  };
  const Assembled<double> scene = assemble<double>(load_scene("simple_pendulum"));
  const auto row = [&](double y_sign, double px_factor, int digits) {
    return fmt::format("0,{:.{}g},{:.{}g},{:.{}g},{:.{}g}\n", scene.q0[0], digits, y_sign * scene.q0[1], digits,
                       px_factor * scene.p0[0], digits, scene.p0[1], digits);
  };
  for (const int digits : {4, 6, 17}) {
    const FileComparison same = start_of(row(1, 1, digits));
    EXPECT_TRUE(same.has_start);
    EXPECT_TRUE(same.start.empty()) << digits;
  }
  const FileComparison faster = start_of(row(1, 1.001, 17));
  ASSERT_EQ(faster.start.size(), 1u);
  EXPECT_EQ(faster.start[0].name, "bob.px");
  EXPECT_NEAR(faster.start[0].digits, 3, 0.1);
  EXPECT_FALSE(faster.start[0].opposite);
  const FileComparison upwards = start_of(row(-1, 1, 6));
  ASSERT_EQ(upwards.start.size(), 1u);
  EXPECT_EQ(upwards.start[0].name, "bob.y");
  EXPECT_TRUE(upwards.start[0].opposite);
  EXPECT_FALSE(start_of("").has_start);
  // A start of double in a file of 40 digits is another from the 17th on.
  const std::string third = "0.3333333333333333148296162562473909929395";
  ComparisonRequest request = request_of("t,bob.x,bob.px\n0,0," + third + "\n1,0.3,0.2\n");
  request.scene.bodies[0].velocity = {Expression::parse("1/3"), Expression::parse("0")};
  const FileComparison rounded = compare_with_reference(request).files[0];
  ASSERT_EQ(rounded.start.size(), 1u);
  EXPECT_NEAR(rounded.start[0].digits, 16, 0.5);
}

/// What is exactly 0 has no digits. How far it is off is said as it is.
TEST(Comparison, CountsNoDigitsOfRest) {
  const std::string at_rest = "dimension = 2\n" + point("pivot", "[0, 0]") + body("bob", "1", "[0, -1]", "[0, 0]") +
                              rod("pivot", "bob", "1") + field("[0, -1]");
  const Comparison against = compare_with_reference(
      request_of("t,bob.x,bob.y,bob.px,bob.py\n1,0,-1,0,0\n2,0,-1,1e-18,0\n", read_scene(at_rest, "at_rest")));
  const ComponentDigits& momentum = against.files[0].components[2];
  EXPECT_EQ(momentum.name, "bob.px");
  EXPECT_GT(momentum.digits[0], 15);
  EXPECT_TRUE(std::isnan(momentum.digits[1]));
  EXPECT_NEAR(momentum.off_zero, 1e-18, 1e-24);
  EXPECT_NEAR(against.least_digits(), 18, 1e-6);
}

/// A vector that is 0 at one time is compared with what it is at others.
TEST(Comparison, ComparesWhatIsZeroForAMomentWithItsSize) {
  const std::string thrown = "dimension = 2\n" + body("a", "1", "[0, 0]", "[0, 1]") + field("[0, -1]"),
                    csv = "t,a.x,a.y,a.px,a.py\n1/2,0,0.375,0,0.5\n1,0,0.5,0,1e-6\n2,0,0,0,-1\n";
  const FileComparison file = compare_with_reference(request_of(csv, read_scene(thrown, "thrown"))).files[0];
  EXPECT_NEAR(file.components[3].digits[1], 6, 1e-9) << "the greatest momentum is 1";
  EXPECT_GT(file.components[1].digits[2], 15) << "of a height that is 0 again";
}

TEST(Comparison, RefusesWhatItCannotRead) {
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
        {"t,bob.x\n-1,0\n", "no time in it is after the start"},
        {"0,1,2\n1,1,2\n", "theirs.csv:1: numbers stand where the names of columns are expected"}})
    expect_words(message_of([&, csv = csv] { compare_with_reference(request_of(csv)); }), {says});
}

/// Of positions alone neither H nor the hidden constraint is known.
TEST(Comparison, SaysNothingOfWhatIsNotThere) {
  const FileComparison file = compare_with_reference(request_of("t,bob.x\n1,0.8\n2,0.8\n")).files.front();
  EXPECT_FALSE(file.mostly);
  EXPECT_TRUE(file.H_drift.empty() && file.g_drift.empty() && file.hidden_drift.empty());
  EXPECT_EQ(file.by_growth.size(), 2U);
}

TEST(Comparison, DrawsDigitsAgainstTime) {
  ComparisonRequest request = request_of(pendulum(9));
  request.files.push_back({"some/where/of_another_program.csv", pendulum(20)});
  const Figure figure = comparison_figure(compare_with_reference(request), "simple_pendulum");
  ASSERT_EQ(figure.panels.size(), 2u);
  for (const Panel& panel : figure.panels) {
    EXPECT_EQ(panel.curves.size(), 4u);
    EXPECT_EQ(panel.curves[0].points.size(), 3u);
    EXPECT_EQ(panel.lines.size(), 1u) << "what the growth of errors would leave";
  }
  EXPECT_EQ(figure.panels[1].title, plain("of_another_program.csv"));
  EXPECT_NE(figure.panels[1].title, "of_another_program.csv") << "the words of a figure take _ for a subscript";
}

}  // namespace
}  // namespace hbvm::core
