#include "scene/effect_reach.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

namespace hbvm::core {

std::vector<std::pair<std::string, std::string>> left_out(const Scene& scene, const SceneEffect& effect,
                                                          const EffectReach& reach) {
  std::map<std::string, std::string> carriers;
  for (const SceneAttachment& attachment : scene.attachments) carriers.emplace(attachment.name, attachment.of);
  std::set<std::string> reached;
  for (const auto& names : reach.on)
    for (const std::string& name : names) {
      const auto carrier = carriers.find(name);
      reached.insert(carrier == carriers.end() ? name : carrier->second);
    }
  const bool chosen = effect.on || effect.between || (effect.formula && !effect.formula->of.empty());
  std::vector<std::pair<std::string, std::string>> result;
  const auto check = [&](const std::string& name, bool fixed, bool charged) {
    if (reached.contains(name)) return;
    const char* reason = "there is none to pair it with";
    if (chosen)
      reason = "not named";
    else if (effect.kind == "coulomb" && !charged)
      reason = "no charge";
    else if (fixed)
      reason = "its centre of mass is fixed in space";
    result.emplace_back(name, reason);
  };
  for (const SceneBody& body : scene.bodies) check(body.name, false, body.charge.has_value());
  for (const SceneRigidBody& body : scene.rigid_bodies) {
    bool charged = false;
    for (const SceneAttachment& attachment : scene.attachments)
      charged = charged || (attachment.of == body.name && attachment.charge);
    check(body.name, body.fixed, charged);
  }
  return result;
}

std::string to_text(const EffectReach& reach) {
  constexpr std::size_t most = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, reach.on.size()); ++i)
    text += (i > 0 ? ", '" : "'") + fmt::format("{}", fmt::join(reach.on[i], "'-'")) + "'";
  if (reach.on.size() > most) text += fmt::format(", and {} more", reach.on.size() - most);
  return text;
}

}  // namespace hbvm::core
