#include "problem/constraint/hinge.hpp"

#include <Eigen/LU>

#include "printing.hpp"
#include "problem/constraint.hpp"
#include "scalar/random_values.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

template <class S>
class HingeTest : public InDigits<50> {
 protected:
  RandomValues<S> random{17};
  S tolerance = 1024 * epsilon<S>();

  /// Of bodies with directors at 0, 3, 6 and at 9, 12, 15, whose points are in one place.
  static ConstraintInput<S> input(const Vector<S>& axis, const Vector<S>& second_axis) {
    ConstraintInput<S> result;
    result.dimension = 3;
    using Of = typename Frame<S>::Of;
    result.frames["between"] = {Frame<S>{Of::rigid_body, {0, 3, 6}}, Frame<S>{Of::rigid_body, {9, 12, 15}}};
    result.pairs["between"] = {};
    result.vectors["axis"] = axis;
    result.vectors["second_axis"] = second_axis;
    return result;
  }
  static Vector<S> vector(int x, int y, int z) { return Vector<S>{{S(x), S(y), S(z)}}; }
  static Constraint<S> constraint(const auto& part) {
    Constraint<S> result{part.first, {}};
    std::visit([&](const auto& form) { result.form = form; }, part.second);
    return result;
  }
  static std::string refusal(const ConstraintInput<S>& input) {
    return message_of([&] { Hinge<S>::from(input); });
  }
};
TYPED_TEST_SUITE(HingeTest, AllScalars, ScalarNames);

/// Both g are 0 where the axes are parallel, however the bodies are turned about them. The unit vectors e and f of the
/// second body are across its axis. The squares of g add up to that of the sine of the angle between the axes.
TYPED_TEST(HingeTest, TellsTheAngleBetweenTheAxes) {
  using S = TypeParam;
  for (const auto& second : {this->vector(0, 0, 1), this->vector(0, -2, 0), this->vector(5, 0, 0),
                             this->vector(1, 2, -2), this->vector(3, 3, 3)}) {
    const Vector<S> first = this->vector(2, -1, 2);
    const auto parts = Hinge<S>::from(this->input(first, second));
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[0].first, "axis, 1");
    EXPECT_EQ(parts[1].first, "axis, 2");
    // The first body stands along the axes of space, the second is turned by a rational rotation.
    Vector<S> q = Vector<S>::Zero(18);
    for (Index a = 0; a < 3; ++a) q[4 * a] = 1;
    const int rotation[3][3] = {{2, 2, 1}, {-2, 1, 2}, {1, -2, 2}};
    Vector<S> n = Vector<S>::Zero(3);
    for (Index a = 0; a < 3; ++a)
      for (Index j = 0; j < 3; ++j) {
        q[9 + 3 * a + j] = S(rotation[a][j]) / 3;
        n[j] += second[a] * q[9 + 3 * a + j];
      }
    const S cosine_squared = first.dot(n) * first.dot(n) / (first.dot(first) * n.dot(n));
    S sum = 0;
    for (const auto& part : parts) {
      const S g = value(this->constraint(part), 3, q).g;
      sum += g * g;
    }
    EXPECT_LE(magnitude(S(sum - (1 - cosine_squared))), this->tolerance);
    // With the first axis in the same direction in space, either way round.
    for (const int way : {1, -2}) {
      for (const auto& part : Hinge<S>::from(this->input(Vector<S>(n * S(way)), second)))
        EXPECT_LE(magnitude(value(this->constraint(part), 3, q).g), this->tolerance);
    }
  }
}

/// Along directors the vectors across are directors: their products have no other terms.
TYPED_TEST(HingeTest, AlongADirectorTakesTheOthers) {
  using S = TypeParam;
  const std::vector<std::pair<Vector<S>, std::vector<Index>>> cases{
      {this->vector(1, 0, 0), {12, 15}}, {this->vector(0, 1, 0), {9, 15}}, {this->vector(0, 0, -4), {9, 12}}};
  for (const auto& [axis, others] : cases) {
    const auto parts = Hinge<S>::from(this->input(axis, axis));
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& product = std::get<DisplacementProduct<S>>(parts[i].second);
      ASSERT_EQ(product.x.blocks.size(), 1u);
      ASSERT_EQ(product.y.blocks.size(), 1u);
      EXPECT_EQ(product.y.blocks[0].offset, others[i]);
      EXPECT_EQ(magnitude(product.y.blocks[0].weight), 1);
      EXPECT_EQ(product.product, 0);
    }
  }
}

TYPED_TEST(HingeTest, WithoutASecondAxisTakesTheFirst) {
  using S = TypeParam;
  const auto full = this->input(this->vector(1, 2, 2), this->vector(1, 2, 2));
  auto shorter = full;
  shorter.vectors.erase("second_axis");
  const Vector<S> q = this->random.vector(18);
  const auto a = Hinge<S>::from(full), b = Hinge<S>::from(shorter);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(value(this->constraint(a[i]), 3, q).g, value(this->constraint(b[i]), 3, q).g);
}

TYPED_TEST(HingeTest, RefusesWhatHasNoAxis) {
  using S = TypeParam;
  expect_words(this->refusal(this->input(this->vector(0, 0, 0), this->vector(1, 0, 0))), {"'axis'"});
  expect_words(this->refusal(this->input(this->vector(1, 0, 0), this->vector(0, 0, 0))), {"'second_axis'"});
  auto mass_point = this->input(this->vector(1, 0, 0), this->vector(1, 0, 0));
  mass_point.frames["between"][0] = {Frame<S>::Of::nothing};
  expect_words(this->refusal(mass_point), {"no directions"});
  auto apart = this->input(this->vector(1, 0, 0), this->vector(1, 0, 0));
  apart.pairs["between"].shift = this->vector(0, 0, 1);
  expect_words(this->refusal(apart), {"apart"});
}

}  // namespace
}  // namespace hbvm::core
