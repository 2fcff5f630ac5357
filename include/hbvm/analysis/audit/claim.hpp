#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hbvm/analysis/audit/convergence.hpp"
#include "hbvm/scene/scene.hpp"
#include "hbvm/step/method.hpp"

namespace hbvm {

/// What a claim is about. Errors are max-norms.
enum class Quantity {
  q,                 ///< position
  p,                 ///< momentum as it is propagated
  tangential_p,      ///< momentum of the output state, projected to the tangent space
  lagmul,            ///< multiplier extrapolated from the nodes, (lagmul)
  output_lambda,     ///< multiplier of the output state, (Theorem lamex)
  delta_lambda,      ///< lambda(u(c_j h), v(c_j h)) - lambda_j at the internal nodes, (dli)
  polynomials,       ///< u and v at eight points of a step, of (norm)
  g,                 ///< constraints
  hidden,            ///< hidden constraints grad g^T M^-1 p, (hidcons)
  H,                 ///< energy
  angular_momentum,  ///< every momentum that the problem conserves
  reversal,          ///< the start, after as many steps back (momenta reversed) as forth
  hidden_constant,   ///< hidden constraint over its leading term, for a constant Gram matrix
  hidden_drift,      ///< growth of the hidden constraint from t = 20 to t = 1280
  sweeps,            ///< sweeps of (iter) a step, less those of k = s
  order_conditions,  ///< order that a Runge-Kutta tableau has by the order conditions
  B,                 ///< condition B(2k) of the tableau, and B(2s) of the constraints' nodes
  C,                 ///< condition C(s)
  D,                 ///< condition D(s), D(s - 1) for k > s
  X,                 ///< X_s = P_s^-1 I_s, (IsPs), P_s^T Omega = P_s^-1, and P_0 = 1
  symmetry,          ///< c_i + c_{s+1-i} = 1, b_i = b_{s+1-i}, and A likewise
  W                  ///< P_s^-1 A P_s = X_s, the W-transformation
};

/// Its name in tables and claims files: "tangential p".
std::string_view name_of(Quantity quantity);
/// Also accepts '_' and '-' for the blank. \throws InputError
Quantity parse_quantity(std::string_view name);

/// How the error of a method is looked at.
enum class Span {
  step,     ///< after one step from consistent states
  interval  ///< after all steps to a fixed time, or the greatest over them (g, hidden, H, angular momentum)
};

enum class Form {
  at_least,   ///< the error is O(h^rate)
  exactly,    ///< and no smaller
  round_off,  ///< the error is 0 but for round-off, in every precision
  near        ///< the quantity itself lies within a tolerance of a value
};

/// One statement about one method and problem.
struct Claim {
  std::string label;  ///< of the paper's statement, or where else it is from
  Quantity quantity = Quantity::q;
  std::string problem;  ///< a scene, by name or file; "tableau" for the coefficients alone
  MethodPtr method;
  Span span = Span::interval;
  Form form = Form::at_least;
  double predicted = 0;               ///< rate, or value
  double tolerance = 0;               ///< of Form::near
  unsigned least_digits = 0;          ///< with which it must be looked at
  bool of_degenerate_motion = false;  ///< it speaks of the very motion, though that says nothing of the method

  /// "HBVM(3,2)", or the tableau's name.
  std::string method_text() const { return method->title(); }
};

/// A claim whose method is still to be said.
Claim make_claim(const std::string& label, Quantity quantity, const std::string& problem, Span span, Form form,
                 double predicted);

enum class Verdict {
  holds,
  fails,
  undecidable,  ///< neither, with the digits and the time there are
  degenerate,   ///< so it is, but for any method: the motion is too special
  not_run       ///< nothing could be measured
};
std::string_view name_of(Verdict verdict);

/// The errors of a quantity in one precision.
struct Ladder {
  std::string precision;
  std::vector<Rung> rungs;
};

/// Of time, in the scene's units.
struct Interval {
  double from = 0, to = 0;
};

/// What the audit found out about a claim.
struct Finding {
  Claim claim;
  Verdict verdict = Verdict::undecidable;
  double measured = 0, uncertainty = 0;  ///< rate, NaN if there is only round-off; of Form::round_off, units of
                                         ///< round-off in every step and how many are allowed
  std::string precision;                 ///< the greatest in which errors entered the verdict
  std::string reference;                 ///< what errors are measured against
  std::string reason;                    ///< of the verdict; of one that "holds", what proves it, if anything does
  std::optional<Interval> interval{};    ///< looked at; none of coefficients
  int coefficients_to = 0;               ///< digits to which the coefficients were seen to be right; 0: not looked at
  /// Processor time of the runs that this claim shared with others; NaN of what was known from before.
  double seconds = std::numeric_limits<double>::quiet_NaN();
  std::vector<Ladder> evidence;  ///< precision after precision
};

/// Whether a measured rate bears a claim out. It fails as soon as the interval value +- uncertainty excludes the
/// predicted rate (for `at_least`: lies below it), and holds if the interval lies above it or, as the exponents of an
/// expansion in h are whole numbers, if the predicted rate is whole, in the interval, and that is less than a half
/// wide.
Verdict judge(const Claim& claim, const std::optional<Rate>& rate);

}  // namespace hbvm
