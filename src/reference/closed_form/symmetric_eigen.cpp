#include "reference/closed_form/symmetric_eigen.hpp"

#include "reference/closed_form/rounds.hpp"

namespace hbvm::core {

SymmetricEigen::SymmetricEigen(Matrix<Mpfr> a) : values(a.rows()), vectors(Matrix<Mpfr>::Identity(a.rows(), a.rows())) {
  const Index n = a.rows();
  const Mpfr negligible = epsilon<Mpfr>() * max_norm(a) / 16;
  // Rotations at the greatest entry would take the sum of the squares off the diagonal to less than 1/e in a sweep. Row
  // by row the end is known to come (Forsythe and Henrici 1960), in a handful of sweeps: as many are allowed.
  Rounds sweeps("a matrix of a closed form", 2 * static_cast<double>(significand_bits<Mpfr>()) + 16);
  bool rotated = true;
  while (rotated) {
    sweeps.next();
    rotated = false;
    for (Index i = 0; i < n; ++i)
      for (Index j = i + 1; j < n; ++j) {
        if (magnitude(a(i, j)) <= negligible) continue;
        rotated = true;
        const Mpfr half = (a(j, j) - a(i, i)) / (2 * a(i, j)), root = sqrt(Mpfr(1 + half * half)),
                   t = half >= 0 ? Mpfr(1 / (half + root)) : Mpfr(-1 / (root - half)), c = 1 / sqrt(Mpfr(1 + t * t)),
                   s = t * c;
        const auto rotate = [&](Mpfr& x, Mpfr& y) {
          const Mpfr old = x;
          x = c * old - s * y;
          y = s * old + c * y;
        };
        for (Index l = 0; l < n; ++l) rotate(a(l, i), a(l, j));
        for (Index l = 0; l < n; ++l) rotate(a(i, l), a(j, l));
        for (Index l = 0; l < n; ++l) rotate(vectors(l, i), vectors(l, j));
        a(i, j) = a(j, i) = 0;
      }
  }
  for (Index i = 0; i < n; ++i) values[i] = a(i, i);
}

}  // namespace hbvm::core
