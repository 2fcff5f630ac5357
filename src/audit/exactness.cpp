#include "exactness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "run/choose_k.hpp"
#include "scene/assemble.hpp"
#include "step/hbvm_method.hpp"
#include "step/tableau_method.hpp"
#include "weak_terms.hpp"

namespace hbvm::core {
namespace {

std::string proof_for_tableau(const Claim& claim, const CoefficientCheck& check, const std::optional<int>& degree) {
  const bool symplectic = check.symplecticity().holds();
  const std::string decimals =
      check.decimals() ? ", to the " + std::to_string(check.decimals()->digits) + " digits of its decimals" : "";
  switch (claim.quantity) {
    case Quantity::H:
      if (degree && *degree <= 1 && check.order(2).holds()) return "U is linear" + decimals;
      return degree && *degree <= 2 && symplectic ? "H is quadratic and the method symplectic" + decimals : "";
    case Quantity::angular_momentum:
      return symplectic ? "the method is symplectic" + decimals : "";
    case Quantity::reversal:
      return check.symmetry().holds() ? "the method is symmetric" + decimals : "";
    default:
      return {};
  }
}

/// What the method promises of every motion.
std::string proof_by_construction(const Claim& claim) {
  const Kept kept = claim.method->kept();
  switch (claim.quantity) {
    case Quantity::g:
      return kept.constraints ? "each step ends on the constraints" : "";
    case Quantity::hidden:
      return kept.hidden ? "each step ends in their tangent space" : "";
    case Quantity::reversal:
      return kept.reversal ? "the method is symmetric" : "";
    case Quantity::angular_momentum:
      return kept.momenta ? "the forces of each step keep it" : "";
    case Quantity::H:
      return kept.energy ? "the forces, or a scaling, of each step keep it" : "";
    default:
      return {};
  }
}

/// Up to this degree in the positions a method makes no error of what is claimed.
int exact_degree(const Claim& claim, int r) {
  const HbvmMethod* const hbvm = as_hbvm(*claim.method);
  if (!hbvm) return claim.quantity == Quantity::H && as_tableau(*claim.method) ? 1 : 0;
  const auto [k, s, ignored] = hbvm->name();
  switch (claim.quantity) {
    case Quantity::H:
    case Quantity::balance:
      return 2 * k / s;
    case Quantity::g:
      return 2 * r / s;
    default:
      return 2;
  }
}

WeakTerms::Bits weak_bits(const Claim& claim, int log2_scale, unsigned digits) {
  const PrecisionScope scope(digits);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(claim.problem));
  const HbvmMethod* const hbvm = as_hbvm(*claim.method);
  const WeakTerms terms(scene, log2_scale, exact_degree(claim, hbvm ? hbvm->constraint_nodes(scene.problem) : 0));
  const auto [U, U_all] = terms.of_U();
  const auto [g, g_all] = terms.of_g();
  switch (claim.quantity) {
    case Quantity::g:
      return {g, g_all};
    case Quantity::angular_momentum:
      return {std::max(U, g), std::max(U_all, g_all)};
    default:
      return {U, U_all};
  }
}

double bits_of_the_weakest(const Claim& claim, int log2_scale) {
  const WeakTerms::Bits here = weak_bits(claim, log2_scale, digits_of_terms);
  if (here.all == here.told) return here.told;
  // With more digits rounding becomes less, a term stays what it is.
  constexpr unsigned more = 100;
  constexpr double same = 50;
  const WeakTerms::Bits there = weak_bits(claim, log2_scale, digits_of_terms + more);
  return std::abs(there.all - here.all) < same ? here.all : here.told;
}

}  // namespace

std::string proof_of(const Claim& claim, const CoefficientCheck* check) {
  std::optional<int> degree;
  bool constrained = false, works = false;
  int of_g = 0, r = 0;  // degree, and nodes
  const HbvmMethod* const hbvm = as_hbvm(*claim.method);
  {
    // What a run in fewer digits can tell from 0 is not folded away here.
    const PrecisionScope scope(digits_of_terms);
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(claim.problem));
    degree = degree_of_U(scene.problem);
    constrained = scene.problem.nu() > 0;
    works = !scene.problem.driven.empty();
    of_g = degree_of_g(scene.problem);
    if (hbvm) r = hbvm->constraint_nodes(scene.problem);
  }
  if (check && as_tableau(*claim.method) && !constrained) return proof_for_tableau(claim, *check, degree);
  if (!hbvm) return proof_by_construction(claim);
  if (!check) return {};
  const int k = hbvm->name().k, s = hbvm->name().s;
  switch (claim.quantity) {
    case Quantity::g:
      if (of_g == 2 && r == s) return "g is quadratic";
      return of_g >= 2 && of_g * s <= 2 * r
                 ? "the nodes integrate the derivative of g, of degree " + std::to_string(of_g) + ", exactly"
                 : "";
    case Quantity::reversal:
      return "the method is symmetric";
    case Quantity::H:
      if (works) return {};
      [[fallthrough]];
    case Quantity::balance:
      return degree && *degree * s <= 2 * k ? "the nodes integrate U of degree " + std::to_string(*degree) + " exactly"
                                            : "";
    case Quantity::angular_momentum:
      if (r > s) return {};
      if (k == s) return "k = s";
      return degree && *degree <= 2 ? "further nodes change nothing for U of degree " + std::to_string(*degree) : "";
    default:
      return {};
  }
}

int digits_to_show(const Claim& claim, int log2_scale) {
  constexpr double margin = 64;
  const HbvmMethod* const hbvm = as_hbvm(*claim.method);
  const bool energy = (claim.quantity == Quantity::H || claim.quantity == Quantity::balance) && hbvm,
             of_g = claim.quantity == Quantity::g && hbvm;
  const double order = energy ? 2 * hbvm->name().k + 1
                       : of_g ? 2 * std::max(hbvm->name().s, hbvm->name().r) + 1
                              : 2 * claim.method->stages() + 2;
  const double bits = order * (3 + std::log2(order)) + margin + bits_of_the_weakest(claim, log2_scale);
  return static_cast<int>(std::ceil(bits * std::numbers::ln2 / std::numbers::ln10));
}

}  // namespace hbvm::core
