#include "scene/second_moment.hpp"

#include "printing.hpp"
#include "scene/scene_text.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

template <class S>
class SecondMoment : public InDigits<50> {
 protected:
  using Rows = std::vector<std::vector<int>>;

  /// Whole numbers over `denominator`.
  static MassDistribution<S> body(int mass, const std::vector<int>& center, const Rows& moment, int denominator = 1) {
    const auto d = static_cast<Index>(center.size());
    MassDistribution<S> of{S(mass), Vector<S>(d), Matrix<S>(d, d)};
    for (Index i = 0; i < d; ++i) {
      const auto row = static_cast<std::size_t>(i);
      of.center[i] = S(center[row]);
      for (Index j = 0; j < d; ++j) of.second_moment(i, j) = S(moment[row][static_cast<std::size_t>(j)]) / denominator;
    }
    return of;
  }
  static std::string refused(const MassDistribution<S>& of, bool fixed) {
    return core::refused([&] { usable_second_moment(of, fixed); });
  }
};
TYPED_TEST_SUITE(SecondMoment, AllScalars, ScalarNames);

TYPED_TEST(SecondMoment, OfABodyIsTakenAsItIs) {
  for (const bool fixed : {false, true}) {
    const auto box = this->body(2, {1, 0, -1}, {{3, 0, -2}, {0, 1, 0}, {-2, 0, 4}});
    EXPECT_EQ(usable_second_moment(box, fixed), box.second_moment);
    const auto bar = this->body(1, {1, 0}, {{4, 1}, {1, 2}});
    EXPECT_EQ(usable_second_moment(bar, fixed), bar.second_moment);
  }
}

/// A sheet across d3 on a stick along it has nothing along d3 about its centre of mass.
TYPED_TEST(SecondMoment, OfASheetMayHaveRoundOff) {
  auto sheet = this->body(3, {0, 0, 1}, {{2, 0, 0}, {0, 2, 0}, {0, 0, 3}});
  EXPECT_EQ(this->refused(sheet, true), "");
  sheet.second_moment(2, 2) -= TypeParam(1) / 100'000'000;
  EXPECT_EQ(this->refused(sheet, true), "");
  sheet.second_moment(2, 2) -= TypeParam(1) / 1'000;
  EXPECT_NE(this->refused(sheet, true).find("S - m c c^T is not positive semidefinite"), std::string::npos);
}

/// Moments of inertia 1, 2 and 3: the message says what is wrong with it, and what to do.
TYPED_TEST(SecondMoment, OfAFlatBodyInSpaceIsRefused) {
  const auto plate = this->body(1, {0, 0, 0}, {{2, 0, 0}, {0, 1, 0}, {0, 0, 0}});
  expect_words(this->refused(plate, false), {"no thickness", "centre of mass", "sum of the other two", "2.999"});
  expect_words(this->refused(plate, true), {"no thickness", "fixed point"});
  auto rounded = plate, thin = plate;
  rounded.second_moment(2, 2) = epsilon<TypeParam>();
  EXPECT_NE(this->refused(rounded, false), "");
  thin.second_moment(2, 2) = TypeParam(1) / 10'000;
  EXPECT_EQ(this->refused(thin, false), "");
}

/// J of a bar of length 2 and mass 3 about its middle, the reference point being its end.
TYPED_TEST(SecondMoment, RefusesAnInertiaTensor) {
  for (const bool fixed : {false, true}) {
    const auto bar = this->body(3, {1, 0, 0}, {{1, 0, 0}, {0, 101, 0}, {0, 0, 101}}, 100);
    const std::string message = this->refused(bar, fixed);
    expect_words(message, {"no body has this 'second_moment'", "S = tr(J)/2 I - J + m c c^T", "about c"});
  }
}

/// It is negative along (1, -1, 0) alone.
TYPED_TEST(SecondMoment, IsSeenInEveryDirection) {
  EXPECT_NE(this->refused(this->body(1, {0, 0, 0}, {{2, 3, 0}, {3, 2, 0}, {0, 0, 1}}), true), "");
  EXPECT_EQ(this->refused(this->body(1, {0, 0, 0}, {{3, 2, 0}, {2, 3, 0}, {0, 0, 1}}), true), "");
}

TYPED_TEST(SecondMoment, InThePlaneCountsByItsTrace) {
  // A bar of length 1 about its end, 1/3, shared out evenly: no body has it, and a body with this trace moves alike.
  for (const bool fixed : {false, true}) {
    auto bar = this->body(4, {1, 0}, {{8, 0}, {0, 8}}, 3);
    Matrix<TypeParam> usable = usable_second_moment(bar, fixed);
    if (fixed)
      EXPECT_EQ(usable, bar.second_moment);
    else
      usable -= bar.mass * bar.center * bar.center.transpose();
    EXPECT_GT(usable(0, 0), 0);
    EXPECT_GT(TypeParam(usable(0, 0) * usable(1, 1) - usable(0, 1) * usable(1, 0)), 0);
    const TypeParam inertia = usable(0, 0) + usable(1, 1), expected = TypeParam(16) / 3 - (fixed ? 0 : 4);
    EXPECT_LE(magnitude(TypeParam(inertia - expected)), 64 * epsilon<TypeParam>());
    bar.second_moment = bar.second_moment / TypeParam(2);
    const std::string message = this->refused(bar, fixed);
    expect_words(message, {"tr(S) - m |c|^2 is not positive", "J + m |c|^2"});
  }
}

/// A thin rod, and a mass point on a rod.
TYPED_TEST(SecondMoment, InThePlaneMayBeSingular) {
  const auto rod = this->body(1, {0, 0}, {{2, 0}, {0, 0}});
  for (const bool fixed : {false, true})
    EXPECT_EQ(usable_second_moment(rod, fixed), (Matrix<TypeParam>::Identity(2, 2)));
  const auto bob = this->body(2, {1, 0}, {{2, 0}, {0, 0}});
  EXPECT_EQ(usable_second_moment(bob, true), (Matrix<TypeParam>::Identity(2, 2)));
  EXPECT_NE(this->refused(bob, false), "");
}

TEST(MomentsOfInertia, AreThoseAboutTheCentreOfMass) {
  MassDistribution<double> of{2, Vector<double>(3), Matrix<double>(3, 3)};
  of.center << 1, 0, 0;
  of.second_moment << 3, 0, 0, 0, 4, 1, 0, 1, 4;
  // About the centre 1 along d1, and 3 and 5 along the diagonals of d2 and d3.
  const std::vector<double> moments = moments_of_inertia(of), expected{4, 6, 8};
  ASSERT_EQ(moments.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(moments[i], expected[i], 1e-14);
  MassDistribution<double> flat{2, Vector<double>(2), Matrix<double>(2, 2)};
  flat.center << 1, 0;
  flat.second_moment << 3, 1, 1, 4;
  EXPECT_EQ(moments_of_inertia(flat), (std::vector<double>{5}));
}

}  // namespace
}  // namespace hbvm::core
