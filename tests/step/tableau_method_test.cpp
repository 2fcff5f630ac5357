#include "step/tableau_method.hpp"

#include <set>

#include "method/tableaux.hpp"
#include "scene/assemble.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {
namespace {

const Tableau midpoint_rule = tableau({{"1/2"}}, {"1"}, {"1/2"});

TEST(TableauMethods, OrderIsTheStatedOneOrThatOfTheConditions) {
  EXPECT_EQ(TableauMethod(midpoint_rule, "").order(), 2);
  EXPECT_EQ(TableauMethod(hbvm::core::rk4(), "").order(), 4);
  EXPECT_EQ(TableauMethod(hbvm::core::radau_iia(), "").order(), 3);
  EXPECT_EQ(TableauMethod(hbvm::core::dopri5(), "").order(), 5);
  Tableau stated = hbvm::core::rk4();
  stated.order = 7;
  EXPECT_EQ(TableauMethod(stated, "").order(), 7);
  EXPECT_EQ(TableauMethod(hbvm::core::rk4(), "", OnConstraints::project).order(), 4);
  EXPECT_EQ(TableauMethod(hbvm::core::rk4(), "", OnConstraints::ggl).order(), 2);
  // 50 digits, less ten.
  EXPECT_EQ(TableauMethod(tableau({{"1/2+1e-35"}}, {"1"}, {"1/2+1e-35"}), "").order(), 1);
  EXPECT_EQ(TableauMethod(tableau({{"1/2+1e-45"}}, {"1"}, {"1/2+1e-45"}), "").order(), 2);
}

TEST(TableauMethods, KeepWhatTheirCoefficientsKeep) {
  const auto expect = [](const Tableau& t, bool momenta, bool reversal) {
    const Kept kept = TableauMethod(t, "").kept(), projected = TableauMethod(t, "", OnConstraints::project).kept();
    EXPECT_EQ(kept.momenta, momenta);
    EXPECT_EQ(kept.reversal, reversal);
    EXPECT_FALSE(kept.energy || kept.constraints || kept.hidden);
    EXPECT_TRUE(projected.constraints && projected.hidden);
    EXPECT_FALSE(projected.energy || projected.momenta || projected.reversal);
  };
  expect(midpoint_rule, true, true);
  expect(tableau({{"0", "0"}, {"1/2", "1/2"}}, {"1/2", "1/2"}, {"0", "1"}), false, true);        // trapezoidal rule
  expect(tableau({{"1/8", "0"}, {"1/4", "3/8"}}, {"1/4", "3/4"}, {"1/8", "5/8"}), true, false);  // two midpoint steps
  expect(hbvm::core::rk4(), false, false);
}

TEST(TableauMethods, NameTheirFileAndTheirTableau) {
  const TableauMethod plain(hbvm::core::rk4(), "tableau:some/file.toml"),
      projected(hbvm::core::rk4(), "tableau:some/file.toml", OnConstraints::project);
  EXPECT_EQ(plain.text(), "tableau:some/file.toml");
  EXPECT_EQ(projected.text(), "tableau:some/file.toml+project");
  EXPECT_EQ(plain.title(), "test");
  EXPECT_EQ(projected.title(), "test, projected");
  EXPECT_EQ(plain.stages(), 4);
  EXPECT_EQ(plain.terms(), 4);
  EXPECT_EQ(plain.parameters().at("s").text(), "4");
  EXPECT_EQ(as_tableau(plain)->tableau().b.size(), 4u);
}

TEST(TableauMethods, KeysAreTheirNumbers) {
  const auto key = [](const Tableau& t) { return TableauMethod(t, "a").key(); };
  EXPECT_EQ(key(hbvm::core::rk4()), TableauMethod(hbvm::core::rk4(), "another file").key());
  const std::set<std::string> keys{key(midpoint_rule), key(tableau({{"1/3"}}, {"1"}, {"1/2"})),
                                   key(tableau({{"1/2"}}, {"2"}, {"1/2"})), key(tableau({{"1/2"}}, {"1"}, {"1/3"})),
                                   TableauMethod(midpoint_rule, "a", OnConstraints::project).key()};
  EXPECT_EQ(keys.size(), 5u);
}

TEST(TableauMethods, NeedAFile) {
  EXPECT_THROW(tableau_method("+project"), InputError);
  EXPECT_THROW(tableau_method(""), InputError);
}

TEST(TableauMethods, AreKnownByName) {
  EXPECT_EQ(known_tableau_method("rk4")->text(), "rk4");
  EXPECT_EQ(known_tableau_method("rk4")->title(), "RK4");
  EXPECT_EQ(known_tableau_method("sdirk:3+project")->text(), "sdirk:3+project");
  EXPECT_EQ(known_tableau_method("sdirk:3+project")->order(), 3);
  EXPECT_THROW(known_tableau_method("sdirk:4"), InputError);
}

/// A step of the midpoint rule by hand on a harmonic trap: v = (p0 - h/2 q0)/(1 + h^2/4).
TEST(TableauMethods, MakeTheStepsOfTheirNumbers) {
  const Assembled<Quad> scene = assemble<Quad>(read_scene(
      "dimension = 2\npoint = [{ name = \"o\", position = [0, 0] }]\nbody = [{ name = \"a\", mass = 1, "
      "position = [3, 4], velocity = [1, -2] }]\neffect = [{ kind = \"trap\", center = \"o\", stiffness = 1, "
      "exponent = 2 }]\n",
      "trap"));
  const Quad h = Quad(1) / 8;
  const auto stepper = TableauMethod(midpoint_rule, "").make_stepper(scene.problem, SolverKind::automatic);
  State<Quad> state(scene.q0, scene.p0);
  stepper->step(state, h);
  const Vector<Quad> v = (scene.p0 - scene.q0 * (h / 2)) / Quad(1 + h * h / 4), u = scene.q0 + v * (h / 2);
  EXPECT_LE(max_norm(Vector<Quad>(state.q - scene.q0 - h * v)), 32 * epsilon<Quad>());
  EXPECT_LE(max_norm(Vector<Quad>(state.p - scene.p0 + h * u)), 32 * epsilon<Quad>());
}

}  // namespace
}  // namespace hbvm::core
