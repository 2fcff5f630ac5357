#include "integrate/constraint_drift.hpp"

#include "integrate/runs.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

template <class S>
class Rods : public InDigits<50> {
 protected:
  /// Two bodies of uneven masses on rods, in this unit of length and so far from the origin. The second rod is as long
  /// as this at the mesh points.
  typename ConstraintDrift<S>::Worst of(const std::vector<const char*>& lengths, const char* unit = "1",
                                        const char* away = "0") {
    const std::string u = unit, x = away;
    const Scene text =
        read_scene("dimension = 2\n[constants]\nu = \"" + u + "\"\nx = \"" + x +
                       "\"\n[[point]]\nname = \"o\"\nposition = [\"x\", 0]\n"
                       "[[body]]\nname = \"a\"\nmass = 2\nposition = [\"x+u\", 0]\nvelocity = [0, 0]\n"
                       "[[body]]\nname = \"b\"\nmass = \"1/1000\"\nposition = [\"x+u\", \"2*u\"]\nvelocity = [0, 0]\n"
                       "[[constraint]]\nkind = \"rod\"\nbetween = [\"o\", \"a\"]\nlength = \"u\"\n"
                       "[[constraint]]\nkind = \"rod\"\nbetween = [\"a\", \"b\"]\nlength = \"2*u\"\n",
                   "rods");
    const Assembled<S> scene = assemble<S>(text);
    ConstraintGradient<S> gradient(scene.problem, 1);
    ConstraintDrift<S> drift(scene.problem, S(1000) * epsilon<S>());
    Matrix<S> g = Matrix<S>::Zero(1, 2);
    long n = 0;
    for (const char* length : lengths) {
      Snapshot<S> snapshot{n, S(n), scene.q0, scene.p0, {}};
      snapshot.q[3] = literal<S>(length) * evaluate<S>(Expression::parse(u), {});
      gradient.update(lanes(snapshot.q), g);
      drift.observe(gradient, g, snapshot);
      ++n;
    }
    return drift.worst();
  }
};
TYPED_TEST_SUITE(Rods, AllScalars, ScalarNames);

TYPED_TEST(Rods, DriftByTheErrorOfTheirLength) {
  for (const char* unit : {"1", "2^(-30)", "2^20"}) {
    const auto worst = this->of({"2", "2.002", "1.94", "2.01"}, unit);
    EXPECT_EQ(worst.constraint, 1);
    EXPECT_EQ(worst.t, 2);
    // g over twice the square of the length: to first order the relative error of the length.
    EXPECT_NEAR(approximately(worst.drift), (4 - 1.94 * 1.94) / (2 * 1.94 * 1.94), 1e-12) << unit;
    EXPECT_TRUE(worst.lost);
    EXPECT_EQ(worst.lost_t, 2);
  }
}

TYPED_TEST(Rods, DriftAsMuchFarFromTheOrigin) {
  EXPECT_NEAR(approximately(this->of({"2", "1.94"}, "1", "2^20").drift), (4 - 1.94 * 1.94) / (2 * 1.94 * 1.94), 1e-9);
}

TYPED_TEST(Rods, AreLostFromAHundredthOn) {
  EXPECT_FALSE(this->of({"2", "2.018", "1.982"}).lost);
  EXPECT_TRUE(this->of({"2", "2.022"}).lost);
  EXPECT_EQ(this->of({"2", "2.022", "2.1"}).lost_t, 1);
  EXPECT_EQ(this->of({"2", "2"}).drift, 0);
}

TYPED_TEST(Rods, DoNotDriftByRounding) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("simple_pendulum"));
  ConstraintGradient<S> gradient(scene.problem, 1);
  ConstraintDrift<S> drift(scene.problem, S(1000) * epsilon<S>());
  Matrix<S> g = Matrix<S>::Zero(1, 1);
  for (long n = 0; n < 2; ++n) {
    Snapshot<S> snapshot{n, S(n), scene.q0, scene.p0, {}};
    snapshot.q[1] *= 1 + n * 100 * epsilon<S>();
    gradient.update(lanes(snapshot.q), g);
    drift.observe(gradient, g, snapshot);
  }
  EXPECT_EQ(drift.worst().drift, 0);
}

}  // namespace
}  // namespace hbvm::core
