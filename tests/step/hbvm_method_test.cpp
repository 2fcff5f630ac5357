#include "step/hbvm_method.hpp"

#include <set>

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

using Part = Perturbation::Part;

TEST(HbvmMethods, SayWhatTheyAre) {
  const HbvmMethod method({7, 3}), gauss({3, 3});
  EXPECT_EQ(method.text(), "hbvm:7,3");
  EXPECT_EQ(method.title(), "HBVM(7,3)");
  EXPECT_EQ(method.key(), "hbvm:7,3");
  EXPECT_EQ(method.order(), 6);
  EXPECT_EQ(method.stages(), 3);
  EXPECT_EQ(method.terms(), 10);
  EXPECT_EQ(method.parameters().at("k").text(), "7");
  EXPECT_EQ(method.parameters().at("s").text(), "3");
  for (const Kept& kept : {method.kept(), gauss.kept()}) {
    EXPECT_TRUE(kept.energy && kept.constraints && kept.reversal);
    EXPECT_FALSE(kept.hidden);
  }
  EXPECT_FALSE(method.kept().momenta);
  EXPECT_TRUE(gauss.kept().momenta);
}

TEST(HbvmMethods, HaveAsManyNodesForConstraintsAsTheseTake) {
  const auto nodes = [](const char* scene, const HbvmName& name) {
    return HbvmMethod(name).constraint_nodes(assemble<double>(load_scene(scene)).problem);
  };
  EXPECT_EQ(nodes("double_pendulum", {7, 3}), 3);
  EXPECT_EQ(nodes("kepler", {7, 3}), 3);
  EXPECT_EQ(nodes("bead_on_quartic", {3, 3}), 6) << "of degree 4";
  EXPECT_EQ(nodes("bead_on_quartic", {9, 1}), 2);
  EXPECT_EQ(nodes("bead_on_torus", {7, 3}), 7) << "no polynomial: as many as for the potential";
  EXPECT_EQ(nodes("bead_on_torus", {3, 3, 4}), 4);
  EXPECT_EQ(nodes("double_pendulum", {3, 3, 4}), 4);
  const HbvmMethod named({3, 3, 5});
  EXPECT_EQ(named.text(), "hbvm:3,3,5");
  EXPECT_EQ(named.title(), "HBVM(3,3,5)");
  EXPECT_EQ(named.parameters().at("r").text(), "5");
  EXPECT_EQ(named.coefficients<double>().r, 5);
  EXPECT_FALSE(named.kept().momenta) << "r > s";
  EXPECT_TRUE(HbvmMethod({3, 3, 3}).kept().momenta);
}

TEST(HbvmMethods, OfAnOpenKHaveNoCoefficients) {
  const MethodPtr open = hbvm_method("auto,2");
  EXPECT_EQ(open->title(), "HBVM(auto,2)");
  EXPECT_EQ(open->text(), "hbvm:auto,2");
  EXPECT_FALSE(open->parameters().contains("k"));
  EXPECT_EQ(open->parameters().at("s").text(), "2");
  EXPECT_THROW(as_hbvm(*open)->coefficients<double>(), InputError);
}

TEST(HbvmMethods, AreRefusedWithFewerNodesThanStages) {
  EXPECT_THROW(hbvm_of({2, 3}), InputError);
  EXPECT_THROW(hbvm_of({0, 0}), InputError);
  EXPECT_THROW(hbvm_method("2,3"), InputError);
  EXPECT_THROW(hbvm_method("2"), InputError);
  EXPECT_EQ(as_hbvm(*hbvm_method("5,4"))->name().k, 5);
}

/// One number differs, by the factor 1 + relative, and no other.
TEST(HbvmMethods, MayHaveOneWrongNumber) {
  const Perturbation wrong{Part::weight, true, 1, 0, Expression::parse("1/8")};
  const HbvmMethod right({4, 2}), off({4, 2}, wrong);
  const Hbvm<Quad> expected = right.coefficients<Quad>(), found = off.coefficients<Quad>();
  EXPECT_EQ(expected.X_s, make_hbvm<Quad>(4, 2).X_s);
  Hbvm<Quad> other = expected;
  perturb(other, wrong);
  EXPECT_EQ(found.b, other.b);
  EXPECT_EQ(found.X_s, other.X_s);
  EXPECT_NE(off.key(), right.key());
  EXPECT_EQ(off.text(), right.text());
  EXPECT_THROW(hbvm_of({4, 2}, Perturbation{Part::weight, true, 4, 0, Expression::parse("1/8")}), InputError);
}

TEST(HbvmMethods, KeysTellPerturbationsApart) {
  std::set<std::string> keys{HbvmMethod({4, 3}).key()};
  std::size_t count = 1;
  for (const Part part : {Part::node, Part::weight, Part::integral, Part::legendre})
    for (const bool hat : {false, true})
      for (const int i : {0, 1})
        for (const char* const relative : {"1", "1e-3"}) {
          keys.insert(HbvmMethod({4, 3}, Perturbation{part, hat, i, 0, Expression::parse(relative)}).key());
          ++count;
        }
  for (const int i : {0, 1}) {
    keys.insert(HbvmMethod({4, 3}, Perturbation{Part::integral, true, i, 1, Expression::parse("1")}).key());
    ++count;
  }
  EXPECT_EQ(keys.size(), count);
}

}  // namespace
}  // namespace hbvm::core
