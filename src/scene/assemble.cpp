#include "hbvm/scene/assemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "hbvm/problem/constraint_gradient.hpp"
#include "hbvm/problem/effect/use.hpp"
#include "hbvm/problem/regularity.hpp"
#include "hbvm/scalar/literal.hpp"
#include "hbvm/scalar/text.hpp"

namespace hbvm {
namespace {

template <Scalar S>
class Assembler {
 public:
  explicit Assembler(const Scene& scene) : scene_(scene), d_(scene.dimension) {}

  Assembled<S> assemble(Consistency consistency) {
    problem().dimension = d_;
    for (const ScenePoint& point : scene_.points)
      at_line(point.line, "point '" + point.name + "'", [&] { add(point); });
    for (const SceneBody& body : scene_.bodies) at_line(body.line, "body '" + body.name + "'", [&] { add(body); });
    for (const SceneRigidBody& body : scene_.rigid_bodies)
      at_line(body.line, "rigid_body '" + body.name + "'", [&] { add(body); });
    std::size_t number = 0;
    for (const SceneConstraint& constraint : scene_.constraints)
      at_line(constraint.line, "constraint " + std::to_string(++number) + " (" + constraint.kind + ")",
              [&] { add(constraint); });
    problem().potential.dimension = d_;
    problem().potential.m = problem().m();
    number = 0;
    for (const SceneEffect& effect : scene_.effects)
      at_line(effect.line, "effect " + std::to_string(++number) + " (" + effect.kind + ")", [&] { add(effect); });
    initial_state();
    if (consistency == Consistency::checked) check_consistency();
    return std::move(result_);
  }

 private:
  /// A body's place among the coordinates, or a point's place in space.
  struct Place {
    std::optional<Index> offset;
    Vector<S> position;     // of a point
    std::optional<S> mass;  // scalar
    Matrix<S> mass_matrix;
    std::optional<S> charge;
  };

  Problem<S>& problem() { return result_.problem; }

  /// Errors from within say where in the scene they arose.
  void at_line(std::size_t line, const std::string& what, const std::function<void()>& work) const {
    try {
      work();
    } catch (const InputError& error) {
      throw InputError(scene_.name + (line > 0 ? ":" + std::to_string(line) : "") + ": " + what + ": " + error.what());
    }
  }

  S number(const Expression& e) const { return evaluate<S>(e, scene_.constants); }
  std::optional<S> number(const std::optional<Expression>& e) const {
    return e ? std::optional<S>(number(*e)) : std::nullopt;
  }
  Vector<S> vector(const SceneVector& v) const {
    Vector<S> r(static_cast<Index>(v.size()));
    for (std::size_t i = 0; i < v.size(); ++i) r[static_cast<Index>(i)] = number(v[i]);
    return r;
  }
  Matrix<S> matrix(const SceneMatrix& a) const {
    const auto n = static_cast<Index>(a.size());
    Matrix<S> r(n, n);
    for (Index i = 0; i < n; ++i) r.row(i) = vector(a[static_cast<std::size_t>(i)]).transpose();
    return r;
  }
  static Matrix<S> symmetric(Matrix<S> a, const std::string& what) {
    for (Index j = 0; j < a.cols(); ++j)
      for (Index i = 0; i < j; ++i)
        if (a(i, j) != a(j, i)) throw InputError("the matrix '" + what + "' is not symmetric");
    return a;
  }

  void add(const ScenePoint& point) {
    Place place;
    place.position = vector(point.position);
    place.charge = number(point.charge);
    places_.emplace(point.name, std::move(place));
  }

  void add(const SceneBody& body) {
    Place place;
    place.offset = problem().m();
    problem().blocks.push_back({*place.offset, true});
    place.charge = number(body.charge);
    if (body.mass) {
      place.mass = number(*body.mass);
      problem().mass.add_scalar(d_, *place.mass);
      place.mass_matrix = Matrix<S>::Identity(d_, d_) * *place.mass;
    } else {
      place.mass_matrix = matrix(*body.mass_matrix);
      problem().mass.add_full(place.mass_matrix);
    }
    append(positions_, vector(body.position));
    // One of the two stays 0; initial_state() adds them up.
    const Vector<S> zero = Vector<S>::Zero(d_);
    append(velocities_, body.velocity.empty() ? zero : vector(body.velocity));
    append(momenta_, body.momentum.empty() ? zero : vector(body.momentum));
    places_.emplace(body.name, std::move(place));
  }

  void add(const SceneRigidBody& body) {
    const S mass = number(body.mass);
    if (!(mass > 0)) throw InputError("a mass must be positive");
    const Vector<S> center = vector(body.center), reference = vector(body.position);
    const Matrix<S> moment = symmetric(matrix(body.second_moment), "second_moment");
    const Index origin = problem().m();
    // x = r + sum_a X_a d_a: the mass matrix is [[m, m c^T], [m c, J]] times the identity of space, r fixed: J alone.
    const Index first = body.fixed ? 0 : 1, blocks = first + 3;
    Matrix<S> coefficients(blocks, blocks);
    if (!body.fixed) coefficients(0, 0) = mass;
    for (Index a = 0; a < 3; ++a) {
      if (!body.fixed) coefficients(0, a + 1) = coefficients(a + 1, 0) = mass * center[a];
      for (Index b = 0; b < 3; ++b) coefficients(first + a, first + b) = moment(a, b);
    }
    Matrix<S> M = Matrix<S>::Zero(3 * blocks, 3 * blocks);
    for (Index a = 0; a < blocks; ++a)
      for (Index b = 0; b < blocks; ++b)
        for (Index j = 0; j < 3; ++j) M(3 * a + j, 3 * b + j) = coefficients(a, b);
    problem().mass.add_full(M);

    const Matrix<S> directors = matrix(body.directors);
    const Vector<S> omega = vector(body.angular_velocity);
    if (!body.fixed) {
      problem().blocks.push_back({origin, true});
      append(positions_, reference);
      append(velocities_, vector(body.velocity));
    }
    Displacement<S> mass_center;
    if (body.fixed)
      mass_center.shift = reference;
    else
      mass_center.blocks.push_back({origin, S(1)});
    for (Index a = 0; a < 3; ++a) {
      const Index offset = origin + 3 * (first + a);
      const Vector<S> director = directors.row(a).transpose();
      append(positions_, director);
      problem().blocks.push_back({offset, false});
      Vector<S> rate(3);
      for (Index j = 0; j < 3; ++j) {
        const Index k = (j + 1) % 3, l = (j + 2) % 3;
        rate[j] = omega[k] * director[l] - omega[l] * director[k];
      }
      append(velocities_, rate);
      if (center[a] != 0) mass_center.blocks.push_back({offset, center[a]});
      for (Index b = a; b < 3; ++b) {
        const Displacement<S> x{{{offset, S(1)}}, {}}, y{{{origin + 3 * (first + b), S(1)}}, {}};
        ConstraintForms<S> orthonormal = Rod<S>{x, S(1)};
        if (b > a) orthonormal = DisplacementProduct<S>{x, y, S(0)};
        problem().constraints.push_back(
            {"directors " + std::to_string(a + 1) + " and " + std::to_string(b + 1) + " of '" + body.name + "'",
             std::move(orthonormal)});
      }
    }
    append(momenta_, Vector<S>::Zero(3 * blocks));
    mass_centers_.push_back({std::move(mass_center), mass});
  }

  const Place& place(const std::string& name) const { return places_.at(name); }

  /// a - b.
  Displacement<S> difference(const std::string& a, const std::string& b) const {
    Displacement<S> x;
    Vector<S> shift = Vector<S>::Zero(d_);
    bool shifted = false;
    for (const auto& [name, weight] : {std::pair(a, 1), std::pair(b, -1)}) {
      const Place& end = place(name);
      if (end.offset) {
        x.blocks.push_back({*end.offset, S(weight)});
      } else {
        shift += S(weight) * end.position;
        shifted = shifted || end.position != Vector<S>::Zero(d_);
      }
    }
    if (shifted) x.shift = shift;
    return x;
  }

  void add(const SceneConstraint& c) {
    ConstraintUse<S> use;
    use.dimension = d_;
    std::string name = c.kind;
    with_constraint_form<S>(c.kind, [&]<class Form>() {
      for (const ConstraintKey& key : Form::keys) give(c, key, use, name);
      problem().constraints.push_back({name, form_of(Form::from(use))});
    });
  }

  /// The value of a key; whom it names is added to the name of the constraint: "rod 'a'-'b'", "plane of 'a'".
  void give(const SceneConstraint& c, const ConstraintKey& key, ConstraintUse<S>& use, std::string& name) const {
    using Takes = ConstraintKey::Takes;
    switch (key.takes) {
      case Takes::pair: {
        const auto& [a, b] = c.pairs.find(key.name)->second;
        use.pairs.emplace(key.name, difference(a, b));
        name += (name == c.kind ? " '" : ", '") + a + "'-'" + b + "'";
        break;
      }
      case Takes::body: {
        const std::string& body = c.bodies.find(key.name)->second;
        use.bodies.emplace(key.name, *place(body).offset);
        name += (name == c.kind ? " of '" : ", '") + body + "'";
        break;
      }
      case Takes::number:
        use.numbers.emplace(key.name, number(c.numbers.find(key.name)->second));
        break;
      case Takes::vector:
        use.vectors.emplace(key.name, vector(c.vectors.find(key.name)->second));
        break;
      case Takes::symmetric_matrix:
        use.matrices.emplace(key.name, symmetric(matrix(c.matrices.find(key.name)->second), std::string(key.name)));
        break;
    }
  }

  /// A form, or one of several.
  template <class Form>
  static ConstraintForms<S> form_of(Form form) {
    return form;
  }
  template <class... Form>
  static ConstraintForms<S> form_of(std::variant<Form...> form) {
    return std::visit([](auto& one) -> ConstraintForms<S> { return std::move(one); }, form);
  }

  void add(const SceneEffect& effect) {
    EffectUse<S> use;
    use.kind = effect.kind;
    use.dimension = d_;
    for (const auto& [key, e] : effect.numbers) use.numbers.emplace(key, number(e));
    for (const auto& [key, e] : effect.vectors) {
      const Vector<S> v = vector(e);
      use.vectors.emplace(key, std::vector<S>(v.begin(), v.end()));
    }
    with_effect(effect.kind, [&]<class Effect>() { instances<Effect>(effect, use); });
    if (!use.instances.empty()) problem().potential.terms.push_back(make_term(use));
  }

  template <class Effect>
  void instances(const SceneEffect& effect, EffectUse<S>& use) const {
    const auto instance = [&](const Displacement<S>& x) {
      typename EffectUse<S>::Instance i;
      i.x = x;
      i.mass_matrix = Matrix<S>::Zero(d_, d_);
      return i;
    };
    if constexpr (Effect::acts == Acts::between_pairs) {
      for (const auto& [a, b] : pairs(effect, Effect::needs_charge)) {
        auto i = instance(difference(a, b));
        const std::string* names[2] = {&a, &b};
        for (int end = 0; end < 2; ++end) give(*names[end], Effect::needs_mass, Effect::needs_charge, i, end);
        use.instances.push_back(std::move(i));
      }
    } else {
      for (const SceneBody& body : scene_.bodies) {
        if (effect.on && std::count(effect.on->begin(), effect.on->end(), body.name) == 0) continue;
        const Place& p = place(body.name);
        auto i = instance(Effect::acts == Acts::about_a_center ? difference(body.name, effect.center)
                                                               : Displacement<S>{{{*p.offset, S(1)}}, {}});
        i.mass_matrix = p.mass_matrix;
        give(body.name, Effect::needs_mass, Effect::needs_charge, i, 0);
        use.instances.push_back(std::move(i));
      }
      if constexpr (Effect::acts == Acts::on_each_body) {
        if (effect.on) return;
        for (const auto& [x, mass] : mass_centers_) {
          auto i = instance(x);
          i.mass_matrix = Matrix<S>::Identity(d_, d_) * mass;
          use.instances.push_back(std::move(i));
        }
      }
    }
  }

  void give(const std::string& name, bool mass, bool charge, typename EffectUse<S>::Instance& i, int end) const {
    const Place& p = place(name);
    if (mass && !p.mass)
      throw InputError("'" + name + "' has " + (p.offset ? "a mass matrix" : "no mass") + "; a scalar mass is needed");
    if (mass) i.masses[end] = *p.mass;
    if (charge && !p.charge) throw InputError("'" + name + "' has no charge");
    if (charge) i.charges[end] = *p.charge;
  }

  /// The pairs an effect names, or all: of bodies, and for charges of bodies and points.
  std::vector<std::pair<std::string, std::string>> pairs(const SceneEffect& effect, bool charged) const {
    std::vector<std::pair<std::string, std::string>> result;
    if (effect.between) {
      for (const auto& [a, b] : *effect.between) {
        if (!place(a).offset && !place(b).offset) throw InputError("'" + a + "' and '" + b + "' are both fixed points");
        result.emplace_back(a, b);
      }
      return result;
    }
    std::vector<std::string> names;
    for (const SceneBody& body : scene_.bodies)
      if (!charged || body.charge) names.push_back(body.name);
    const std::size_t bodies = names.size();
    if (charged)
      for (const ScenePoint& point : scene_.points)
        if (point.charge) names.push_back(point.name);
    for (std::size_t a = 0; a < bodies; ++a)
      for (std::size_t b = a + 1; b < names.size(); ++b) result.emplace_back(names[a], names[b]);
    return result;
  }

  static void append(std::vector<S>& all, const Vector<S>& part) { all.insert(all.end(), part.begin(), part.end()); }

  void initial_state() {
    const Index m = problem().m();
    result_.q0 = Eigen::Map<const Vector<S>>(positions_.data(), m);
    result_.p0 = problem().mass.momentum(Eigen::Map<const Vector<S>>(velocities_.data(), m)) +
                 Eigen::Map<const Vector<S>>(momenta_.data(), m);
  }

  void check_consistency() {
    const Problem<S>& p = problem();
    if (p.nu() == 0) return;
    const S tolerance = consistency_tolerance<S>();
    Vector<S> v(p.m());
    p.mass.velocity(lanes(result_.p0), lanes(v));
    // The velocity of a coordinate carries the round-off of its block's momenta.
    S speed = max_norm(v);
    for (const auto& block : p.mass.blocks())
      if (block.full)
        for (Index j = 0; j < block.size; ++j) {
          S sum = 0;
          for (Index l = 0; l < block.size; ++l) sum += magnitude(S(block.W(j, l) * result_.p0[block.offset + l]));
          raise_to(speed, sum);
        }
    const Independence<S> independence = find_independent(p, result_.q0, v);
    for (const Dependence<S>& dependence : independence.redundant) check_agreement(dependence);
    ConstraintGradient<S> gradient(p, 1);
    gradient.update(lanes(result_.q0));
    for (Index a = 0; a < p.nu(); ++a) {
      const Constraint<S>& constraint = p.constraints[static_cast<std::size_t>(a)];
      const auto at_start = value(constraint, d_, result_.q0);
      report(a, "position", at_start.g, S(tolerance * at_start.size));
      S w;
      gradient.transposed_times(a, lanes(v), &w);
      report(a, "velocity", w, S(tolerance * speed * gradient_size(constraint, d_, result_.q0)));
    }
    for (const Dependence<S>& dependence : independence.redundant) check_bending(dependence);
    check_angle(independence);
    if (independence.redundant.empty()) return;
    for (const Dependence<S>& dependence : independence.redundant)
      result_.redundant.push_back({name(dependence.constraint), names(dependence.others)});
    set_aside(problem(), independence);
  }

  std::string name(Index a) const {
    return "constraint " + std::to_string(a + 1) + " (" +
           result_.problem.constraints[static_cast<std::size_t>(a)].name + ")";
  }
  std::vector<std::string> names(const std::vector<Index>& constraints) const {
    std::vector<std::string> result;
    for (const Index a : constraints) result.push_back(name(a));
    return result;
  }
  std::string list(const std::vector<Index>& constraints) const {
    std::string text;
    for (const std::string& other : names(constraints)) text += (text.empty() ? "" : ", ") + other;
    return text;
  }

  /// Contradictory constraints leave no state at all, and one whose gradient vanishes has no multiplier.
  void check_agreement(const Dependence<S>& dependence) const {
    const std::string who = scene_.name + ": " + name(dependence.constraint) + " is ",
                      why = ": at the start its gradient " +
                            (dependence.others.empty() ? std::string("vanishes")
                                                       : "is a combination of those of " + list(dependence.others));
    std::vector<Index> all = dependence.others;
    all.insert(all.begin(), dependence.constraint);
    for (const Index a : all) {
      const auto at_start = value(result_.problem.constraints[static_cast<std::size_t>(a)], d_, result_.q0);
      if (at_start.vanishes()) continue;
      const std::string whose = a == dependence.constraint ? "its residual" : "the residual of " + name(a);
      throw InputError(who + "contradictory" + why + ", and " + whose + " there is " + to_scientific(at_start.g, 3));
    }
    if (dependence.others.empty()) throw InputError(who + "redundant" + why);
  }

  /// A motion that the others allow must not leave the constraint at once.
  void check_bending(const Dependence<S>& dependence) const {
    if (magnitude(dependence.bending) <= dependence.round_off) return;
    throw InputError(scene_.name + ": " + name(dependence.constraint) +
                     " is contradictory: at the start its gradient is a combination of those of " +
                     list(dependence.others) + ", but along the initial velocity its second derivative is " +
                     to_scientific(dependence.bending, 3) + " where they hold, tolerance " +
                     to_scientific(dependence.round_off, 3));
  }

  /// Below an angle of sqrt(epsilon) the multipliers have no digit.
  void check_angle(const Independence<S>& independence) const {
    using std::sqrt;
    if (independence.square_of_sine > epsilon<S>()) return;
    throw InputError(scene_.name + ": the Gram matrix of the constraints is singular to this precision at the start: " +
                     "the gradient of " + name(independence.nearest) + " is a combination of those of " +
                     list(independence.near) + " but for an angle of " +
                     to_scientific(S(sqrt(independence.square_of_sine)), 3) + "; take more digits");
  }

  void report(Index a, const std::string& what, const S& residual, const S& tolerance) const {
    if (magnitude(residual) <= tolerance) return;
    throw InputError(scene_.name + ": the initial " + what + " is not consistent with " + name(a) + ": residual " +
                     to_scientific(residual, 3) + ", tolerance " + to_scientific(tolerance, 3) + " at this precision");
  }

  const Scene& scene_;
  Index d_;
  Assembled<S> result_;
  std::map<std::string, Place> places_;
  std::vector<S> positions_, velocities_, momenta_;
  std::vector<std::pair<Displacement<S>, S>> mass_centers_;  // of rigid bodies, with their masses
};

}  // namespace

std::string to_text(const Redundancy& redundancy) {
  return fmt::format("{} follows from {}", redundancy.name, fmt::join(redundancy.others, ", "));
}

template <Scalar S>
Assembled<S> assemble(const Scene& scene, Consistency consistency) {
  return Assembler<S>(scene).assemble(consistency);
}

#define HBVM_DEFINE(S) template Assembled<S> assemble<S>(const Scene&, Consistency);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
