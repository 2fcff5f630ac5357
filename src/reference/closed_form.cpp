#include "hbvm/reference/closed_form.hpp"

#include <vector>

namespace hbvm {
namespace {

ExactPoint simple_pendulum(const Mpfr& t) {
  const Mpfr kappa = Mpfr(1) / 2;
  const JacobiFunctions f = jacobi_functions(t, kappa);
  const Mpfr sine = 2 * kappa * f.sn * f.dn, cosine = 1 - 2 * kappa * kappa * f.sn * f.sn, rate = 2 * kappa * f.cn;
  ExactPoint point{Vector<Mpfr>(2), Vector<Mpfr>(2)};
  point.q << sine, -cosine;
  point.p << rate * cosine, rate * sine;
  return point;
}

ExactPoint conical_pendulum(const Mpfr& t) {
  const Mpfr z0 = 1 / sqrt(Mpfr(2)), speed = sqrt(z0);
  const Mpfr angle = t * speed / z0, sine = sin(angle), cosine = cos(angle);
  ExactPoint point{Vector<Mpfr>(3), Vector<Mpfr>(3)};
  point.q << z0 * cosine, z0 * sine, -z0;
  point.p << -speed * sine, speed * cosine, Mpfr(0);
  return point;
}

}  // namespace

JacobiFunctions jacobi_functions(const Mpfr& u, const Mpfr& kappa) {
  std::vector<Mpfr> ratios;  // c_n / a_n
  Mpfr a = 1, b = sqrt(Mpfr(1 - kappa * kappa)), c = kappa, phi = u;
  const Mpfr negligible = epsilon<Mpfr>();
  while (abs(c) > negligible * a) {
    const Mpfr mean = (a + b) / 2, root = sqrt(Mpfr(a * b));
    c = (a - b) / 2;
    a = mean;
    b = root;
    ratios.push_back(c / a);
    phi *= 2;
  }
  phi *= a;
  for (auto ratio = ratios.rbegin(); ratio != ratios.rend(); ++ratio) phi = (phi + asin(Mpfr(*ratio * sin(phi)))) / 2;
  JacobiFunctions f{sin(phi), cos(phi), Mpfr(0)};
  f.dn = sqrt(Mpfr(1 - kappa * kappa * f.sn * f.sn));
  return f;
}

bool has_closed_form(const std::string& scene) { return scene == "simple_pendulum" || scene == "conical_pendulum"; }

std::optional<ExactPoint> closed_form(const std::string& scene, const Mpfr& t) {
  if (scene == "simple_pendulum") return simple_pendulum(t);
  if (scene == "conical_pendulum") return conical_pendulum(t);
  return std::nullopt;
}

}  // namespace hbvm
