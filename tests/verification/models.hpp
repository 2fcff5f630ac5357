#pragma once

#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

#include "linear/matrix.hpp"
#include "read_file.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {

inline std::string scene_path(const std::string& name) {
  return std::string(HBVM_SOURCE_DIR) + "/tests/verification/scenes/" + name + ".toml";
}

inline std::string scene_file_text(const std::string& name) { return read_file(scene_path(name)); }

/// A constrained problem as dense formulas in the working precision, written down a second time. It shares no code with
/// problem/, only the paper. m coordinates, nu constraints g_a = q^T A q + b^T q + c.
struct DenseModel {
  using Vec = Vector<Mpfr>;
  using Mat = Matrix<Mpfr>;
  struct Form {
    Mat A;
    Vec b;
    Mpfr c;
  };
  std::string scene;  ///< TOML text of the same problem
  Mat W;              ///< M^-1
  std::vector<Form> forms;
  std::function<Mpfr(const Vec&)> U;
  std::function<Vec(const Vec&)> force;  ///< grad U

  Index m() const { return W.rows(); }
  Index nu() const { return static_cast<Index>(forms.size()); }

  Vec g(const Vec& q) const {
    Vec result(nu());
    for (Index a = 0; a < nu(); ++a) {
      const Form& f = forms[static_cast<std::size_t>(a)];
      result[a] = q.dot(Vec(f.A * q)) + f.b.dot(q) + f.c;
    }
    return result;
  }
  /// grad g, m x nu.
  Mat gradient(const Vec& q) const {
    Mat result(m(), nu());
    for (Index a = 0; a < nu(); ++a) {
      const Form& f = forms[static_cast<std::size_t>(a)];
      result.col(a) = Mpfr(2) * (f.A * q) + f.b;
    }
    return result;
  }
  /// grad g^T M^-1 p.
  Vec hidden(const Vec& q, const Vec& p) const { return gradient(q).transpose() * Vec(W * p); }
  Mpfr energy(const Vec& q, const Vec& p) const { return Mpfr(p.dot(Vec(W * p)) / 2 - U(q)); }

  Vec gram_solve(const Vec& q, const Vec& right) const {
    const Mat G = gradient(q);
    return Mat(G.transpose() * (W * G)).inverse() * right;
  }
  Vec tangential(const Vec& q, const Vec& p) const { return p - gradient(q) * gram_solve(q, hidden(q, p)); }
  /// The closed form of Theorem 1.
  Vec multiplier(const Vec& q, const Vec& p) const {
    const Vec v = W * p;
    Vec right = gradient(q).transpose() * Vec(W * force(q));
    for (Index a = 0; a < nu(); ++a) right[a] += 2 * v.dot(Vec(forms[static_cast<std::size_t>(a)].A * v));
    return gram_solve(q, right);
  }
};

inline Vector<Mpfr> vector_of(const std::vector<const char*>& entries) {
  Vector<Mpfr> v(static_cast<Index>(entries.size()));
  for (Index i = 0; i < v.size(); ++i) v[i] = literal<Mpfr>(entries[static_cast<std::size_t>(i)]);
  return v;
}
inline Matrix<Mpfr> matrix_of(const std::vector<std::vector<const char*>>& rows) {
  Matrix<Mpfr> a(static_cast<Index>(rows.size()), static_cast<Index>(rows[0].size()));
  for (Index i = 0; i < a.rows(); ++i) a.row(i) = vector_of(rows[static_cast<std::size_t>(i)]).transpose();
  return a;
}

/// Masses 1 and 3, rods of 1 and 1/2, gravity (0, -1).
inline DenseModel double_pendulum() {
  DenseModel model;
  model.scene = scene_file_text("double_pendulum");
  model.W = vector_of({"1", "1", "1/3", "1/3"}).asDiagonal();
  const auto zero = vector_of({"0", "0", "0", "0"});
  model.forms = {
      {vector_of({"1", "1", "0", "0"}).asDiagonal(), zero, Mpfr(-1)},
      {matrix_of({{"1", "0", "-1", "0"}, {"0", "1", "0", "-1"}, {"-1", "0", "1", "0"}, {"0", "-1", "0", "1"}}), zero,
       literal<Mpfr>("-1/4")}};
  const Vector<Mpfr> weight = vector_of({"0", "-1", "0", "-3"});
  model.U = [weight](const auto& q) { return Mpfr(weight.dot(q)); };
  model.force = [weight](const auto&) { return weight; };
  return model;
}

inline DenseModel ellipsoid_bead() {
  DenseModel model;
  model.scene = scene_file_text("ellipsoid_bead");
  const Matrix<Mpfr> M = matrix_of({{"2", "1/4", "1/10"}, {"1/4", "1", "-1/5"}, {"1/10", "-1/5", "3/2"}});
  model.W = Eigen::Matrix<Mpfr, 3, 3>(M).inverse();
  model.forms = {{matrix_of({{"1", "1/4", "-1/5"}, {"1/4", "2", "1/3"}, {"-1/5", "1/3", "3/2"}}),
                  vector_of({"1/2", "-1/3", "1/4"}), literal<Mpfr>("-71/30")}};
  const Vector<Mpfr> weight = M * vector_of({"1/10", "3/10", "-1"}), source = vector_of({"-1", "2", "1/2"});
  const Mpfr charges = literal<Mpfr>("0.7 * 1.5 * (-0.8)");
  model.U = [=](const auto& q) {
    const Vector<Mpfr> x = q - source;
    return Mpfr(weight.dot(q) - charges / sqrt(Mpfr(x.dot(x))));
  };
  model.force = [=](const auto& q) {
    const Vector<Mpfr> x = q - source;
    const Mpfr r2 = x.dot(x);
    return Vector<Mpfr>(weight + x * Mpfr(charges / (r2 * sqrt(r2))));
  };
  return model;
}

/// The same bead, held on a plane as well: two constraints on one body, one of them linear.
inline DenseModel bead_on_curve() {
  DenseModel model = ellipsoid_bead();
  model.scene += "\n[[constraint]]\nkind = \"plane\"\nbody = \"bead\"\nnormal = [2, 1, 0]\noffset = 2.5\n";
  model.forms.push_back({Matrix<Mpfr>::Zero(3, 3), vector_of({"2", "1", "0"}), literal<Mpfr>("-5/2")});
  return model;
}

}  // namespace hbvm::core
