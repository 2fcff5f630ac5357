#include "audit/claims.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

using Q = Quantity;

struct GeneralWitness {
  const char* name;
  int degree;      ///< of g, 0 if it is no polynomial
  bool keeps_H;    ///< U is linear, or there is none
  bool turns;      ///< some angular momentum is conserved
  bool for_quick;  ///< is in the shorter list, too
};
constexpr GeneralWitness general_witnesses[] = {{"bead_on_quartic", 4, false, false, true},
                                                {"bead_on_torus", 0, true, true, true},
                                                {"bead_on_helix", 0, true, false, true},
                                                {"rope_over_two_pegs", 0, true, false, false},
                                                {"rod_on_two_curves", 0, true, false, false}};

class GeneralClaims {
 public:
  GeneralClaims(const GeneralWitness& witness, HbvmName name, std::vector<Claim>& claims, unsigned least_digits = 0)
      : witness_(witness), name_(name), method_(hbvm_of(name)), claims_(claims), least_digits_(least_digits) {}

  void orders() {
    const int s = name_.s, raw = s % 2 == 0 ? s : s + 1;
    for (const Quantity quantity : {Q::q, Q::tangential_p, Q::output_lambda}) {
      put("any constraint", quantity, Span::interval, Form::at_least, 2 * s);
      put("any constraint", quantity, Span::step, Form::at_least, 2 * s + 1);
    }
    put("any constraint", Q::p, Span::interval, Form::at_least, raw);
    put("any constraint", Q::hidden, Span::interval, Form::at_least, raw);
    put("any constraint", Q::reversal, Span::interval, Form::round_off, 0);
  }

  /// H, g and the angular momentum.
  void invariants() {
    const auto [k, s, r] = name_;
    if (witness_.keeps_H) {
      put("line integral, H", Q::H, Span::interval, Form::round_off, 0);
    } else {
      put("line integral, H", Q::H, Span::interval, Form::at_least, 2 * k);
      put("line integral, H", Q::H, Span::step, Form::at_least, 2 * k + 1);
    }
    if (witness_.degree > 0 && 2 * r >= witness_.degree * s) {
      put("line integral, g", Q::g, Span::interval, Form::round_off, 0);
    } else {
      put("line integral, g", Q::g, Span::interval, Form::at_least, 2 * r);
      put("line integral, g", Q::g, Span::step, Form::at_least, 2 * r + 1);
    }
    if (!witness_.turns) return;
    if (k == s && r == s)
      put("angular momentum, k = r = s", Q::angular_momentum, Span::interval, Form::round_off, 0);
    else
      put("angular momentum, r > s", Q::angular_momentum, Span::interval, Form::at_least, 2 * s);
  }

 private:
  void put(const std::string& label, Quantity quantity, Span span, Form form, double predicted) {
    claims_.push_back(make_claim(label, quantity, witness_.name, span, form, predicted));
    claims_.back().method = method_;
    claims_.back().least_digits = least_digits_;
  }

  const GeneralWitness& witness_;
  HbvmName name_;
  MethodPtr method_;
  std::vector<Claim>& claims_;
  unsigned least_digits_;
};

}  // namespace

std::vector<Claim> general_claims(Extent extent) {
  std::vector<Claim> all;
  const bool full = extent == Extent::full;
  for (const GeneralWitness& witness : general_witnesses) {
    if (!full && !witness.for_quick) continue;
    for (int s = 1; s <= (full ? 6 : 2); ++s) {
      // As many nodes as stages, for both; one and two more; as many as a polynomial g takes.
      std::vector<HbvmName> names{{s, s, s}, {s + 1, s, s + 2}};
      if (full) names.push_back({s, s, s + 1});
      if (witness.degree > 0 && (!full || s > 1)) names.push_back({s, s, witness.degree * s / 2});
      for (std::size_t n = 0; n < names.size(); ++n) {
        GeneralClaims claims(witness, names[n], all);
        if (n < 2) claims.orders();
        claims.invariants();
      }
    }
    if (!full || !witness.for_quick) continue;
    GeneralClaims claims(witness, {9, 8, 10}, all, 200);
    claims.orders();
    claims.invariants();
  }
  return all;
}

}  // namespace hbvm::core
