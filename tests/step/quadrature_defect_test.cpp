#include "step/quadrature_defect.hpp"

#include "printing.hpp"
#include "scene/assemble.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {
namespace {

std::string body(const char* name, const std::string& mass, const char* position, const char* velocity) {
  return std::string("[[body]]\nname = \"") + name + "\"\nmass = " + mass + "\nposition = " + position +
         "\nvelocity = " + velocity + "\n";
}
std::string orbits(const std::string& bodies) {
  return "dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\n"
         "effect = [{ kind = \"central_gravity\", center = \"O\", strength = 1 }]\n" +
         bodies;
}

template <Scalar S>
S defect_of(const std::string& scene_text, int k, const S& h) {
  const Assembled<S> scene = assemble<S>(read_scene(scene_text, "test"));
  const Hbvm<S> method = make_hbvm<S>(k, 2);
  // Of bodies that do not act on each other every one has its own straight line as a polynomial.
  StageEquations<S> equations(scene.problem, method);
  StageUnknowns<S> x = equations.make_unknowns();
  for (Index j = 0; j < scene.problem.m(); ++j) x.gamma(0, j) = scene.p0[j];
  return QuadratureDefect<S>(scene.problem, k, 2).measure({scene.q0, scene.p0, h}, x);
}

template <class S>
class Defect : public InDigits<50> {};
TYPED_TEST_SUITE(Defect, AllScalars, ScalarNames);

TYPED_TEST(Defect, OfALightBodyIsTheSameBesideAHeavyOne) {
  using S = TypeParam;
  const S h = S(1) / 8;
  const std::string light = body("light", "\"2^-100\"", "[1, 0]", "[0, 1]"),
                    heavy = body("heavy", "1", "[100, 0]", "[0, 0]");
  const S alone = defect_of<S>(orbits(light), 3, h);
  EXPECT_GT(alone, 1);
  EXPECT_EQ(defect_of<S>(orbits(light + heavy), 3, h), alone);
  EXPECT_EQ(defect_of<S>(orbits(heavy + light), 3, h), alone);
}

TYPED_TEST(Defect, FallsToRoundOffWithMoreNodes) {
  using S = TypeParam;
  const S h = S(1) / 8;
  const std::string scene = orbits(body("a", "1", "[1, 0]", "[0, 1]"));
  EXPECT_GT(defect_of<S>(scene, 2, h), 1'000);
  EXPECT_LE(defect_of<S>(scene, 60, h), 1);
}

}  // namespace
}  // namespace hbvm::core
