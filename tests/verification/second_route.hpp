#pragma once

#include <boost/numeric/odeint/algebra/range_algebra.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <vector>

#include "verification/models.hpp"

namespace hbvm::core {

using OdeState = std::vector<Mpfr>;

/// x(T) of x' = f(x), by `steps` steps of Boost.odeint's Runge-Kutta-Fehlberg 7(8), which shares nothing with HBVM.
/// \param f (x, rate)
template <class F>
OdeState second_route(const F& f, OdeState x, const Mpfr& T, int steps) {
  using namespace boost::numeric::odeint;
  runge_kutta_fehlberg78<OdeState, Mpfr, OdeState, Mpfr> stepper;
  const auto system = [&](const OdeState& at, OdeState& rate, const Mpfr&) { f(at, rate); };
  const Mpfr h = T / steps;
  for (int n = 0; n < steps; ++n) stepper.do_step(system, x, Mpfr(h * n), h);
  return x;
}

inline Vector<Mpfr> part(const OdeState& x, Index first, Index size) {
  return Eigen::Map<const Vector<Mpfr>>(x.data() + first, size);
}

/// Positions, momenta and multipliers at one time.
struct Exact {
  Vector<Mpfr> q, p, lambda;
};

/// Two angles from the downward vertical: q_a = (sin x, -cos x), q_b = q_a + (sin y, -cos y)/2, masses 1 and 3, g = 1.
struct DoublePendulumInAngles {
  Mpfr half = Mpfr(1) / 2;

  void operator()(const OdeState& x, OdeState& rate) const {
    // Lagrange's equations: A (x'', y'') = r.
    const Mpfr c = cos(Mpfr(x[0] - x[1])), s = sin(Mpfr(x[0] - x[1]));
    const Mpfr a11 = 4, a12 = 3 * half * c, a22 = 3 * half * half;
    const Mpfr r1 = -3 * half * x[3] * x[3] * s - 4 * sin(x[0]), r2 = 3 * half * (x[2] * x[2] * s - sin(x[1]));
    const Mpfr determinant = a11 * a22 - a12 * a12;
    rate[0] = x[2];
    rate[1] = x[3];
    rate[2] = (a22 * r1 - a12 * r2) / determinant;
    rate[3] = (a11 * r2 - a12 * r1) / determinant;
  }

  Exact at(const Mpfr& T, int steps) const {
    const Mpfr x0 = atan2(Mpfr(3), Mpfr(4)), y0 = atan2(Mpfr(4), Mpfr(-3));
    const OdeState x = second_route(*this, {x0, y0, half, Mpfr(-1)}, T, steps);
    OdeState rate(4);
    (*this)(x, rate);
    Exact result{Vector<Mpfr>(4), Vector<Mpfr>(4), Vector<Mpfr>(2)};
    Vector<Mpfr> acceleration(4), a(2), b(2);
    const auto direction = [](const Mpfr& angle) { return Vector<Mpfr>{{sin(angle), Mpfr(-cos(angle))}}; };
    const auto normal = [](const Mpfr& angle) { return Vector<Mpfr>{{cos(angle), sin(angle)}}; };
    a = direction(x[0]);
    b = direction(x[1]) * half;
    const Vector<Mpfr> va = normal(x[0]) * x[2], vb = normal(x[1]) * Mpfr(half * x[3]);
    const Vector<Mpfr> aa = normal(x[0]) * rate[2] - direction(x[0]) * Mpfr(x[2] * x[2]);
    const Vector<Mpfr> ab = (normal(x[1]) * rate[3] - direction(x[1]) * Mpfr(x[3] * x[3])) * half;
    result.q << a, a + b;
    result.p << va, Mpfr(3) * (va + vb);
    // The rods' pulls, from m q'' = m g - grad g lambda of b and then of a.
    const Vector<Mpfr> g{{Mpfr(0), Mpfr(-1)}};
    result.lambda[1] = b.dot(Vector<Mpfr>(Mpfr(3) * (g - aa - ab))) / (2 * b.dot(b));
    result.lambda[0] = a.dot(Vector<Mpfr>(g - aa + b * Mpfr(2 * result.lambda[1]))) / (2 * a.dot(a));
    return result;
  }
};

/// q = 3/2 (sin t cos f, sin t sin f, -cos t), mass 2, and V = 0.4 (1/2)(-3) / |q - c| of the fixed charge.
struct SphericalPendulumInAngles {
  const Mpfr radius = Mpfr(3) / 2, K = literal<Mpfr>("-0.6");
  const Vector<Mpfr> charge = vector_of({"2", "-1/2", "-1"});

  struct Frame {
    Vector<Mpfr> q, along_t, along_f;
  };
  Frame frame(const Mpfr& t, const Mpfr& f) const {
    const Mpfr st = sin(t), ct = cos(t), sf = sin(f), cf = cos(f);
    return {Vector<Mpfr>{{Mpfr(radius * st * cf), Mpfr(radius * st * sf), Mpfr(-radius * ct)}},
            Vector<Mpfr>{{Mpfr(radius * ct * cf), Mpfr(radius * ct * sf), Mpfr(radius * st)}},
            Vector<Mpfr>{{Mpfr(-radius * st * sf), Mpfr(radius * st * cf), Mpfr(0)}}};
  }
  Vector<Mpfr> force(const Vector<Mpfr>& q) const {
    const Vector<Mpfr> x = q - charge;
    const Mpfr r2 = x.dot(x);
    Vector<Mpfr> result = x * Mpfr(K / (r2 * sqrt(r2)));
    result[2] -= 2;
    return result;
  }

  void operator()(const OdeState& x, OdeState& rate) const {
    const Frame at = frame(x[0], x[1]);
    const Vector<Mpfr> F = force(at.q);
    const Mpfr st = sin(x[0]), ct = cos(x[0]), inertia = 2 * radius * radius;
    rate[0] = x[2];
    rate[1] = x[3];
    rate[2] = st * ct * x[3] * x[3] + F.dot(at.along_t) / inertia;
    rate[3] = -2 * x[2] * x[3] * ct / st + F.dot(at.along_f) / (inertia * st * st);
  }

  Exact at(const Mpfr& T, int steps) const {
    const Mpfr t0 = atan2(Mpfr(sqrt(Mpfr(5))), Mpfr(2)), f0 = atan2(Mpfr(2), Mpfr(1));
    const OdeState x = second_route(*this, {t0, f0, literal<Mpfr>("1/2"), literal<Mpfr>("3/4")}, T, steps);
    const Frame end = frame(x[0], x[1]);
    Exact result{end.q, (end.along_t * x[2] + end.along_f * x[3]) * Mpfr(2), Vector<Mpfr>(1)};
    // On the sphere q.q'' = -|q'|^2, so that q.(m q'' - F) = -2 |q|^2 lambda.
    const Vector<Mpfr> v = result.p / Mpfr(2);
    result.lambda[0] = (end.q.dot(force(end.q)) + 2 * v.dot(v)) / (2 * radius * radius);
    return result;
  }
};

/// q' = M^-1 p, p' = grad U - grad g lambda(q, p) with the multiplier of Theorem 1.
struct IndexReduced {
  const DenseModel& model;

  void operator()(const OdeState& x, OdeState& rate) const {
    const Index m = model.m();
    const Vector<Mpfr> q = part(x, 0, m), p = part(x, m, m);
    Eigen::Map<Vector<Mpfr>>(rate.data(), m) = model.W * p;
    Eigen::Map<Vector<Mpfr>>(rate.data() + m, m) = model.force(q) - model.gradient(q) * model.multiplier(q, p);
  }

  Exact at(const Vector<Mpfr>& q0, const Vector<Mpfr>& p0, const Mpfr& T, int steps) const {
    OdeState x(q0.begin(), q0.end());
    x.insert(x.end(), p0.begin(), p0.end());
    x = second_route(*this, x, T, steps);
    const Vector<Mpfr> q = part(x, 0, model.m()), p = part(x, model.m(), model.m());
    return {q, p, model.multiplier(q, p)};
  }
};

}  // namespace hbvm::core
