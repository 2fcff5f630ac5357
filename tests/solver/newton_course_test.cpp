#include "solver/newton_course.hpp"

#include "printing.hpp"
#include "scalar/binary_exponent.hpp"

namespace hbvm::core {
namespace {

template <class T>
class NewtonCourseTest : public InDigits<50> {
 protected:
  using Course = NewtonCourse<T>;

  static Course cheap() { return {T(100) * epsilon<T>(), 3, false}; }
  static Course expensive() { return {T(100) * epsilon<T>(), 60, true}; }
  /// Makes steps with these increments. \return whether the Jacobian of the next iterate is a new one
  static bool make(Course& course, std::initializer_list<T> increments) {
    long sweep = 0;
    for (const T& increment : increments) {
      course.change() = increment;
      EXPECT_FALSE(course.went_too_far());
      course.go_on(++sweep);
    }
    return course.evaluates();
  }
};
TYPED_TEST_SUITE(NewtonCourseTest, AllScalars, ScalarNames);

/// A factor of 10 a sweep is fast, less is not.
TYPED_TEST(NewtonCourseTest, KeepsACheapJacobianWhileIncrementsFallFast) {
  using S = TypeParam;
  auto course = this->cheap();
  course.start(true);
  EXPECT_TRUE(course.begins());
  EXPECT_TRUE(course.evaluates());
  EXPECT_FALSE(this->make(course, {S(1), S(1) / 16}));
  EXPECT_TRUE(this->make(course, {S(1) / 64}));
  // Of rounding no Jacobian is mended.
  course.start(true);
  EXPECT_FALSE(this->make(course, {S(1), S(4) * epsilon<S>(), S(3) * epsilon<S>()}));
}

/// An expensive one also while they fall by an eighth: those left are cheaper than sixty sweeps.
TYPED_TEST(NewtonCourseTest, KeepsAnExpensiveJacobianLonger) {
  using S = TypeParam;
  auto course = this->expensive();
  course.start(true);
  EXPECT_FALSE(this->make(course, {power_of_two<S>(-1), power_of_two<S>(-4), power_of_two<S>(-7), power_of_two<S>(-10),
                                   power_of_two<S>(-13), power_of_two<S>(-16), power_of_two<S>(-19)}));
  // Where they do not fall at all it is a new one.
  EXPECT_TRUE(this->make(course, {power_of_two<S>(-19), power_of_two<S>(-19), power_of_two<S>(-19)}));
}

/// The Jacobian is evaluated where that costs less than the sweeps that it saves.
TYPED_TEST(NewtonCourseTest, WeighsAnEvaluationAgainstTheSweepsItSaves) {
  using S = TypeParam;
  const S tolerance = power_of_two<S>(-32);
  for (const auto& [sweeps_an_evaluation, evaluates] : {std::pair(0.5, true), {8., false}}) {
    NewtonCourse<S> course(tolerance, sweeps_an_evaluation, true);
    course.start(true);
    // Two bits a sweep, eight sweeps to go.
    EXPECT_EQ(this->make(course, {power_of_two<S>(-8), power_of_two<S>(-10), power_of_two<S>(-12), power_of_two<S>(-14),
                                  power_of_two<S>(-16)}),
              evaluates)
        << sweeps_an_evaluation;
  }
}

/// Increments that grow are steps too far: by half, and half again, if the Jacobian is that of the iterate before, and
/// else taken back.
TYPED_TEST(NewtonCourseTest, TakesBackStepsTooFar) {
  using S = TypeParam;
  auto course = this->cheap();
  course.start(true);
  this->make(course, {S(1) / 8});
  course.change() = S(1) / 4;
  ASSERT_TRUE(course.went_too_far());
  EXPECT_TRUE(course.is_exact());
  for (int n = 1; n <= 12; ++n) EXPECT_EQ(course.halve(), n);
  EXPECT_EQ(course.halve(), 0);

  course.start(false);
  this->make(course, {S(1) / 8});
  course.change() = S(1) / 4;
  ASSERT_TRUE(course.went_too_far());
  EXPECT_FALSE(course.is_exact());
  course.take_back();
  EXPECT_TRUE(course.evaluates());
  EXPECT_TRUE(course.begins());
  EXPECT_FALSE(course.went_too_far());
}

/// Three increments that do not fall with the Jacobian of the iterate itself, with half of the digits or more.
TYPED_TEST(NewtonCourseTest, EndsOnTheFloorOfRounding) {
  using S = TypeParam;
  const auto floor_after = [&](const S& size) {
    auto course = this->cheap();
    course.start(true);
    for (long sweep = 1; sweep < 20; ++sweep) {
      course.change() = size;
      if (course.is_on_floor()) return sweep;
      course.go_on(sweep);
    }
    return 0L;
  };
  EXPECT_EQ(floor_after(S(1) / 4), 0);
  EXPECT_EQ(floor_after(S(1000) * epsilon<S>()), 5);
}

}  // namespace
}  // namespace hbvm::core
