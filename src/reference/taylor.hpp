#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>

#include "problem/gram_factor.hpp"
#include "problem/problem.hpp"
#include "reference/closed_form/closed_form.hpp"
#include "reference/program_series.hpp"

namespace hbvm::core {

class ForceBounds;

/// The motion by its Taylor series, in the digits of the scope: no quadrature, no stage equations, no basis, no
/// iteration. The unit of time h is about as long as the step. In it q' = h M^-1 p, p' = h (grad U(q) - grad g(q)
/// lambda), and grad g is affine in q, or by a formula. Coefficient after coefficient,
///
///     (n+1) q_{n+1} = v_n,  v = h M^-1 p,  (n+1) p_{n+1} = h (F_n - sum_{i <= n} G_i lambda_{n-i})
///
/// where F is grad U, by the program of its gradient. G = grad g is by its second derivatives and values, or by the
/// program of its gradient, too. lambda_n is found by coefficient n + 1 of the hidden constraint G^T v = 0,
///
///     G_0^T M^-1 G_0 lambda_n = G_0^T M^-1 (F_n - sum_{0 < i <= n} G_i lambda_{n-i})
///                               + (n+1)/h^2 sum_{0 < i <= n+1} G_i^T v_{n+1-i}
///
/// whose matrix is factored once a step; for n = 0 that is the multiplier of Theorem 1. Order and step are those of
/// Jorba and Zou (Experimental Mathematics 14, 2005). The step is so long that the last two terms are round-off of
/// every body's position and momentum. As h is that long, coefficients fall to round-off, and so do the numbers of
/// which convolutions consist, AlignedSeries. After each step the state is moved to the constraints and their tangent
/// space, by round-off.
///
/// Forces without a potential are in F, by the program of F, whose inputs are the series of positions and of
/// velocities. Driven points have the series of their courses, whose accelerations are beside M^-1 F. The momenta of
/// their coordinates are accounts of work, whose series are convolutions of velocities and forces.
///
/// The coefficients tell only what is near the start of a step. So it is no longer than ForceBounds allow. They look at
/// the forces on a circle of radius R about its start in complex time. With |F| <= M there, and F analytic inside, the
/// terms of F from order N on add up to at most M (h/R)^N / (1 - h/R).
class TaylorMotion {
 public:
  /// The motion from the consistent state (q0, p0) at t = 0. The problem must outlive it.
  /// \throws IntegrationError if there is no series there
  /// \param while_working is called after every coefficient, and may throw to end the work
  TaylorMotion(const Problem<Mpfr>& problem, const Vector<Mpfr>& q0, const Vector<Mpfr>& p0,
               std::function<void()> while_working = {});
  ~TaylorMotion();

  /// The order of a series with so many bits.
  static Index order_for(int bits);

  /// The state at t, not before the last.
  /// \throws IntegrationError at a singularity of the forces or of the constraints, with its time
  /// \param after_step is called with the time after every step, and may throw to end the work
  void advance_to(const Mpfr& t, const std::function<void(const Mpfr&)>& after_step = {});
  const Vector<Mpfr>& q() const { return q_; }
  const Vector<Mpfr>& p() const { return p_; }
  const Vector<Mpfr>& lambda() const { return lambda_; }
  ExactPoint output() const { return {q_, p_, lambda_}; }

  /// The step under way: where it starts, the unit h of its series, how long it is. The series of the positions
  /// have coefficients up to order(), those of the multipliers up to order() - 1.
  const Mpfr& start() const { return start_; }
  const Mpfr& unit() const { return unit_; }
  const Mpfr& length() const { return length_; }
  const Mpfr* position(Index j) const { return &q_values_[static_cast<std::size_t>(j * (order_ + 2))]; }
  const Mpfr* multiplier(Index a) const { return &lambda_values_[static_cast<std::size_t>(a * (order_ + 2))]; }
  /// Goes on to the step that begins where this one ends.
  void next_step();
  /// Ends the step under way after so long a time at most.
  void shorten(const Mpfr& most);

  Index order() const { return order_; }
  long steps() const { return steps_; }
  /// log2 of the least radius of convergence that the coefficients of a step showed.
  double least_radius() const { return least_radius_; }

 private:
  /// A component of grad g, which several coordinates have but for the sign. It is an affine form of q, or a sum of
  /// outputs of a formula's gradient.
  struct Form {
    Form(Index of, Index coordinate, Index terms_of_series)
        : constraint(of), columns{{coordinate, 1}}, series(terms_of_series), velocity(terms_of_series) {}

    Mpfr constant = 0;
    std::vector<std::pair<Index, Mpfr>> terms;
    Index constraint;
    std::vector<std::pair<Index, int>> columns;  ///< coordinates, with the sign
    /// Its terms are the columns times this, if it is not 0: then its velocity is its derivative over it.
    Mpfr factor = 0;
    AlignedSeries series, velocity;
    std::optional<GrowingConvolution> hidden, pulling;  ///< of the hidden constraint, and with the multiplier
    struct Part {
      std::size_t slope, output;
      Mpfr weight;
    };
    std::vector<Part> parts;
  };
  /// The gradient of one instance of an effect, or of a constraint by a formula.
  struct Slope {
    const EffectTerm<Mpfr>& term;
    Index instance;
    ProgramSeries series;
  };
  /// A force without a potential, of one instance.
  struct Pull {
    const ForceTerm<Mpfr>& term;
    Index instance;
    ProgramSeries series;
  };
  /// Coefficients up to n of the driven points' courses.
  void set_courses(Index n);
  /// Coefficient n + 1 of the driven coordinates' momenta, from F_ and the velocities.
  void set_accounts(Index n);
  Index driven() const { return problem_.m() - problem_.mass.of_bodies(); }
  const Mpfr& course(Index j, Index n) const {
    const Index d = problem_.dimension;
    return courses_[static_cast<std::size_t>(j / d)].output(static_cast<std::size_t>(j % d), n);
  }
  Mpfr* q_series(Index j) { return &q_values_[static_cast<std::size_t>(j * (order_ + 2))]; }
  Mpfr* p_series(Index j) { return &p_values_[static_cast<std::size_t>(j * (order_ + 2))]; }
  Mpfr* v_series(Index j) { return &v_values_[static_cast<std::size_t>(j * (order_ + 2))]; }
  Mpfr* form_series(std::size_t l) { return &form_values_[l * static_cast<std::size_t>(order_ + 2)]; }
  /// sum of the signs times v of the form's columns, the form's velocity.
  Mpfr* form_velocity(std::size_t l) { return &form_velocities_[l * static_cast<std::size_t>(order_ + 2)]; }
  Mpfr* lambda_series(Index a) { return &lambda_values_[static_cast<std::size_t>(a * (order_ + 2))]; }

  void collect_forms();
  std::vector<Form> affine_forms(Index constraint) const;
  std::vector<Form> formula_forms(Index constraint);
  Slope slope_of(const EffectTerm<Mpfr>& term, Index instance) const;
  /// Coefficient n of a slope from those of q up to n.
  void advance(Slope& slope, Index n);
  void advance(Pull& pull, Index n);
  void set_velocity(Index n);
  void set_forms(Index n);
  void factor_gram();
  /// Brings q_0 to the constraints and p_0 to their tangent space, but for round-off there already.
  void project();
  void set_force(Index n);
  void set_multipliers(Index n);
  /// Coefficients of degree 0 from q_, p_, with the Gram matrix; then all.
  void begin(const Vector<Mpfr>& q, const Vector<Mpfr>& p);
  void expand(Index order);
  /// The unit of time, from what a few coefficients at (q0, p0) show.
  void find_unit();
  void set_unit(double log2);
  /// The series from start_q_, start_p_, in a unit in which they do not grow, and the step.
  void take_up();
  /// What some coefficients of a body's position or momentum say, as log2. These are `step` units that the series may
  /// take, and `radius` units of convergence. The last is by how much terms are larger than what it is in a unit.
  struct Extent {
    double step, radius, growth;
  };
  Extent extent(Index order);
  /// log2 of the length of the step, at most `most`, for which the forces are bounded. \throws IntegrationError if none
  /// is
  double bounded_length(double most);
  /// (G^T v)_{n+1} less G_0^T v_{n+1}, of one form.
  void set_hidden(Mpfr& r, std::size_t l, Index n);
  /// The series at the time tau after the step's start.
  void evaluate(const Mpfr& tau, Vector<Mpfr>& q, Vector<Mpfr>& p);
  /// The multiplier at q_, p_, moved to the constraints first.
  void finish();

  const Problem<Mpfr>& problem_;
  std::function<void()> while_working_;
  Index order_;
  std::vector<Form> forms_;
  std::deque<Slope> forces_, constraint_slopes_;
  std::deque<Pull> pulls_;
  std::deque<ProgramSeries> courses_;
  Index courses_known_ = -1;                  ///< the highest coefficient
  std::vector<std::vector<Mpfr>> on_driven_;  ///< the series of the forces on driven coordinates
  std::vector<Mpfr> q_values_, p_values_, v_values_, form_values_, form_velocities_, lambda_values_;
  ConstraintGradient<Mpfr> gradient_;
  GramFactor<Mpfr> gram_;
  Vector<Mpfr> F_, weighted_, rhs_, powers_;  ///< grad U less sum G_i lambda, M^-1 of it
  Vector<Mpfr> start_q_, start_p_, q_, p_, lambda_;
  std::vector<AlignedSeries> aligned_lambda_;
  /// The unit of time h, log2 of it, and 1/h^2.
  Mpfr unit_ = 1, per_square_ = 1;
  double log2_unit_ = 0, first_log2_unit_ = 0, next_log2_unit_ = 0;
  std::unique_ptr<ForceBounds> bounds_;
  double next_log2_length_;  ///< what to try first
  Mpfr start_ = 0, length_ = 0, t_ = 0, x_ = 0;
  long steps_ = 0;
  double least_radius_ = 0;
};

}  // namespace hbvm::core
