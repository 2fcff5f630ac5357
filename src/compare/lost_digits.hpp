#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "hbvm/results.hpp"
#include "problem/energy_terms.hpp"
#include "problem/state_evaluator.hpp"
#include "scalar/log2_of.hpp"

namespace hbvm::core {

/// \throws Interrupted if the work is to end
void end_comparison_if_asked();

/// What a state is off by, as log10, beside the exact state at the same time.
struct StateDrift {
  double H = 0;       ///< H less that of the exact state, over the size of its terms
  double g = 0;       ///< the greatest |g|, over the size of its terms
  double hidden = 0;  ///< p less its tangential part, over |p|; NaN where there is no tangent space
};

/// Measures what states are off by. The problem must outlive it.
class DriftGauge {
 public:
  explicit DriftGauge(const Problem<Mpfr>& problem);

  StateDrift operator()(const Vector<Mpfr>& q, const Vector<Mpfr>& p, const Vector<Mpfr>& exact_q,
                        const Vector<Mpfr>& exact_p);
  /// g alone, where p is not known.
  double of_g(const Vector<Mpfr>& q);
  /// Moves a state that is near to the constraints, and to their tangent space there.
  /// \throws IntegrationError if the constraints' gradients are dependent there, or the state is too far away
  void make_consistent(Vector<Mpfr>& q, Vector<Mpfr>& p);

 private:
  const Problem<Mpfr>& problem_;
  EnergyTerms<Mpfr> energy_;
  StateEvaluator<Mpfr> point_;
};

/// log10 of how far two motions are from that of a scene at ascending times, over the size of q or p, whichever is
/// more. Their starts differ by small changes: q by the factor 1 + change, and p by that or by 1 - change.
std::vector<std::array<double, 2>> growth_of_changes(const Problem<Mpfr>& problem, const Vector<Mpfr>& q0,
                                                     const Vector<Mpfr>& p0, const Mpfr& change,
                                                     const std::vector<Mpfr>& times);

/// One part of the error of a file, and digits that it alone would leave at each time. None if it is not known.
struct ErrorPart {
  LostBy part;
  const char* title;  ///< "growth", "g", "hidden", "H"
  std::vector<double> digits;
};

/// Those parts, in the order of their titles above. Nothing is seen to grow at one time.
std::array<ErrorPart, 4> parts_of_error(const FileComparison& file);

/// "7.3"; "all" of an error of 0, and "-" where there are none to count.
std::string digits_text(double digits);

/// What explains most of a file's error at its last time. That is the part that alone would leave the fewest digits, if
/// these are no more than one above what is left. Of parts within a digit of that, leaving g counts first and then
/// leaving the hidden constraint, since both change H, too. \param left digits
LostBy most_lost_by(const FileComparison& file, double left);

}  // namespace hbvm::core
