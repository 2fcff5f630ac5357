#include "hard_cases/family.hpp"
#include "hard_cases/scenes.hpp"
#include "study/conservation.hpp"

namespace hbvm::core {
namespace {

using Kind = ConservedQuantity::Kind;

/// Whether every momentum that is said to be conserved is, and none of those that are was left out.
CaseResult claims_hold(const std::string& strength, const std::string& precision) {
  const Scene scene = weak_gravity(strength);
  const Conservation found = conservation({&scene, 2, Nodes::s, Expression::parse("1/8"), Expression::parse("100")},
                                          Precision::parse(precision));
  CaseResult result;
  Criterion worst{"drift of what is said to be conserved, units of round-off", 0, found.round_off()};
  double momenta = 0;
  for (const ConservedQuantity& quantity : found.quantities) {
    if (quantity.kind != Kind::linear_momentum && quantity.kind != Kind::angular_momentum) continue;
    ++momenta;
    raise_to(worst.value, quantity.ulps);
    result.message += (result.message.empty() ? "said to be conserved: " : ", ") + quantity.name;
  }
  const double conserved = strength == "0" ? 3 : 1;  // P_x; without the weak force P_y and L_z, too
  result.criteria = {worst, {"conserved momenta that are missing", conserved - momenta, 0}};
  return result;
}

}  // namespace

void add_momenta(const Family& family) {
  for (const std::string g : {"0", "1e-6", "1e-9", "1e-11", "1e-13", "1e-16", "1e-30"})
    family.add("spring and a weak gravity", "strength " + g, all_precisions, holds(),
               [g](const std::string& precision) { return guarded([&] { return claims_hold(g, precision); }); });
}

}  // namespace hbvm::core
