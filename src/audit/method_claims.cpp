#include <algorithm>

#include "audit/claims.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

struct MethodWitness {
  const char* name;
  bool constrained, turns;  ///< some angular momentum is conserved
};
constexpr MethodWitness method_witnesses[] = {{"double_pendulum", true, false},
                                              {"modified_pendulum", true, false},
                                              {"tethered_satellites", true, true},
                                              {"kepler", false, true},
                                              {"quartic_oscillator", false, true}};

class MethodClaims {
 public:
  MethodClaims(MethodPtr method, std::vector<Claim>& claims)
      : method_(std::move(method)), claims_(claims), kept_(method_->kept()), orders_(method_->orders()) {}

  void add(const MethodWitness& witness) {
    if (method_->digits()) return add_digits(witness);
    const int order = method_->order();
    rate("order", Quantity::q, witness, order);
    rate("order", Quantity::p, witness, !witness.constrained || kept_.hidden ? order : orders_.p);
    if (witness.constrained) {
      rate("order", Quantity::tangential_p, witness, order);
      rate("order", Quantity::output_lambda, witness, order);
      rate("order", Quantity::lagmul, witness, orders_.lambda);
      zero_or_rate(kept_.constraints, Quantity::g, witness, 0);
      zero_or_rate(kept_.hidden, Quantity::hidden, witness, orders_.hidden);
    }
    // A method that keeps H with enough nodes says at which rate it does with those it has.
    zero_or_rate(kept_.energy && orders_.energy == 0, Quantity::H, witness,
                 orders_.energy > 0 ? orders_.energy : order);
    if (witness.turns) zero_or_rate(kept_.momenta, Quantity::angular_momentum, witness, orders_.angular_momentum);
    zero_or_rate(kept_.reversal, Quantity::reversal, witness, 0);
  }

 private:
  /// What is left of the digits of a step after those of an interval, where errors grow and add up.
  void add_digits(const MethodWitness& witness) {
    constexpr int lost = 2;
    const double digits = std::max(0, *method_->digits() - lost);
    for (const Quantity quantity : {Quantity::q, Quantity::p, Quantity::H})
      put("tolerance", quantity, witness, Form::digits, digits);
    if (witness.turns) put("tolerance", Quantity::angular_momentum, witness, Form::digits, digits);
    if (!witness.constrained) return;
    for (const Quantity quantity :
         {Quantity::tangential_p, Quantity::output_lambda, Quantity::lagmul, Quantity::hidden})
      put("tolerance", quantity, witness, Form::digits, digits);
  }
  void put(const std::string& label, Quantity quantity, const MethodWitness& witness, Form form, double predicted) {
    claims_.push_back(make_claim(label, quantity, witness.name, Span::interval, form, predicted));
    claims_.back().method = method_;
  }
  void rate(const std::string& label, Quantity quantity, const MethodWitness& witness, int order) {
    if (order > 0) put(label, quantity, witness, Form::at_least, order);
  }
  void zero_or_rate(bool kept, Quantity quantity, const MethodWitness& witness, int order) {
    if (kept)
      put("kept", quantity, witness, Form::round_off, 0);
    else
      rate("lost", quantity, witness, order);
  }

  MethodPtr method_;
  std::vector<Claim>& claims_;
  Kept kept_;
  Orders orders_;
};

}  // namespace

std::vector<Claim> method_claims(const MethodPtr& method) {
  const HbvmMethod* const hbvm = as_hbvm(*method);
  if (hbvm && hbvm->name().is_auto()) throw InputError("method " + method->text() + ": a claim states its k");
  std::vector<Claim> claims;
  MethodClaims of(method, claims);
  for (const MethodWitness& witness : method_witnesses) of.add(witness);
  return claims;
}

}  // namespace hbvm::core
