// Runs of scenes with formulas, by every kind of method.

#include "cli/json.hpp"
#include "scene/formula_scene.hpp"

namespace hbvm::core {
namespace {

/// The end of a run, digit for digit.
std::string end_of(const std::string& scene, const std::string& method, const std::string& precision) {
  const auto json = json_of(run_of(scene, method, "1/32", "1/2") + Arguments{"--precision", precision});
  return json["q"].dump() + json["p"].dump() + json["lambda"].dump() + json["e_H"].dump();
}

TEST(Formulas, GiveTheDigitsOfWhatIsBuiltInByEveryMethod) {
  const Folder folder;
  const std::string formulas = folder.write("formulas.toml", pendulum_by_formulas),
                    built_in = folder.write("built_in.toml", pendulum_as_built_in);
  for (const char* const method : {"hbvm:4,2", "hbvm:auto,3", "rattle", "lobatto:3", "energy_momentum",
                                   "projected_hbvm:2,2", "restored_hbvm:3,2", "rkf78", "taylor"})
    EXPECT_EQ(end_of(formulas, method, "mpfr:50"), end_of(built_in, method, "mpfr:50")) << method;
  EXPECT_EQ(end_of(formulas, "hbvm:4,2", "mpfr:200"), end_of(built_in, "hbvm:4,2", "mpfr:200"));
  EXPECT_EQ(end_of(formulas, "hbvm:4,2", "quad"), end_of(built_in, "hbvm:4,2", "quad"));
}

/// U has no value where x < 0, which the star reaches: a typed error, and no number is made up.
TEST(Formulas, EndWithATypedErrorWhereTheyHaveNoValue) {
  const Folder folder;
  const std::string scene =
      folder.write("fall.toml",
                   "dimension = 2\nbody = [{ name = \"a\", mass = 1, position = [1, 0], velocity = "
                   "[-1, 0] }]\n[[effect]]\nkind = \"formula\"\nU = \"-x*sqrt(x)\"\n");
  for (const char* const precision : {"double", "quad", "mpfr:40"})
    for (const char* const method : {"hbvm:3,2", "rattle", "energy_momentum", "rkf78"}) {
      const Outcome run = ended_with(3, run_of(scene, method, "1/16", "5") + Arguments{"--precision", precision});
      EXPECT_EQ(run.out.find("nan"), std::string::npos) << method;
    }
}

}  // namespace
}  // namespace hbvm::core
