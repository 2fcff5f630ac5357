#include "proved_course.hpp"

#include "interruption.hpp"
#include "krawczyk.hpp"
#include "scalar/binary_exponent.hpp"

namespace hbvm::core {
namespace {

/// Bits of errors and of derivatives.
constexpr slong bits_of_errors = 128;

std::size_t place(Index i) { return static_cast<std::size_t>(i); }

/// A column of q above p.
BallMatrix stacked(const Vector<Mpfr>& q, const Vector<Mpfr>& p) {
  BallMatrix column(2 * q.size(), 1);
  for (Index j = 0; j < q.size(); ++j) {
    column.set(j, 0, exact_ball(raw(q[j])));
    column.set(q.size() + j, 0, exact_ball(raw(p[j])));
  }
  return column;
}

/// What the exact start is off by.
BallMatrix start_error(const Assembled<Mpfr>& exact, const Assembled<Mpfr>& rounded) {
  const std::vector<RealBall> q = believed(exact.q0), p = believed(exact.p0);
  const BallMatrix column = stacked(rounded.q0, rounded.p0);
  BallMatrix error(column.rows(), 1);
  const auto m = static_cast<Index>(q.size());
  for (Index j = 0; j < m; ++j) {
    error.set(j, 0, q[place(j)] - column.at(j, 0));
    error.set(m + j, 0, p[place(j)] - column.at(m + j, 0));
  }
  return error;
}

/// Powers of two near the lengths that positions and momenta have, if velocities are of size 1.
std::vector<double> units_of_state(const BallProblem& problem, const RealBall& h) {
  std::vector<double> units;
  const double of_step = power_of_two<double>(binary_exponent(centre_of(raw(h))));
  for (const bool of_momenta : {false, true})
    for (Index j = 0; j < problem.m(); ++j) {
      const double length = centre_of(raw(square_root(problem.M().at(j, j))));
      const double unit = power_of_two<double>(binary_exponent(length));
      units.push_back(of_momenta ? unit : of_step / unit);
    }
  return units;
}

}  // namespace

ProvedCourse::ProvedCourse(const Assembled<Mpfr>& exact, const Assembled<Mpfr>& rounded, const Hbvm<Mpfr>& method,
                           RealBall h)
    : problem_(rounded.problem),
      method_(method),
      bits_(significand_bits<Mpfr>() + 32),
      balls_(ball_problem_of(exact.problem)),
      ball_method_([&] {
        const BallScope scope(bits_);
        return make_ball_method(method.k, method.s, method.r);
      }()),
      h_(std::move(h)),
      stages_(balls_, ball_method_, h_),
      solver_(make_solver(SolverKind::automatic, problem_, method_)),
      q_(rounded.q0),
      p_(rounded.p0),
      error_([&] {
        const BallScope scope(bits_);
        return ErrorFrame(start_error(exact, rounded), units_of_state(balls_, h_));
      }()),
      radius_(RealBall(1) / RealBall(2)) {
  arf_get_mpfr(raw(rounded_h_), arb_midref(raw(h_)), MPFR_RNDN);
}

StageBox ProvedCourse::centre() const {
  const Index m = problem_.m(), nu = problem_.nu();
  const StageUnknowns<Mpfr>& x = solver_->unknowns();
  StageBox box{stacked(q_, p_), BallMatrix(stages_.unknowns(), 1)};
  for (Index l = 0; l < method_.s; ++l) {
    for (Index j = 0; j < m; ++j) box.unknowns.set(stages_.of_gamma(l, j), 0, exact_ball(raw(x.gamma(l, j))));
    for (Index a = 0; a < nu; ++a) box.unknowns.set(stages_.of_lambda(l, a), 0, exact_ball(raw(x.lambda(l, a))));
  }
  return box;
}

std::vector<RealBall> ProvedCourse::units(const StageBox& centre) {
  const Index m = problem_.m(), nu = problem_.nu();
  const auto length = [](const std::vector<RealBall>& x, const std::vector<RealBall>& y) {
    RealBall square;
    for (std::size_t j = 0; j < x.size(); ++j) square.add_product(x[j], y[j]);
    return square_root(greatest_magnitude(square));
  };
  std::vector<RealBall> q, pull;
  for (Index j = 0; j < m; ++j) q.push_back(centre.start.at(j, 0));
  for (const BallSeries& force : balls_.force(as_series(q), 1)) pull.push_back(h_ * force[0]);
  RealBall size = length(pull, balls_.velocity(pull));
  for (Index l = 0; l < method_.s; ++l) {
    std::vector<RealBall> gamma;
    for (Index j = 0; j < m; ++j) gamma.push_back(centre.unknowns.at(stages_.of_gamma(l, j), 0));
    size += length(gamma, balls_.velocity(gamma));
  }
  if (!size.is_positive()) size = 1;  // at rest
  momentum_size_ = multiplier_size_ = RealBall();
  std::vector<RealBall> result(place(stages_.unknowns()));
  for (Index j = 0; j < m; ++j) {
    const RealBall unit = greatest_magnitude(size * square_root(balls_.M().at(j, j)));
    momentum_size_ = greater(momentum_size_, unit);
    for (Index l = 0; l < method_.s; ++l) result[place(stages_.of_gamma(l, j))] = unit;
  }
  for (Index a = 0; a < nu; ++a) {
    std::vector<RealBall> gradient(place(m));
    for (const BallSlope& slope : balls_.slopes(a, as_series(q), 1))
      gradient[place(slope.coordinate)] = slope.series[0];
    const RealBall unit = greatest_magnitude(size / (h_ * length(gradient, balls_.velocity(gradient))));
    multiplier_size_ = greater(multiplier_size_, unit);
    for (Index l = 0; l < method_.s; ++l) result[place(stages_.of_lambda(l, a))] = unit;
  }
  return result;
}

StageBox ProvedCourse::Near::box(const RealBall& radius) const {
  StageBox wide = middle;
  for (Index i = 0; i < error.rows(); ++i)
    wide.start.set(i, 0, widened(wide.start.at(i, 0), greatest_magnitude(error.at(i, 0))));
  for (Index i = 0; i < wide.unknowns.rows(); ++i)
    wide.unknowns.set(i, 0, widened(wide.unknowns.at(i, 0), radius * units[place(i)]));
  return wide;
}

ProvedCourse::Near ProvedCourse::near(StageBox middle, BallMatrix error, std::vector<RealBall> units) const {
  const BallScope scope(bits_);
  StageImage image = stages_.image(middle);
  return {std::move(middle), std::move(image), std::move(error), std::move(units)};
}

RealBall ProvedCourse::distance_of_root(const Near& near) {
  constexpr slong least_radius = -60;
  RealBall least = 1;
  arb_mul_2exp_si(raw(least), raw(least), least_radius);
  for (;;) {
    const StageDerivative derivative = stages_.derivative(near.box(radius_));
    const Krawczyk test(derivative.by_unknowns, near.image.residual + derivative.by_start * near.error, near.units,
                        radius_);
    if (test.proves()) return test.distance();
    radius_ = radius_ / RealBall(2);
    if (radius_.is_below(least)) refuse(near);
  }
}

void ProvedCourse::refuse(const Near& near) const {
  // Where the state itself is known well it is the equations that have no root, or more than one.
  constexpr slong well = -30;
  const Index m = problem_.m();
  for (Index j = 0; j < m; ++j) {
    RealBall most = near.units[place(stages_.of_gamma(0, j))];
    arb_mul_2exp_si(raw(most), raw(most), well);
    if (!greatest_magnitude(near.error.at(m + j, 0)).is_below(most))
      throw CourseTooWide("the bounds of the state become too wide");
  }
  throw IntegrationError(
      "nothing proves that its equations have a solution, and one only: take a smaller step, or more stages");
}

void ProvedCourse::step() {
  end_if_asked("the proof of the steps was interrupted");
  static_cast<void>(solver_->solve({q_, p_, rounded_h_}));
  const BallScope scope(bits_of_errors);
  StageBox middle = centre();
  std::vector<RealBall> of_unknowns = units(middle);
  const Near forward = near(std::move(middle), error_.hull(), std::move(of_unknowns));
  // Where the root is, derivatives in a small box tell. With J of the residual F by the unknowns, G by the start, it is
  // off by -J^-1 (F(middle) + G error).
  const StageDerivative derivative = stages_.derivative(forward.box(distance_of_root(forward)));
  BallMatrix of_residual, of_start;
  if (!derivative.by_unknowns.solve(forward.image.residual, of_residual) ||
      !derivative.by_unknowns.solve(derivative.by_start, of_start))
    throw IntegrationError("the derivative of its equations cannot be told from a singular matrix");
  move_to(forward.image.end, derivative.end_by_unknowns * of_residual,
          derivative.end_by_start - derivative.end_by_unknowns * of_start);
  {
    const BallMatrix off = of_residual + of_start * forward.error;
    const BallScope whole(bits_);
    multipliers_ = stages_.multipliers_at_end(forward.middle.unknowns - off);
  }
  // The step back has the root that is mirrored, and no other near it.
  const Index m = problem_.m();
  StageBox back{stacked(q_, -p_), stages_.mirrored(forward.middle.unknowns)};
  BallMatrix error = error_.hull();
  for (Index j = m; j < 2 * m; ++j) error.set(j, 0, -error.at(j, 0));
  distance_of_root(near(std::move(back), std::move(error), forward.units));
  ++steps_;
}

void ProvedCourse::move_to(const BallMatrix& end, const BallMatrix& correction, const BallMatrix& map) {
  const Index m = problem_.m();
  BallMatrix added;
  {
    const BallScope whole(bits_);
    const BallMatrix corrected = end - correction;
    for (Index j = 0; j < m; ++j) {
      arf_get_mpfr(raw(q_[j]), arb_midref(corrected(j, 0)), MPFR_RNDN);
      arf_get_mpfr(raw(p_[j]), arb_midref(corrected(m + j, 0)), MPFR_RNDN);
    }
    added = corrected - stacked(q_, p_);
  }
  error_.map(map, added);
}

DiscreteState ProvedCourse::state() const {
  const Index m = problem_.m();
  const BallMatrix hull = [&] {
    const BallScope few(bits_of_errors);
    return error_.hull();
  }();
  const BallScope scope(bits_);
  const BallMatrix at = stacked(q_, p_) + hull;
  DiscreteState state;
  for (Index j = 0; j < m; ++j) {
    state.q.push_back(at.at(j, 0));
    state.p.push_back(at.at(m + j, 0));
  }
  const std::vector<RealBall> v = balls_.velocity(state.p);
  for (std::size_t j = 0; j < v.size(); ++j) state.kinetic += v[j] * state.p[j] / RealBall(2);
  state.potential = balls_.potential_energy(state.q);
  state.g = balls_.constraint_values(state.q);
  return state;
}

}  // namespace hbvm::core
