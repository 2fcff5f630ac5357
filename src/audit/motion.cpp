#include "motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hbvm/error.hpp"
#include "integrate/coefficient_decay.hpp"
#include "linear/product.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/closed_form/closed_form.hpp"
#include "reference/reference_motion.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {
namespace {

struct PhasePoint {
  Vector<Mpfr> q, p;
};

/// y' = f(y) on the constraints: q' = M^-1 p, p' = grad U - grad g lambda.
class VectorField {
 public:
  explicit VectorField(const Problem<Mpfr>& problem) : problem_(problem), point_(problem) {}

  /// M^-1 p, which is 0 for driven coordinates.
  Vector<Mpfr> velocity(const Vector<Mpfr>& p) const {
    Vector<Mpfr> v(p.size());
    problem_.mass.velocity(lanes(p), lanes(v));
    return v;
  }
  /// q' at a state, with the velocities of driven points.
  Vector<Mpfr> velocity(const PhasePoint& y) {
    Vector<Mpfr> v(y.p.size());
    point_.set_velocity(y.q, y.p, v);
    return v;
  }
  Vector<Mpfr> force(const PhasePoint& y) { return point_.force(y.q, y.p); }
  /// Its two parts, of which an acceleration may be a small difference.
  const typename StateEvaluator<Mpfr>::Forces& forces(const PhasePoint& y) { return point_.forces(y.q, y.p); }

  /// (f(y + eta x) - f(y - eta x))/(2 eta): f'(y) x but for eta^2.
  PhasePoint derivative(const PhasePoint& y, const PhasePoint& x, const Mpfr& eta) {
    const auto at = [&](const Mpfr& t) { return force({y.q + t * x.q, y.p + t * x.p}); };
    return {velocity(x.p), (at(eta) - at(-eta)) / (2 * eta)};
  }

 private:
  const Problem<Mpfr>& problem_;
  StateEvaluator<Mpfr> point_;
};

/// log2 of the spectral radius of f'(y) by the power method, in the norm of the kinetic energy. Eight iterations leave
/// the fastest part alone, and sixteen more are taken. It is -infinity if no force depends on the state.
double log2_spectral_radius(const Assembled<Mpfr>& scene) {
  constexpr int first = 8, last = 24;
  VectorField field(scene.problem);
  const PhasePoint y{scene.q0, scene.p0};
  const Mpfr eta = ldexp(Mpfr(1), -100);
  const Index m = scene.problem.m();
  PhasePoint x{Vector<Mpfr>(m), Vector<Mpfr>(m)};
  // Any direction with a part in each; these are no multiples of each other.
  for (Index j = 0; j < m; ++j) {
    x.q[j] = (j % 2 == 0 ? 1 : -1) + Mpfr(1) / (j + 3);
    x.p[j] = (j % 3 == 0 ? -1 : 1) + Mpfr(1) / (j + 5);
  }
  x.p = scene.problem.mass.momentum(x.p);
  double growth = 0;
  for (int n = 1; n <= last; ++n) {
    x = field.derivative(y, x, eta);
    const Mpfr size = sqrt(dot(x.p, field.velocity(x.p)));
    if (size == 0) return log2_of(size);
    if (n > first) growth += log2_of(size);
    x.q /= size;
    x.p /= size;
  }
  return growth / (last - first);
}

/// Whether steps of 2^log2_h resolve the motion: what four stages neglect is a sixteenth of what varies at most.
bool resolves(const Assembled<Mpfr>& scene, int log2_h) {
  constexpr int s = 4, steps = 2;
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(s, s);
  const Mpfr h = ldexp(Mpfr(1), log2_h);
  HbvmStepper<Mpfr> stepper(scene.problem, method, SolverKind::automatic);
  State<Mpfr> state(scene.q0, scene.p0);
  CoefficientDecay<Mpfr> decay(scene.problem, s, h);
  for (int n = 0; n < steps; ++n) {
    decay.observe(stepper.step(state, h), state);
  }
  return 16 * decay.worst(state.q).ratio <= 1;
}

/// \param radius log2 of the spectral radius
int log2_time_scale(const Assembled<Mpfr>& scene, double radius) {
  constexpr int most_halvings = 40;
  if (!std::isfinite(radius)) {
    // Nothing but straight lines: any time will do, such as that in which the bodies move as far as they are away.
    const Vector<Mpfr> moment = scene.problem.mass.momentum(scene.q0);
    const double time = log2_of(max_norm(moment)) - log2_of(max_norm(scene.p0));
    return std::isfinite(time) ? static_cast<int>(std::lround(time)) : 0;
  }
  const int longest = static_cast<int>(std::ceil(2 - radius));
  for (int halvings = 0;; ++halvings) try {
      if (resolves(scene, longest - halvings)) return longest - halvings;
      if (halvings >= most_halvings)
        throw IntegrationError("no step is short enough for the motion: its coefficients do not fall");
    } catch (const StageFailure&) {
      if (halvings >= most_halvings) throw;
    }
}

/// What a point of a relative equilibrium keeps: the products of all accelerations and their derivatives. (Positions
/// and velocities may share a uniform motion besides.)
class Products {
 public:
  Products(const Problem<Mpfr>& problem, VectorField& field, const Mpfr& scale)
      : problem_(problem), field_(field), scale_(scale) {}

  void observe(const PhasePoint& y) {
    const auto& forces = field_.forces(y);
    const Vector<Mpfr> applied = field_.velocity(forces.applied), constraint = field_.velocity(forces.constraint),
                       a = applied + constraint, v = field_.velocity(y);
    const PhasePoint flow{v, forces.applied + forces.constraint};
    const Vector<Mpfr> jerk = field_.velocity(field_.derivative(y, flow, ldexp(scale_, -40)).p) * scale_;
    const Index d = problem_.dimension;
    std::vector<Vector<Mpfr>> vectors;
    for (Index at = 0; at < problem_.mass.of_bodies(); at += d) {
      const Mpfr size =
          max_norm(Vector<Mpfr>(applied.segment(at, d))) + max_norm(Vector<Mpfr>(constraint.segment(at, d)));
      Vector<Mpfr> own = a.segment(at, d), change = jerk.segment(at, d);
      moves_ = moves_ || max_norm(Vector<Mpfr>(v.segment(at, d))) > 0;
      // All of it may be the round-off of forces that balance.
      const bool is_free = ldexp(max_norm(own), balance) <= size;
      if (is_free) {
        own.setZero();
        change.setZero();
      }
      accelerated_ = accelerated_ || !is_free;
      bent_ = bent_ || is_bent(own, v.segment(at, d));
      vectors.push_back(std::move(own));
      vectors.push_back(std::move(change));
    }
    for (std::size_t i = 0, n = 0; i < vectors.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j, ++n) {
        const Mpfr product = dot(vectors[i], vectors[j]),
                   size = sqrt(Mpfr(dot(vectors[i], vectors[i]) * dot(vectors[j], vectors[j])));
        if (n == ranges_.size()) ranges_.push_back({product, product, size});
        auto& [least, most, greatest] = ranges_[n];
        if (product < least) least = product;
        if (product > most) most = product;
        if (size > greatest) greatest = size;
      }
  }

  bool is_accelerated() const { return accelerated_; }
  bool moves() const { return moves_; }
  bool is_straight() const { return !bent_; }
  bool are_constant() const {
    return std::all_of(ranges_.begin(), ranges_.end(),
                       [](const Range& r) { return ldexp(Mpfr(r.most - r.least), tolerance) <= r.greatest; });
  }

 private:
  /// Less than a millionth is nothing. A motion so near to an equilibrium shows the orders of the deviation at steps
  /// too short to be looked at.
  static constexpr int tolerance = 20;
  static constexpr int balance = 60;
  struct Range {
    Mpfr least, most, greatest;
  };

  static bool is_bent(const Vector<Mpfr>& a, const Vector<Mpfr>& v) {
    const Mpfr aa = dot(a, a), vv = dot(v, v), av = dot(a, v);
    return ldexp(Mpfr(aa * vv - av * av), tolerance) > aa * vv;
  }

  const Problem<Mpfr>& problem_;
  VectorField& field_;
  Mpfr scale_;
  std::vector<Range> ranges_;
  bool accelerated_ = false, moves_ = false, bent_ = false;
};

}  // namespace

Motion motion_of(const std::string& scene_name) {
  const Scene scene = load_scene(scene_name);
  Motion motion;
  double radius = 0;
  {
    const PrecisionScope scope(60);
    radius = log2_spectral_radius(assemble<Mpfr>(scene));
  }
  const PrecisionScope scope(30);
  const Assembled<Mpfr> assembled = assemble<Mpfr>(scene);
  const Problem<Mpfr>& problem = assembled.problem;
  motion.has_closed_form = closed_form_of(assembled) != nullptr;
  motion.log2_scale = log2_time_scale(assembled, radius);
  constexpr int s = 6, steps = 8;
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(s, s);
  const Mpfr scale = ldexp(Mpfr(1), motion.log2_scale), h = scale / steps;
  HbvmStepper<Mpfr> stepper(problem, method, SolverKind::automatic);
  State<Mpfr> state(assembled.q0, assembled.p0);
  VectorField field(problem);
  StateEvaluator<Mpfr> point(problem);
  Products products(problem, field, scale);
  products.observe({state.q, state.p});
  for (int n = 0; n < steps; ++n) {
    stepper.step(state, h);
    products.observe({state.q, point.tangential(state.q, state.p)});
  }
  motion.straight = products.is_straight();
  if (!products.is_accelerated())
    motion.degenerate = products.moves() ? "no force accelerates anything" : "nothing moves";
  else if (products.are_constant())
    motion.degenerate = "it is a relative equilibrium: all accelerations keep their sizes and the angles between them";
  return motion;
}

}  // namespace hbvm::core
