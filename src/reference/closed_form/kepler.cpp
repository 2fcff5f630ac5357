#include <algorithm>
#include <cmath>

#include "hbvm/error.hpp"
#include "reference/closed_form/elliptic.hpp"
#include "reference/closed_form/recognition.hpp"
#include "reference/closed_form/rounds.hpp"
#include "scalar/binary_exponent.hpp"

namespace hbvm::core {
namespace {

/// x'' = -mu x/|x|^3 of a body about a centre or of one body from another, mu > 0 or < 0. It is solved in the universal
/// variable s' = 1/r (Danby, Fundamentals of Celestial Mechanics, 1992, chapter 6). With alpha = 2 mu/r_0 - v_0^2, eta
/// = x_0 v_0 and Stumpff's c_k of alpha s^2,
///
///     t = r_0 s c_1 + eta s^2 c_2 + mu s^3 c_3,   r = r_0 c_0 + eta s c_1 + mu s^2 c_2
///
/// for ellipses, parabolas and hyperbolas alike. The centre of mass of two bodies moves by itself.
class Kepler : public ClosedForm {
 public:
  /// Of one body, or of two with `second`, with the same acceleration of all by a constant force.
  struct Bodies {
    Index first = 0;
    std::optional<Index> second;
    Mpfr first_mass, second_mass;
    Vector<Mpfr> center, acceleration;
  };
  Kepler(const Recognition& content, const Bodies& bodies, const Mpfr& mu)
      : ClosedForm(content.scene.problem), bodies_(bodies), mu_(mu), d_(content.dimension) {
    const auto body = [&](const Vector<Mpfr>& x, Index offset) { return Vector<Mpfr>(x.segment(offset, d_)); };
    const Vector<Mpfr> q1 = body(content.scene.q0, bodies.first),
                       v1 = body(content.scene.p0, bodies.first) / bodies.first_mass;
    if (bodies.second) {
      const Vector<Mpfr> q2 = body(content.scene.q0, *bodies.second),
                         v2 = body(content.scene.p0, *bodies.second) / bodies.second_mass;
      const Mpfr total = bodies.first_mass + bodies.second_mass;
      share_ = bodies.second_mass / total;
      x_ = q1 - q2;
      v_ = v1 - v2;
      middle_ = q1 - share_ * x_;
      drift_ = v1 - share_ * v_;
    } else {
      share_ = 1;
      x_ = q1 - bodies.center;
      v_ = v1;
      middle_ = bodies.center;
      drift_ = Vector<Mpfr>::Zero(d_);
    }
    r_ = norm(x_);
    eta_ = inner(x_, v_);
    alpha_ = 2 * mu / r_ - inner(v_, v_);
  }

  /// Whether it runs straight into the centre.
  bool collides(const Mpfr& round_off) const {
    constexpr int units = 64;
    const Mpfr across = norm(Vector<Mpfr>(v_ - eta_ / (r_ * r_) * x_));
    return mu_ > 0 && across <= units * round_off * (norm(v_) + sqrt(Mpfr(mu_ / r_)));
  }

  std::string name() const override { return "Kepler's problem (universal variables)"; }

 private:
  struct Anomaly {
    Mpfr s, t, r;
    StumpffFunctions c;
  };
  Anomaly at_anomaly(const Mpfr& s) const {
    const StumpffFunctions c = stumpff_functions(Mpfr(alpha_ * s * s));
    return {s, s * (r_ * c.c1 + s * (eta_ * c.c2 + mu_ * s * c.c3)), r_ * c.c0 + s * (eta_ * c.c1 + mu_ * s * c.c2), c};
  }

  /// The least distance from the centre that the motion ever has.
  Mpfr pericenter() const {
    const Mpfr square = inner(x_, x_) * inner(v_, v_) - eta_ * eta_;  // of the angular momentum
    const Mpfr e2 = 1 - alpha_ * square / (mu_ * mu_), e = e2 > 0 ? Mpfr(sqrt(e2)) : Mpfr(0);
    return mu_ > 0 ? Mpfr(square / (mu_ * (1 + e))) : Mpfr(mu_ * (1 + e) / alpha_);
  }

  /// A bound of the distance until t, by the greatest speed.
  Mpfr farthest(const Mpfr& t) const {
    return r_ + magnitude(t) * sqrt(Mpfr(2 * magnitude(Mpfr(mu_ / pericenter())) + magnitude(alpha_)));
  }

  /// log2 |a/b|.
  static double log2_ratio(const Mpfr& a, const Mpfr& b) {
    return static_cast<double>(binary_exponent(a)) - static_cast<double>(binary_exponent(b));
  }

  /// t grows with s: Newton's iteration, with bisection where it would leave what encloses s, or does not halve its own
  /// change in two rounds. Between two bisections there are no more rounds of Newton's than bits, and no more
  /// bisections than bits.
  Anomaly anomaly(const Mpfr& t) const {
    constexpr const char* what = "Kepler's equation of a closed form";
    Mpfr before = 0, after = t / r_;
    // As dt/ds is nowhere less than the least distance, s is at most t over that.
    constexpr double few = 4;
    Rounds doublings(what, std::max(double{0}, log2_ratio(r_, pericenter())) + few);
    while ((at_anomaly(after).t - t) * t < 0) {
      doublings.next();
      before = after;
      after *= 2;
    }
    // Halvings of what encloses s, which is at least t over the greatest distance.
    const double bits =
        static_cast<double>(significand_bits<Mpfr>()) + std::max(double{0}, log2_ratio(after, Mpfr(t / farthest(t))));
    if (before > after) swap(before, after);
    Mpfr last = after - before, change_before = last;
    Anomaly now = at_anomaly(Mpfr((before + after) / 2));
    const Mpfr negligible = 4 * epsilon<Mpfr>();
    Rounds rounds(what, (bits + few) * (bits + few));
    while (after - before > negligible * std::max(magnitude(before), magnitude(after))) {
      rounds.next();
      const Mpfr change = (t - now.t) / now.r;
      if (magnitude(change) <= negligible * magnitude(now.s)) return at_anomaly(Mpfr(now.s + change));
      (change < 0 ? after : before) = now.s;
      Mpfr next = now.s + change;
      const bool slow = 2 * magnitude(change) > magnitude(change_before);
      if (slow || !(next > before && next < after)) next = (before + after) / 2;
      change_before = last;
      last = next - now.s;
      now = at_anomaly(next);
    }
    return now;
  }

  State state(const Mpfr& t) const override {
    Mpfr rest = t;
    if (alpha_ > 0) {
      const Mpfr period = 8 * atan(Mpfr(1)) * mu_ / (alpha_ * sqrt(alpha_));
      rest -= floor(Mpfr(t / period)) * period;
    }
    Vector<Mpfr> x = x_, v = v_;
    if (rest != 0) {
      const Anomaly a = anomaly(rest);
      const Mpfr s = a.s, s2 = s * s;
      // Lagrange's coefficients.
      const Mpfr f = 1 - mu_ * s2 * a.c.c2 / r_, g = s * (r_ * a.c.c1 + s * eta_ * a.c.c2),
                 f_rate = -mu_ * s * a.c.c1 / (a.r * r_), g_rate = 1 - mu_ * s2 * a.c.c2 / a.r;
      x = f * x_ + g * v_;
      v = f_rate * x_ + g_rate * v_;
    }
    const Vector<Mpfr> middle = middle_ + t * drift_ + t * t / 2 * bodies_.acceleration,
                       drift = drift_ + t * bodies_.acceleration;
    State now{Vector<Mpfr>(problem().m()), Vector<Mpfr>(problem().m())};
    now.q.segment(bodies_.first, d_) = middle + share_ * x;
    now.p.segment(bodies_.first, d_) = bodies_.first_mass * (drift + share_ * v);
    if (bodies_.second) {
      now.q.segment(*bodies_.second, d_) = middle - (1 - share_) * x;
      now.p.segment(*bodies_.second, d_) = bodies_.second_mass * (drift - (1 - share_) * v);
    }
    return now;
  }

  Bodies bodies_;
  Mpfr mu_;
  Index d_;
  Mpfr share_;  ///< of the distance, between the middle and the first body
  Vector<Mpfr> x_, v_, middle_, drift_;
  Mpfr r_, eta_, alpha_;
};

bool is_inverse_distance(const EffectTerm<Mpfr>& term) {
  return term.kind == "central_gravity" || term.kind == "mutual_gravity" || term.kind == "coulomb";
}

}  // namespace

std::unique_ptr<ClosedForm> kepler_of(const Recognition& content) {
  const Problem<Mpfr>& problem = content.scene.problem;
  const Index d = content.dimension;
  if (d == 1 || problem.nu() > 0 || (problem.m() != d && problem.m() != 2 * d)) return nullptr;
  const bool two = problem.m() == 2 * d;
  const std::optional<Mpfr> first_mass = content.mass_at(0), second_mass = two ? content.mass_at(d) : Mpfr(0);
  if (!first_mass || !second_mass) return nullptr;
  Kepler::Bodies bodies{.first = 0,
                        .second = std::nullopt,
                        .first_mass = *first_mass,
                        .second_mass = *second_mass,
                        .center = Vector<Mpfr>::Zero(d),
                        .acceleration = Vector<Mpfr>::Zero(d)};
  if (two) bodies.second = d;
  // U = k/r of all together, and the constant force on each.
  Mpfr k = 0;
  bool attracted = false;
  Vector<Mpfr> force = Vector<Mpfr>::Zero(problem.m());
  for (const Acting& a : content.acting) {
    const Displacement<Mpfr>& x = a.displacement();
    if (a.term->constant_force) {
      const Vector<Mpfr> gradient = a.gradient(Vector<Mpfr>::Zero(a.term->arguments * d));
      a.for_each_coordinate(d, [&](Index i, Index at, const Mpfr& weight) { force[at] += weight * gradient[i]; });
      continue;
    }
    if (!is_inverse_distance(*a.term) || x.blocks.size() != (two ? 2u : 1u)) return nullptr;
    for (const auto& block : x.blocks)
      if (magnitude(block.weight) != 1) return nullptr;
    if (two && (x.shift.size() > 0 || x.blocks[0].weight != -x.blocks[1].weight)) return nullptr;
    Vector<Mpfr> center = Vector<Mpfr>::Zero(d);
    if (!two && x.shift.size() > 0) center = -x.blocks[0].weight * x.shift;
    if (attracted && center != bodies.center) return nullptr;
    bodies.center = center;
    attracted = true;
    k -= a.gradient(Vector<Mpfr>::Unit(d, 0))[0];
  }
  if (!attracted || k == 0) return nullptr;
  bodies.acceleration = force.head(d) / *first_mass;
  if (two) {
    const Vector<Mpfr> other = force.tail(d) / *second_mass;
    constexpr int units = 8;
    if (distance(bodies.acceleration, other) > units * content.round_off * max_norm(other)) return nullptr;
  } else if (max_norm(force) > 0) {
    return nullptr;
  }
  const Mpfr mu = two ? Mpfr(k / *first_mass + k / *second_mass) : Mpfr(k / *first_mass);
  auto motion = std::make_unique<Kepler>(content, bodies, mu);
  if (motion->collides(content.round_off)) return nullptr;
  return motion;
}

}  // namespace hbvm::core
