#include "reference/closed_form/rigid_shape.hpp"

#include "reference/closed_form/rigid_scenes.hpp"

namespace hbvm::core {
namespace {

std::optional<RigidShape> shape_of(const std::string& toml) {
  const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(toml, "shape"));
  return RigidShape::of(Recognition(scene, epsilon<Mpfr>()));
}

TEST(RigidShape, HasTheMomentsOfItsBody) {
  const PrecisionScope scope(40);
  RigidScene scene;
  const auto shape = shape_of(scene.text());
  ASSERT_TRUE(shape);
  EXPECT_FALSE(shape->pivoted);
  const Mpfr tolerance = 100 * epsilon<Mpfr>();
  EXPECT_LE(magnitude(Mpfr(shape->mass - 2)), tolerance);
  // Of second moments 1/2, 1/3, 1/4.
  const char* const moments[] = {"7/12", "3/4", "5/6"};
  for (int i = 0; i < 3; ++i) EXPECT_LE(magnitude(Mpfr(shape->moments[i] - literal<Mpfr>(moments[i]))), tolerance);
  EXPECT_LE(magnitude(Mpfr(shape->middle[1] + literal<Mpfr>("1/3"))), tolerance);
  EXPECT_LE(magnitude(Mpfr(shape->drift[2] + 1)), tolerance);
  // The axis of the least moment, 1/3 + 1/4, is the first director; angular momentum is inertia times omega.
  EXPECT_LE(magnitude(Mpfr(abs(shape->axes(2, 0)) - literal<Mpfr>("7/9"))), tolerance);
  const Vector<Mpfr> side = cross(shape->axes.col(0), shape->axes.col(1));
  EXPECT_LE(max_norm(Vector<Mpfr>(side - shape->axes.col(2))), tolerance);
  const Mpfr along = inner(shape->angular, shape->axes.col(0)) / shape->moments[0];
  Vector<Mpfr> omega(3);
  omega << literal<Mpfr>("1/3"), -2, 1;
  EXPECT_LE(magnitude(Mpfr(along - inner(omega, shape->axes.col(0)))), tolerance);
}

TEST(RigidShape, HasTheStartInItsPlaces) {
  const PrecisionScope scope(40);
  for (const std::string& toml : {RigidScene().text(), cluster(tetrahedron, "1/7"), cluster(triangle, "0", "o")}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(toml, "shape"));
    const auto shape = RigidShape::of(Recognition(scene, epsilon<Mpfr>()));
    ASSERT_TRUE(shape) << toml;
    Vector<Mpfr> omega = Vector<Mpfr>::Zero(3), q = scene.q0, v = scene.q0;
    for (Index i = 0; i < 3; ++i)
      omega += inner(shape->angular, shape->axes.col(i)) / shape->moments[i] * shape->axes.col(i);
    shape->place(Matrix<Mpfr>::Identity(3, 3), omega, shape->middle, shape->drift, q, v);
    EXPECT_LE(distance(q, scene.q0), 100 * epsilon<Mpfr>());
    EXPECT_LE(distance(scene.problem.mass.momentum(v), scene.p0), 1000 * epsilon<Mpfr>());
  }
}

TEST(RigidShape, IsNoneOfWhatBends) {
  const PrecisionScope scope(40);
  std::string open = cluster(tetrahedron, "0");
  EXPECT_TRUE(shape_of(open));
  open.erase(open.rfind("[[constraint]]"));
  EXPECT_FALSE(shape_of(open)) << "a rod is missing";
  EXPECT_FALSE(shape_of(cluster({{"1", "0", "0"}, {"0", "1", "0"}}, "0"))) << "a straight line";
  EXPECT_FALSE(shape_of(cluster(triangle, "0") + plane("b0", "[\"7/12\", \"4/9\", 0]", "\"37/18\"")))
      << "a plane holds it";
}

}  // namespace
}  // namespace hbvm::core
