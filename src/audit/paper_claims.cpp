#include <algorithm>

#include "audit/claims.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

using Q = Quantity;

/// What is known of a problem.
struct Witness {
  std::string name;
  bool constant_gram;  ///< grad g^T M^-1 grad g is constant: leading terms are known not to vanish
  bool polynomial;     ///< U is linear: HBVM(s, s) conserves H
  bool momentum;       ///< some angular momentum is conserved
};
const Witness witnesses[] = {{"modified_pendulum", true, false, false},
                             {"tethered_satellites", true, false, true},
                             {"double_pendulum", false, true, false},
                             {"bead_on_ellipsoid", false, false, false},
                             {"heavy_top", false, true, true}};

/// The order r of Theorem 5.
int order(int s) { return s % 2 == 0 ? s : s + 1; }

class List {
 public:
  List(std::string problem, int k, int s) : problem_(std::move(problem)), method_(hbvm_of({k, s})) {}

  void rate(const std::string& label, Quantity quantity, Span span, double rate, Form form = Form::at_least) {
    add(label, quantity, span, form, rate);
  }
  void zero(const std::string& label, Quantity quantity) { add(label, quantity, Span::interval, Form::round_off, 0); }
  void value(const std::string& label, Quantity quantity, double value, double tolerance, Form form = Form::near) {
    add(label, quantity, Span::interval, form, value);
    claims_.back().tolerance = tolerance;
  }
  void of_degenerate_motion() {
    for (Claim& claim : claims_) claim.of_degenerate_motion = true;
  }
  void in_digits(unsigned digits) {
    for (Claim& claim : claims_) claim.least_digits = digits;
  }
  void append_to(std::vector<Claim>& all) const { all.insert(all.end(), claims_.begin(), claims_.end()); }

 private:
  void add(const std::string& label, Quantity quantity, Span span, Form form, double predicted) {
    claims_.push_back(make_claim(label, quantity, problem_, span, form, predicted));
    claims_.back().method = method_;
  }

  std::string problem_;
  MethodPtr method_;
  std::vector<Claim> claims_;
};

/// The orders of all components, hidden constraints (15) among them. For k > s the statements are Theorem 9, Theorem 10
/// and Corollary 3.
void orders(List& list, const Witness& witness, int k, int s) {
  const std::string further = k > s ? "k" : "";
  const int r = order(s);
  const Form form = witness.constant_gram ? Form::exactly : Form::at_least;
  list.rate("ord2s" + further, Q::p, Span::interval, r, form);
  // One step of odd s does not show the order: the paper's O(h^(r+1)) is O(h^(s+1)).
  list.rate("ord2s" + further + ", one step", Q::p, Span::step, s + 1, form);
  for (const Quantity quantity : {Q::q, Q::tangential_p, Q::output_lambda}) {
    list.rate("superconvergence", quantity, Span::interval, 2 * s);
    list.rate("superconvergence", quantity, Span::step, 2 * s + 1);
  }
  list.rate("hidcons", Q::hidden, Span::interval, r, form);
  list.rate("hidcons", Q::hidden, Span::step, s + 1, form);
  list.rate("ordlam" + further, Q::lagmul, Span::interval, r - 1);
  list.rate("dlamj", Q::delta_lambda, Span::step, s);
  // Later steps start from an O(h^r) hidden constraint.
  list.rate("dlamj, propagated", Q::delta_lambda, Span::interval, r - 1);
  list.rate("norm" + further, Q::polynomials, Span::step, s + 1);
}

void constrained(std::vector<Claim>& all, const Witness& witness, int s, int most_k) {
  for (int k = s; k <= most_k; ++k) {
    List list(witness.name, k, s);
    const bool every_component = k == s || k == s + 2 || (k == s + 1 && most_k == s + 1);
    if (every_component) {
      orders(list, witness, k, s);
      list.zero("gheq0", Q::g);
      list.zero("simme", Q::reversal);
    }
    if (witness.polynomial) {
      if (every_component) list.zero("evai", Q::H);
    } else {
      list.rate("evaik", Q::H, Span::step, 2 * k + 1);
      list.rate("evaik", Q::H, Span::interval, 2 * k);
    }
    if (witness.momentum && k == s) list.zero("angular momentum, k = s", Q::angular_momentum);
    if (witness.momentum && k == s + 1 && !witness.polynomial)
      list.rate("angular momentum, k > s", Q::angular_momentum, Span::interval, 2 * s);
    if (k == s + 4) list.value("costo", Q::sweeps, 0, 1);
    if (k == s && witness.constant_gram) list.value("hidden constant", Q::hidden_constant, 1, 1 / double{100});
    list.append_to(all);
  }
}

/// delta-lambda = 0, (42), as on any relative equilibrium: all converges with order 2s, against the closed form.
void conical(std::vector<Claim>& all, int k, int s) {
  List list("conical_pendulum", k, s);
  for (const Quantity quantity : {Q::q, Q::p}) list.rate("ord2s, dli0", quantity, Span::interval, 2 * s);
  for (const Quantity quantity : {Q::q, Q::p}) list.rate("ord2s, dli0", quantity, Span::step, 2 * s + 1);
  list.zero("gheq0", Q::g);
  list.zero("evai", Q::H);
  list.of_degenerate_motion();
  list.append_to(all);
}

/// The closed form of the simple pendulum as the reference.
void simple(std::vector<Claim>& all, int s) {
  List list("simple_pendulum", s, s);
  list.rate("ord2s", Q::p, Span::interval, order(s));
  for (const Quantity quantity : {Q::q, Q::tangential_p, Q::output_lambda})
    list.rate("superconvergence", quantity, Span::interval, 2 * s);
  list.zero("evai", Q::H);
  list.append_to(all);
}

/// Without constraints the method is HBVM(k, s) of order 2s.
void unconstrained(std::vector<Claim>& all, int s) {
  for (const char* const problem : {"kepler", "quartic_oscillator"})
    for (int k = s; k <= s + 1; ++k) {
      List list(problem, k, s);
      for (const Quantity quantity : {Q::q, Q::p}) {
        list.rate("no constraints", quantity, Span::interval, 2 * s);
        list.rate("no constraints", quantity, Span::step, 2 * s + 1);
      }
      if (k < 2 * s) list.rate("evaik", Q::H, Span::interval, 2 * k);
      list.zero("simme", Q::reversal);
      if (k == s) list.zero("angular momentum, k = s", Q::angular_momentum);
      list.append_to(all);
    }
}

/// U of degree 4: exact from 4 <= 2k/s on.
void quartic(std::vector<Claim>& all, int s) {
  for (const char* const problem : {"quartic_oscillator", "quartic_pendulum"}) {
    List exact(problem, 2 * s, s);
    exact.zero("evaik, polynomial", Q::H);
    exact.append_to(all);
    if (s == 1) continue;
    List inexact(problem, 2 * s - 1, s);
    inexact.rate("evaik", Q::H, Span::step, 4 * s - 1);
    inexact.append_to(all);
  }
}

void coefficients(std::vector<Claim>& all, int k, int s) {
  List list("tableau", k, s);
  for (const Quantity quantity : {Q::B, Q::C, Q::D, Q::X, Q::symmetry, Q::W}) list.zero("coefficients", quantity);
  list.append_to(all);
}

/// The hidden constraint of the heavy top drifts for even s.
void drift(std::vector<Claim>& all, int s) {
  List list("heavy_top", s, s);
  if (s % 2 == 0)
    list.value("hidden drift, even s", Q::hidden_drift, 4, 0, Form::at_least);
  else
    list.value("no hidden drift, odd s", Q::hidden_drift, 1, 1);
  list.append_to(all);
}

}  // namespace

std::vector<Claim> paper_claims(Extent extent) {
  std::vector<Claim> all;
  const bool full = extent == Extent::full;
  for (int s = 1; s <= (full ? 8 : 3); ++s) {
    for (const Witness& witness : witnesses) {
      const bool large = witness.name == "tethered_satellites" || witness.name == "heavy_top";
      if (!full && large && s > 1) continue;
      // Where U is linear the further nodes change nothing.
      constrained(all, witness, s, full && !witness.polynomial ? s + 4 : s + 1);
    }
    conical(all, s, s);
    simple(all, s);
    unconstrained(all, s);
    quartic(all, s);
    for (int k = s; k <= s + (full ? 4 : 1); ++k) coefficients(all, k, s);
    if (s >= 2 && s <= (full ? 4 : 3)) drift(all, s);
  }
  if (full)
    for (const int s : {12, 20}) {
      for (const Witness& witness : {witnesses[0], witnesses[2]}) {
        List list(witness.name, s, s);
        orders(list, witness, s, s);
        list.in_digits(200);
        list.append_to(all);
      }
      coefficients(all, s, s);
    }
  return all;
}

}  // namespace hbvm::core
