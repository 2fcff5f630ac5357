#include "reference/closed_form/recognition.hpp"

#include "printing.hpp"
#include "reference/scene_tables.hpp"

namespace hbvm::core {
namespace {

Assembled<Mpfr> two_bodies(const std::string& stiffness) {
  const std::string text = "dimension = 3\n" + point("o", "[1, 2, 3]") +
                           body("a", "[[2, 0, 0], [0, 2, 0], [0, 0, 2]]", "[1, 2, 1]", "[1, 0, 0]") +
                           body("b", "[[2, 0, 0], [0, 2, 0], [0, 0, 3]]", "[0, 0, 0]", "[0, 0, 0]") +
                           field("[0, 1, -3]") +
                           effect("trap", "exponent = 2\ncenter = \"o\"\non = [\"a\"]\nstiffness = " + stiffness);
  return assemble<Mpfr>(read_scene(text, "two bodies"));
}

TEST(Recognition, KnowsWhatActs) {
  const PrecisionScope scope(40);
  const Assembled<Mpfr> idle = two_bodies("0"), busy = two_bodies("5");
  const Recognition one(idle, epsilon<Mpfr>()), other(busy, epsilon<Mpfr>());
  EXPECT_EQ(one.acting.size(), 2u);
  EXPECT_EQ(other.acting.size(), 3u);
  ASSERT_TRUE(one.is_constant_force());
  EXPECT_FALSE(other.is_constant_force());
  const Vector<Mpfr> force = one.constant_force();
  const int expected[] = {0, 2, -6, 0, 2, -9};
  for (Index j = 0; j < 6; ++j) EXPECT_EQ(force[j], expected[j]);
  const Matrix<Mpfr> hessian = other.acting.back().hessian(Vector<Mpfr>::Zero(3));
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 3; ++j) EXPECT_EQ(hessian(i, j), i == j ? -5 : 0);
  const Vector<Mpfr> gradient = other.acting.back().gradient(Vector<Mpfr>::Unit(3, 1));
  for (Index j = 0; j < 3; ++j) EXPECT_EQ(gradient[j], j == 1 ? -5 : 0);
}

TEST(Recognition, KnowsMassesThatAreOneNumber) {
  const PrecisionScope scope(40);
  const Assembled<Mpfr> scene = two_bodies("0");
  const Recognition content(scene, epsilon<Mpfr>());
  ASSERT_TRUE(content.mass_at(0));
  EXPECT_EQ(*content.mass_at(0), 2);
  EXPECT_FALSE(content.mass_at(3));
  EXPECT_FALSE(content.mass_at(6));
}

TEST(Recognition, KnowsSpheres) {
  const PrecisionScope scope(40);
  const std::string bead = "dimension = 3\n" + point("o", "[1, 2, 3]") + body("a", "2", "[1, 2, 1]", "[1, 0, 0]");
  for (const std::string& constraint : {rod("a", "o", "2"), rod("o", "a", "2"),
                                        quadric("a", "[[-3, 0, 0], [0, -3, 0], [0, 0, -3]]", "[6, 12, 18]", "-30")}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(bead + constraint, "sphere"));
    const auto sphere = Recognition(scene, epsilon<Mpfr>()).on_sphere();
    ASSERT_TRUE(sphere) << constraint;
    EXPECT_EQ(sphere->radius, 2);
    EXPECT_EQ(sphere->mass, 2);
    for (Index j = 0; j < 3; ++j) EXPECT_EQ(sphere->pivot[j], j + 1);
  }
  const Assembled<Mpfr> flat = assemble<Mpfr>(read_scene(bead + plane("a", "[0, 0, 1]", "1"), "plane"));
  EXPECT_FALSE(Recognition(flat, epsilon<Mpfr>()).on_sphere());
}

TEST(Recognition, Vectors) {
  const PrecisionScope scope(30);
  Vector<Mpfr> a(3), b(3);
  a << 1, 2, 2;
  b << 0, 3, -1;
  EXPECT_EQ(norm(a), 3);
  EXPECT_EQ(inner(a, b), 4);
  const Vector<Mpfr> c = cross(a, b);
  EXPECT_EQ(c[0], -8);
  EXPECT_EQ(c[1], 1);
  EXPECT_EQ(c[2], 3);
}

}  // namespace
}  // namespace hbvm::core
