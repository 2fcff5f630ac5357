#include "audit/claims.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

using Q = Quantity;

struct WorkWitness {
  const char* name;
  bool keeps_balance;  ///< U is linear or quadratic, so that s nodes integrate it along any step
  bool keeps_g;        ///< g is quadratic, and no point moves
  bool keeps_H;        ///< no force does work
  bool for_quick;      ///< is in the shorter list, too
};
constexpr WorkWitness work_witnesses[] = {
    {"charge_on_ellipsoid", true, true, true, true}, {"damped_charge", true, true, false, false},
    {"driven_pendulum", false, false, false, true},  {"damped_double_pendulum", true, true, false, false},
    {"motor_linkage", true, true, false, false},     {"foucault_pendulum", true, true, true, false}};

class WorkClaims {
 public:
  WorkClaims(const WorkWitness& witness, HbvmName name, std::vector<Claim>& claims)
      : witness_(witness), name_(name), method_(hbvm_of(name)), claims_(claims) {}

  void add() {
    const auto [k, s, r] = name_;
    const int raw = s % 2 == 0 ? s : s + 1;
    for (const Quantity quantity : {Q::q, Q::tangential_p, Q::output_lambda}) rate(quantity, 2 * s);
    put(Q::p, Span::interval, Form::at_least, raw);
    put(Q::hidden, Span::interval, Form::at_least, raw);
    kept_or_rate(witness_.keeps_balance, Q::balance, 2 * k);
    kept_or_rate(witness_.keeps_g, Q::g, 2 * r);
    if (witness_.keeps_H) put(Q::H, Span::interval, Form::round_off, 0);
    put(Q::reversal, Span::interval, Form::round_off, 0);
  }

 private:
  void put(Quantity quantity, Span span, Form form, double predicted) {
    claims_.push_back(make_claim("line integral with work", quantity, witness_.name, span, form, predicted));
    claims_.back().method = method_;
  }
  void rate(Quantity quantity, int order) {
    put(quantity, Span::interval, Form::at_least, order);
    put(quantity, Span::step, Form::at_least, order + 1);
  }
  void kept_or_rate(bool kept, Quantity quantity, int order) {
    if (kept)
      put(quantity, Span::interval, Form::round_off, 0);
    else
      rate(quantity, order);
  }

  const WorkWitness& witness_;
  HbvmName name_;
  MethodPtr method_;
  std::vector<Claim>& claims_;
};

}  // namespace

std::vector<Claim> work_claims(Extent extent) {
  std::vector<Claim> all;
  const bool full = extent == Extent::full;
  for (const WorkWitness& witness : work_witnesses) {
    if (!full && !witness.for_quick) continue;
    for (int s = 1; s <= (full ? 6 : 2); ++s) {
      WorkClaims(witness, {s, s, s}, all).add();
      WorkClaims(witness, {s + 1, s, s + 2}, all).add();
    }
  }
  return all;
}

}  // namespace hbvm::core
