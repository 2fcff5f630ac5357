#include "scene/own_precision.hpp"

#include <algorithm>

#include "scalar/expression_node.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

/// Of a decimal, without zeros before it and its exponent; 0 of anything else.
int significant_digits(const Expression& e) {
  const Expression::Node* node = e.root().get();
  if (node->kind == Expression::Node::Kind::negate) node = node->left.get();
  if (node->kind != Expression::Node::Kind::decimal) return 0;
  int digits = 0;
  for (const char c : node->text) {
    if (c == 'e' || c == 'E') break;
    if (c >= '0' && c <= '9' && (digits > 0 || c != '0')) ++digits;
  }
  return digits;
}

}  // namespace

int own_digits(const Scene& scene) {
  int most = 0;
  const auto look_at = [&](const auto&... vectors) {
    for (const SceneVector* const v : {&vectors...})
      for (const Expression& e : *v) most = std::max(most, significant_digits(e));
  };
  for (const SceneBody& body : scene.bodies) look_at(body.position, body.velocity, body.momentum);
  for (const SceneRigidBody& body : scene.rigid_bodies) {
    look_at(body.position, body.velocity, body.angular_velocity);
    for (const SceneVector& director : body.directors) look_at(director);
  }
  constexpr int of_a_double = 15;
  return most >= of_a_double ? most : 0;
}

template <Scalar S>
S own_precision(const Scene& scene) {
  const int digits = own_digits(scene);
  if (digits == 0) return epsilon<S>();
  return std::max(epsilon<S>(), literal<S>("10^" + std::to_string(1 - digits)));
}

#define HBVM_DEFINE(S) template S own_precision<S>(const Scene&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
