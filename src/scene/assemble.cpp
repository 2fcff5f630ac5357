#include "scene/assemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "listed.hpp"
#include "problem/constraint_gradient.hpp"
#include "problem/effect/input.hpp"
#include "problem/force/force_input.hpp"
#include "problem/formula/quadratic.hpp"
#include "problem/formula/symmetry.hpp"
#include "problem/regularity.hpp"
#include "problem/state_evaluator.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"
#include "scalar/working_digits.hpp"
#include "scene/formula_binding.hpp"
#include "scene/moving_point.hpp"
#include "scene/nearest_position.hpp"
#include "scene/own_precision.hpp"
#include "scene/second_moment.hpp"
#include "scene/turning.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
class Assembler {
 public:
  explicit Assembler(const Scene& scene) : scene_(scene), d_(scene.dimension) {}

  Assembled<S> assemble(Consistency consistency) {
    problem().dimension = d_;
    add_named(scene_.points, "point");
    add_named(scene_.bodies, "body");
    add_named(scene_.rigid_bodies, "rigid_body");
    add_moving_points();
    add_named(scene_.attachments, "attachment");
    add_numbered(scene_.constraints, "constraint");
    problem().potential.dimension = d_;
    add_numbered(scene_.effects, "effect");
    problem().potential.m = problem().m();
    initial_state();
    if (consistency == Consistency::checked) check_consistency();
    return std::move(result_);
  }

  // What a formula takes from the bodies and points of the scene.

  Displacement<S> position(const std::string& name) const { return place(name).x; }
  S mass(const std::string& name) const {
    typename EffectInput<S>::Instance i;
    give(name, true, false, i, 0);
    return i.masses[0];
  }
  S charge(const std::string& name) const {
    typename EffectInput<S>::Instance i;
    give(name, false, true, i, 0);
    return i.charges[0];
  }
  /// (t, 0, 0), of the effect or constraint that is being added.
  Displacement<S> time() { return {{{clock(), S(1)}}, {}}; }
  /// a - b.
  Displacement<S> difference(const std::string& a, const std::string& b) const {
    Displacement<S> x;
    Vector<S> shift = Vector<S>::Zero(d_);
    bool shifted = false;
    for (const auto& [name, weight] : {std::pair(a, 1), std::pair(b, -1)}) {
      const Displacement<S>& end = place(name).x;
      for (const auto& block : end.blocks) add(block.offset, S(weight) * block.weight, x);
      if (end.shift.size() == 0) continue;
      shift += S(weight) * end.shift;
      shifted = shifted || end.shift != Vector<S>::Zero(d_);
    }
    std::erase_if(x.blocks, [](const auto& block) { return block.weight == 0; });
    if (shifted && !cancels(a, b, shift)) x.shift = shift;
    return x;
  }

 private:
  /// Where a body or point is, by the coordinates.
  struct Place {
    Displacement<S> x;
    Frame<S> frame;
    std::optional<S> mass;  // scalar
    Matrix<S> mass_matrix;  // of a body
    std::optional<S> charge;
    std::string rigid_body = {};  // that it is, or is a point of
    bool moves = false;           // along formulas of t

    /// Whether no force moves it.
    bool is_fixed() const { return moves || x.blocks.empty(); }
  };
  struct RigidBody {
    Displacement<S> reference;
    Frame<S> frame;
    Matrix<S> inertia = {};  // [[m, m c^T], [m c, J]]
  };

  using Names = std::vector<std::string>;

  Problem<S>& problem() { return result_.problem; }

  /// Errors from within say where in the scene they arose.
  void at_line(std::size_t line, const std::string& what, const std::function<void()>& work) {
    current_ = what;
    clock_.reset();
    try {
      work();
    } catch (const InputError& error) {
      throw InputError(at(line) + ": " + what + ": " + error.what());
    }
    lines_.resize(result_.problem.constraints.size(), line);
    wholes_.resize(lines_.size(), whole_);
    whole_.clear();
  }
  void add_named(const auto& things, const std::string& kind) {
    for (const auto& thing : things) at_line(thing.line, kind + " '" + thing.name + "'", [&] { add(thing); });
  }
  void add_numbered(const auto& things, const std::string& kind) {
    number_ = 0;
    for (const auto& thing : things) {
      at_line(thing.line, fmt::format("{} {} ({})", kind, number_ + 1, thing.kind), [&] { add(thing); });
      ++number_;
    }
  }
  std::string at(std::size_t line) const { return scene_.name + (line > 0 ? ":" + std::to_string(line) : ""); }

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
    place.moves = moves(point, scene_.constants);
    if (place.moves)
      place.x.blocks.push_back({static_cast<Index>(first_coordinate(point, scene_)), S(1)});
    else
      place.x.shift = vector(point.position);
    place.frame.start = Matrix<S>::Identity(d_, d_);
    place.charge = number(point.charge);
    places_.emplace(point.name, std::move(place));
  }

  /// \return its first coordinate
  Index add_driven(DrivenPoint<S> point) {
    const Matrix<S> at_start = outputs_of(point.course, Matrix<S>(1, 0), Matrix<S>(Matrix<S>::Zero(1, 1))).leftCols(d_);
    append(positions_, Vector<S>(at_start.row(0).transpose()));
    for (std::vector<S>* const still : {&velocities_, &momenta_}) append(*still, Vector<S>::Zero(d_));
    return problem().add(std::move(point));
  }
  void add_time() {
    if (problem().driven.empty()) add_driven(clock_point<S>("t", d_));
  }
  /// The time that the effect or constraint being added depends on, or that its work is kept by.
  Index clock() {
    add_time();
    if (!clock_) clock_ = add_driven(clock_point<S>(current_, d_));
    return *clock_;
  }
  void add_moving_points() {
    for (const ScenePoint& point : scene_.points) {
      if (!place(point.name).moves) continue;
      add_time();
      at_line(point.line, "point '" + point.name + "'", [&] {
        try {
          add_driven(driven_point<S>("point '" + point.name + "'", point.position, scene_.constants));
        } catch (const ExpressionError& error) {
          throw InputError("'position': " + std::string(error.what()));
        }
      });
    }
  }
  bool is_driven(const Displacement<S>& x) const {
    return std::ranges::any_of(x.blocks,
                               [&](const auto& block) { return block.offset >= result_.problem.mass.of_bodies(); });
  }

  void add(const SceneBody& body) {
    Place place;
    const Index offset = problem().m();
    place.x.blocks.push_back({offset, S(1)});
    place.frame.of = Frame<S>::Of::nothing;
    problem().blocks.push_back({offset, true});
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
    const Matrix<S> moment =
        usable_second_moment<S>({mass, center, symmetric(matrix(body.second_moment), "second_moment")}, body.fixed);
    const Index origin = problem().m();
    // x = r + sum_a X_a d_a: the mass matrix is [[m, m c^T], [m c, J]] times the identity of space, r fixed: J alone.
    const Index first = body.fixed ? 0 : 1, blocks = first + d_;
    Matrix<S> coefficients(blocks, blocks);
    if (!body.fixed) coefficients(0, 0) = mass;
    for (Index a = 0; a < d_; ++a) {
      if (!body.fixed) coefficients(0, a + 1) = coefficients(a + 1, 0) = mass * center[a];
      for (Index b = 0; b < d_; ++b) coefficients(first + a, first + b) = moment(a, b);
    }
    Matrix<S> M = Matrix<S>::Zero(d_ * blocks, d_ * blocks);
    for (Index a = 0; a < blocks; ++a)
      for (Index b = 0; b < blocks; ++b)
        for (Index j = 0; j < d_; ++j) M(d_ * a + j, d_ * b + j) = coefficients(a, b);
    problem().mass.add_full(M);

    const Matrix<S> directors = matrix(body.directors);
    const Vector<S> omega = vector(body.angular_velocity);
    RigidBody rigid{{}, {Frame<S>::Of::rigid_body}};
    rigid.inertia.resize(d_ + 1, d_ + 1);
    rigid.inertia(0, 0) = mass;
    rigid.inertia.bottomRightCorner(d_, d_) = moment;
    for (Index a = 0; a < d_; ++a) rigid.inertia(0, a + 1) = rigid.inertia(a + 1, 0) = mass * center[a];
    rigid.frame.start = directors;
    if (body.fixed) {
      rigid.reference.shift = reference;
    } else {
      rigid.reference.blocks.push_back({origin, S(1)});
      problem().blocks.push_back({origin, true});
      append(positions_, reference);
      append(velocities_, vector(body.velocity));
    }
    for (Index a = 0; a < d_; ++a) {
      const Index offset = origin + d_ * (first + a);
      rigid.frame.directors.push_back(offset);
      const Vector<S> director = directors.row(a).transpose();
      append(positions_, director);
      problem().blocks.push_back({offset, false});
      append(velocities_, turned(omega, director));
      for (Index b = a; b < d_; ++b) {
        const Displacement<S> x{{{offset, S(1)}}, {}}, y{{{origin + d_ * (first + b), S(1)}}, {}};
        ConstraintForms<S> orthonormal = Rod<S>{x, S(1)};
        if (b > a) orthonormal = DisplacementProduct<S>{x, y, S(0)};
        problem().constraints.push_back(
            {"directors " + std::to_string(a + 1) + " and " + std::to_string(b + 1) + " of '" + body.name + "'",
             std::move(orthonormal)});
      }
    }
    append(momenta_, Vector<S>::Zero(d_ * blocks));
    whole_ = "rigid_body '" + body.name + "'";
    // Where effects name the body itself, its centre of mass is meant.
    Place place;
    place.x = point_of(rigid, center);
    place.frame = rigid.frame;
    place.mass = mass;
    place.mass_matrix = Matrix<S>::Identity(d_, d_) * mass;
    place.rigid_body = body.name;
    places_.emplace(body.name, std::move(place));
    rigid_bodies_.emplace(body.name, std::move(rigid));
  }

  /// The point with these components in the frame of a rigid body.
  static Displacement<S> point_of(const RigidBody& body, const Vector<S>& at) {
    Displacement<S> x = body.reference;
    const auto parts = body.frame.direction(at).blocks;
    x.blocks.insert(x.blocks.end(), parts.begin(), parts.end());
    return x;
  }

  void add(const SceneAttachment& attachment) {
    const RigidBody& body = rigid_bodies_.at(attachment.of);
    Place place;
    place.x = point_of(body, vector(attachment.at));
    place.frame = body.frame;
    place.charge = number(attachment.charge);
    place.rigid_body = attachment.of;
    places_.emplace(attachment.name, std::move(place));
  }

  const Place& place(const std::string& name) const { return places_.at(name); }

  /// Adds to the weight of a block, which two points of one body share.
  static void add(Index offset, const S& weight, Displacement<S>& x) {
    for (auto& block : x.blocks) {
      if (block.offset != offset) continue;
      block.weight += weight;
      return;
    }
    x.blocks.push_back({offset, weight});
  }

  /// Whether a point of a rigid body that is fixed in space is another there, but for rounding.
  bool cancels(const std::string& a, const std::string& b, const Vector<S>& difference) const {
    const Place &one = place(a), &other = place(b);
    if (!one.is_fixed() || !other.is_fixed() || (one.rigid_body.empty() && other.rigid_body.empty())) return false;
    const S size = max_norm(one.x.shift) + max_norm(other.x.shift);
    return max_norm(difference) <= consistency_tolerance<S>() * size;
  }

  /// Errors in a formula say where in the file.
  template <class Work>
  auto in_formula(const SceneFormula& formula, const char* key, Work work) const {
    try {
      return work();
    } catch (const ExpressionError& error) {
      // One line, though the reason may quote a formula of several.
      std::string reason = error.reason();
      std::replace(reason.begin(), reason.end(), '\n', ' ');
      throw InputError(std::string("'") + key + "', " + formula.begin.place(formula.expression.text(), error.at()) +
                       ": " + reason);
    }
  }

  void add_constraint(const SceneFormula& formula) {
    std::string name = "formula";
    for (const std::string& of : formula.of) name += (name == "formula" ? " of '" : ", '") + of + "'";
    in_formula(formula, "g", [&] {
      const FormulaBinding<S> binding(formula, d_, scene_.constants);
      FormulaInput<S> input = binding.input();
      input.instances.push_back(binding.instance(formula.of, *this));
      if (auto form = quadratic_form(input)) return add(name, std::move(*form));
      add(name, FormulaConstraint<S>{term_of(input)});
    });
  }

  void add_effect(const SceneEffect& effect, const SceneFormula& formula) {
    in_formula(formula, "U", [&] {
      const FormulaBinding<S> binding(formula, d_, scene_.constants);
      FormulaInput<S> input = binding.input();
      EffectReach reach{acted_on(effect, formula.acts, false)};
      for (const Names& of : reach.on) {
        input.instances.push_back(binding.instance(of, *this));
        if (formula.acts == Acts::about_a_center) input.instances.back().x.front() = difference(of[0], effect.center);
      }
      add(term_of(input), std::move(reach));
    });
  }

  EffectTerm<S> term_of(const FormulaInput<S>& input) {
    EffectTerm<S> term = make_term(input);
    check_formula(input, term, start());
    term.symmetry = formula_symmetry(input, problem().blocks, start());
    return term;
  }

  Vector<S> start() const {
    return Eigen::Map<const Vector<S>>(positions_.data(), static_cast<Index>(positions_.size()));
  }

  void add(const SceneConstraint& c) {
    if (c.formula) return add_constraint(*c.formula);
    ConstraintInput<S> input;
    input.dimension = d_;
    std::string name = c.kind;
    with_constraint_kind<S>(c.kind, [&]<class Kind>() {
      for (const ConstraintKey& key : Kind::keys)
        if (!key.optional || c.has(key.name)) give(c, key, input, name);
      auto made = Kind::from(input);
      if constexpr (requires { made.front().second; }) {
        whole_ = name;
        for (auto& [part, form] : made) add(name + " (" + part + ")", form_of(std::move(form)));
      } else {
        add(name, form_of(std::move(made)));
      }
    });
  }

  void add(const std::string& name, ConstraintForms<S> form) {
    Constraint<S> constraint{name, std::move(form)};
    if (coordinates(constraint, d_).empty()) throw InputError("all its ends are fixed in space");
    problem().constraints.push_back(std::move(constraint));
  }

  /// The value of a key; whom it names is added to the name of the constraint: "rod 'a'-'b'", "plane of 'a'".
  void give(const SceneConstraint& c, const ConstraintKey& key, ConstraintInput<S>& input, std::string& name) const {
    using Takes = ConstraintKey::Takes;
    switch (key.takes) {
      case Takes::pair: {
        const auto& [a, b] = c.pairs.find(key.name)->second;
        input.pairs.emplace(key.name, difference(a, b));
        input.frames.emplace(key.name, std::array{place(a).frame, place(b).frame});
        name += (name == c.kind ? " '" : ", '") + a + "'-'" + b + "'";
        break;
      }
      case Takes::body: {
        const std::string& body = c.bodies.find(key.name)->second;
        input.bodies.emplace(key.name, place(body).x);
        name += (name == c.kind ? " of '" : ", '") + body + "'";
        break;
      }
      case Takes::number:
        input.numbers.emplace(key.name, number(c.numbers.find(key.name)->second));
        break;
      case Takes::vector:
        input.vectors.emplace(key.name, vector(c.vectors.find(key.name)->second));
        break;
      case Takes::symmetric_matrix:
        input.matrices.emplace(key.name, symmetric(matrix(c.matrices.find(key.name)->second), std::string(key.name)));
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
    if (effect.formula) return add_effect(effect, *effect.formula);
    if (with_force(effect.kind, effect.is_mutual(), [&]<class Force>() { add_force<Force>(effect); })) return;
    EffectInput<S> input;
    input.kind = effect.kind;
    input.dimension = d_;
    for (const auto& [key, e] : effect.numbers) input.numbers.emplace(key, number(e));
    for (const auto& [key, e] : effect.vectors) {
      const Vector<S> v = vector(e);
      input.vectors.emplace(key, std::vector<S>(v.begin(), v.end()));
    }
    with_effect(effect.kind, [&]<class Effect>() {
      EffectReach reach{acted_on(effect, Effect::acts, Effect::needs_charge)};
      for (const Names& names : reach.on) input.instances.push_back(instance<Effect>(effect, names));
      add(make_term(input), std::move(reach));
    });
  }

  void add(EffectTerm<S> term, EffectReach reach) {
    reach.effect = number_;
    // Of a driven coordinate it is to be multiplied by a velocity.
    term.constant_force =
        term.constant_force && !std::ranges::any_of(term.displacements, [&](const auto& x) { return is_driven(x); });
    problem().potential.terms.push_back(std::move(term));
    result_.reach.push_back(std::move(reach));
  }

  /// The directors of a rigid body.
  void append_directors(const std::string& body, std::vector<Displacement<S>>& to) const {
    for (const Index offset : place(body).frame.directors) to.push_back({{{offset, S(1)}}, {}});
  }

  /// Whom a force acts on.
  std::vector<Names> acted_on(const SceneEffect& effect, ForceOn on) const {
    if (!effect.of.empty()) return {effect.of};
    if (on == ForceOn::pair) return pairs(effect, false);
    if (on == ForceOn::rigid_bodies) return {{effect.between->front().first, effect.between->front().second}};
    std::vector<Names> result;
    const auto add = [&](const std::string& name, bool named_alone) {
      const bool named = effect.on && std::count(effect.on->begin(), effect.on->end(), name) > 0;
      if (effect.on ? !named : named_alone) return;
      const bool uncharged = on == ForceOn::charged_body && !place(name).charge;
      const bool held = on == ForceOn::each_body && place(name).is_fixed();
      if (effect.on && (uncharged || held))
        throw InputError("'" + name + "' " + (uncharged ? "has no charge" : "is fixed in space" + how(name)));
      if (!uncharged && !held) result.push_back({name});
    };
    for (const SceneBody& body : scene_.bodies) add(body.name, false);
    for (const SceneRigidBody& body : scene_.rigid_bodies) add(body.name, false);
    for (const SceneAttachment& attachment : scene_.attachments) add(attachment.name, on != ForceOn::charged_body);
    if (result.empty()) throw InputError("it acts on nobody");
    return result;
  }

  /// The displacements that a force on these depends on, and the parameters that it needs.
  typename ForceInput<S>::Instance force_instance(ForceOn on, const Names& of) const {
    typename ForceInput<S>::Instance instance;
    if (on == ForceOn::rigid_body || on == ForceOn::rigid_bodies) {
      for (const std::string& body : of) append_directors(body, instance.x);
    } else if (on == ForceOn::pair) {
      instance.x.push_back(difference(of[0], of[1]));
    } else if (on == ForceOn::inertia && rigid_bodies_.contains(of[0])) {
      const RigidBody& body = rigid_bodies_.at(of[0]);
      instance.x.push_back(body.reference);
      append_directors(of[0], instance.x);
      for (Index i = 0; i < body.inertia.size(); ++i) instance.parameters.push_back(body.inertia.data()[i]);
    } else {
      for (const std::string& name : of) instance.x.push_back(place(name).x);
      if (on == ForceOn::inertia) instance.parameters.push_back(mass(of[0]));
      if (on == ForceOn::charged_body) instance.parameters.push_back(charge(of[0]));
    }
    return instance;
  }

  template <class Force>
  void add_force(const SceneEffect& effect) {
    EffectReach reach{acted_on(effect, Force::on), number_};
    ForceInput<S> all{effect.kind, current_, effect.is_mutual(), d_, 1, 1, scene_.constants, effect.formulas};
    for (const Names& of : reach.on) all.instances.push_back(force_instance(Force::on, of));
    FormulaNames used;
    for (const ForceKey& key : Force::keys)
      for (const Expression& formula : effect.formulas.find(key.name)->second)
        used.merge(names_used(formula, force_names(effect.of, key.local, static_cast<int>(d_)), scene_.constants));
    // Forces on bodies with an inertia of another form are apart.
    std::vector<std::vector<typename ForceInput<S>::Instance>> alike;
    std::vector<std::vector<Names>> whom;
    for (std::size_t n = 0; n < reach.on.size(); ++n) {
      const auto like = std::ranges::find_if(
          alike, [&](const auto& list) { return list.front().x.size() == all.instances[n].x.size(); });
      const auto at = static_cast<std::size_t>(like - alike.begin());
      if (like == alike.end()) {
        alike.emplace_back();
        whom.emplace_back();
      }
      alike[at].push_back(all.instances[n]);
      whom[at].push_back(reach.on[n]);
    }
    for (std::size_t n = 0; n < alike.size(); ++n) {
      ForceInput<S> input = all;
      input.instances = alike[n];
      complete(input, used, whom[n], effect);
      if (auto term = potential_beside(input)) add(std::move(*term), EffectReach{whom[n]});
      ForceTerm<S> force = make_force(input);
      if (Force::works) force.account = clock();
      check_force(force);
      problem().forces.push_back(std::move(force));
    }
    result_.force_reach.push_back(std::move(reach));
  }

  /// What the names of a force's formulas stand for, and the values of those that are parameters.
  void complete(ForceInput<S>& input, const FormulaNames& used, const std::vector<Names>& whom,
                const SceneEffect& effect) {
    input.acting = static_cast<Index>(input.instances.front().x.size());
    const bool timed =
        std::ranges::any_of(used, [](const auto& name) { return name.second.is == FormulaName::Is::time; });
    if (timed)
      for (auto& instance : input.instances) instance.x.push_back(time());
    if (timed && effect.kind == RotatingFrame::kind) throw InputError("the frame turns at a constant rate, without t");
    input.arguments = static_cast<Index>(input.instances.front().x.size());
    input.parameters = input.instances.front().parameters.size();
    for (const auto& [name, is] : used) {
      using Is = FormulaVariable::Is;
      const auto d = static_cast<std::size_t>(d_);
      const auto input_at = [&](std::size_t place) { return FormulaVariable{Is::input, place}; };
      switch (is.is) {
        case FormulaName::Is::time:
          input.variables[name] = input_at(static_cast<std::size_t>(input.acting) * d);
          break;
        case FormulaName::Is::coordinate:
          input.variables[name] = input_at(is.place * d + is.axis);
          break;
        case FormulaName::Is::velocity:
          input.variables[name] = input_at((static_cast<std::size_t>(input.arguments) + is.place) * d + is.axis);
          break;
        default:
          input.variables[name] = {Is::parameter, input.parameters++};
          for (std::size_t n = 0; n < whom.size(); ++n)
            input.instances[n].parameters.push_back(is.is == FormulaName::Is::mass ? mass(whom[n][is.place])
                                                                                   : charge(whom[n][is.place]));
      }
    }
  }

  /// Refuses a force that has no value at the start.
  void check_force(const ForceTerm<S>& term) const {
    ForceInputs<S> inputs(term, d_, 1);
    Vector<S> v = Vector<S>::Zero(static_cast<Index>(velocities_.size()));
    const Vector<S> p = Eigen::Map<const Vector<S>>(momenta_.data(), v.size());
    result_.problem.mass.velocity(lanes(p), lanes(v));
    v += Eigen::Map<const Vector<S>>(velocities_.data(), v.size());
    const Vector<S> q = start();
    inputs.update(lanes(q), lanes(std::as_const(v)));
    const Matrix<S> F = outputs_of(term.force, term.force_coefficients, inputs.values());
    for (Index i = 0; i < F.size(); ++i)
      if (!is_finite(F.data()[i])) throw InputError("the force has no value at the start");
  }

  template <class Effect>
  typename EffectInput<S>::Instance instance(const SceneEffect& effect, const Names& names) const {
    typename EffectInput<S>::Instance i;
    i.mass_matrix = Matrix<S>::Zero(d_, d_);
    const Place& first = place(names[0]);
    if constexpr (Effect::acts == Acts::between_pairs) {
      i.x = difference(names[0], names[1]);
    } else {
      i.x = Effect::acts == Acts::about_a_center ? difference(names[0], effect.center) : first.x;
      if (first.mass_matrix.size() > 0) i.mass_matrix = first.mass_matrix;
    }
    for (std::size_t end = 0; end < names.size(); ++end)
      give(names[end], Effect::needs_mass, Effect::needs_charge, i, static_cast<int>(end));
    return i;
  }

  /// The bodies, pairs or groups that an effect names, or all: a rigid body counts as a body, at its centre of mass.
  std::vector<Names> acted_on(const SceneEffect& effect, Acts acts, bool charged) const {
    std::vector<Names> result;
    if (acts == Acts::on_group) {
      result = {effect.formula->of};
    } else if (acts == Acts::between_pairs) {
      result = pairs(effect, charged);
    } else {
      const auto add = [&](const std::string& name) {
        if (effect.on && std::count(effect.on->begin(), effect.on->end(), name) == 0) return;
        if (acts == Acts::about_a_center && place(name).is_fixed()) {
          if (effect.on) throw InputError("'" + name + "' is fixed in space" + how(name));
          return;
        }
        result.push_back({name});
      };
      for (const SceneBody& body : scene_.bodies) add(body.name);
      for (const SceneRigidBody& body : scene_.rigid_bodies) add(body.name);
      if (effect.on && acts == Acts::about_a_center)
        for (const SceneAttachment& attachment : scene_.attachments) add(attachment.name);
    }
    if (!result.empty()) return result;
    std::string why;
    for (const auto& [name, reason] : left_out(scene_, effect, {}))
      why += (why.empty() ? ": not on '" : ", nor on '") + name + "' (" + reason + ")";
    throw InputError("it acts on nobody" + why);
  }

  /// How a place is fixed in space.
  std::string how(const std::string& name) const {
    return rigid_bodies_.contains(name) ? ", by its centre of mass" : "";
  }

  void give(const std::string& name, bool mass, bool charge, typename EffectInput<S>::Instance& i, int end) const {
    const Place& p = place(name);
    if (mass && !p.mass)
      throw InputError("'" + name + "' has " + (p.mass_matrix.size() > 0 ? "a mass matrix" : "no mass") +
                       "; a scalar mass is needed");
    if (mass) i.masses[end] = *p.mass;
    if (charge && !p.charge)
      throw InputError("'" + name + "' has no charge" +
                       (rigid_bodies_.contains(name) ? "; give one to a point of it, an [[attachment]]" : ""));
    if (charge) i.charges[end] = *p.charge;
  }

  /// The pairs an effect names, or all: of bodies, and for charges of whatever has one.
  std::vector<Names> pairs(const SceneEffect& effect, bool charged) const {
    std::vector<Names> result;
    const auto fixed = [&](const std::string& a, const std::string& b) {
      return place(a).is_fixed() && place(b).is_fixed();
    };
    if (effect.between) {
      for (const auto& [a, b] : *effect.between) {
        if (fixed(a, b)) throw InputError("'" + a + "' and '" + b + "' are both fixed in space");
        result.push_back({a, b});
      }
      return result;
    }
    Names names;
    for (const SceneBody& body : scene_.bodies)
      if (!charged || body.charge) names.push_back(body.name);
    for (const SceneRigidBody& body : scene_.rigid_bodies)
      if (!charged) names.push_back(body.name);
    for (const SceneAttachment& attachment : scene_.attachments)
      if (charged && attachment.charge) names.push_back(attachment.name);
    for (const ScenePoint& point : scene_.points)
      if (charged && point.charge) names.push_back(point.name);
    const auto together = [&](const std::string& a, const std::string& b) {
      return !place(a).rigid_body.empty() && place(a).rigid_body == place(b).rigid_body;
    };
    for (std::size_t a = 0; a < names.size(); ++a)
      for (std::size_t b = a + 1; b < names.size(); ++b)
        if (!fixed(names[a], names[b]) && !together(names[a], names[b])) result.push_back({names[a], names[b]});
    return result;
  }

  static void append(std::vector<S>& all, const Vector<S>& part) { all.insert(all.end(), part.begin(), part.end()); }

  void initial_state() {
    const Index m = problem().m();
    result_.q0 = Eigen::Map<const Vector<S>>(positions_.data(), m);
    result_.p0 = problem().mass.momentum(Eigen::Map<const Vector<S>>(velocities_.data(), m)) +
                 Eigen::Map<const Vector<S>>(momenta_.data(), m);
  }

  /// What the start breaks the constraints by, over the sizes of the terms, which round-off is proportional to.
  struct Residuals {
    Vector<S> v;     // the velocities
    Vector<S> g, w;  // of positions and velocities
    Vector<S> of_g, of_w;
    Vector<S> squares;  // of the gradients in the metric M^-1
    Vector<S> gradients;

    bool are_within(const S& tolerance) const {
      for (Index a = 0; a < g.size(); ++a)
        if (!(magnitude(g[a]) <= tolerance * of_g[a] && magnitude(w[a]) <= tolerance * of_w[a])) return false;
      return true;
    }
  };
  Residuals residuals() {
    const Problem<S>& p = problem();
    const Index nu = p.nu();
    Residuals r{Vector<S>(p.m()), Vector<S>(nu), Vector<S>(nu), Vector<S>(nu),
                Vector<S>(nu),    Vector<S>(nu), Vector<S>(nu)};
    p.mass.velocity(lanes(result_.p0), lanes(r.v));
    DrivenCourse<S> course(p, 1);
    hbvm::core::place(course, p, result_.q0);
    course.set_velocities(lanes(r.v));
    // The velocity of a coordinate carries the round-off of its block's momenta.
    S speed = max_norm(r.v);
    for (const auto& block : p.mass.blocks())
      if (block.full)
        for (Index j = 0; j < block.size; ++j) {
          S sum = 0;
          for (Index l = 0; l < block.size; ++l) sum += magnitude(S(block.W(j, l) * result_.p0[block.offset + l]));
          raise_to(speed, sum);
        }
    ConstraintGradient<S> gradient(p, 1);
    gradient.update(lanes(result_.q0));
    S product;
    gradient.for_each_own_coupling(Index{1}, &product, [&](Index a, Index b, const auto& at) {
      if (a == b) set(r.squares[a], at(0, 0));
    });
    for (Index a = 0; a < nu; ++a) {
      const Constraint<S>& constraint = p.constraints[static_cast<std::size_t>(a)];
      const auto at_start = value(constraint, d_, result_.q0);
      r.g[a] = at_start.g;
      r.of_g[a] = at_start.size;
      gradient.transposed_times(a, lanes(std::as_const(r.v)), &r.w[a]);
      r.gradients[a] = gradient_size(constraint, d_, result_.q0);
      r.of_w[a] = speed * r.gradients[a];
    }
    return r;
  }

  void check_consistency() {
    const Problem<S>& p = problem();
    if (p.nu() == 0) return;
    S tolerance = consistency_tolerance<S>();
    Residuals start = residuals();
    if (!start.are_within(tolerance)) {
      // Beyond its own digits it is told what those do not explain.
      const S own = tolerance / epsilon<S>() * own_precision<S>(scene_);
      if (!start.are_within(own))
        tolerance = own;
      else if (settle(start))
        start = residuals();
    }
    const Independence<S> independence = find_independent(p, result_.q0, start.v);
    for (const Dependence<S>& dependence : independence.redundant) check_agreement(dependence);
    for (Index a = 0; a < p.nu(); ++a) {
      report(a, "position", start.g[a], S(tolerance * start.of_g[a]));
      report(a, "velocity", start.w[a], S(tolerance * start.of_w[a]));
      check_range(a, start.squares[a], start.gradients[a]);
    }
    for (const Dependence<S>& dependence : independence.redundant) check_bending(dependence);
    check_angle(independence);
    if (independence.redundant.empty()) return;
    list_redundant(independence.redundant);
    set_aside(problem(), independence);
  }

  /// Moves a start that is consistent to the digits it is written with to the nearest one that is so in S.
  bool settle(const Residuals& start) {
    using std::sqrt;
    const S own = own_precision<S>(scene_);
    if (own <= epsilon<S>()) return false;
    try {
      Problem<S> independent = problem();
      set_aside(independent, find_independent(problem(), result_.q0, start.v, own));
      const Vector<S> q = nearest_position(independent, result_.q0);
      const S moved = max_norm(Vector<S>(q - result_.q0));
      if (!(moved <= sqrt(own) * max_norm(q))) return false;
      result_.p0 = StateEvaluator<S>(independent).tangential(q, result_.p0);
      result_.q0 = q;
      result_.settled = fmt::format("consistent to its own {} digits; moved by up to {} to where the constraints hold",
                                    own_digits(scene_), to_scientific(moved, 3));
      return true;
    } catch (const Error&) {
      return false;  // the check says what is wrong
    }
  }

  /// The file and the line that made a constraint.
  std::string where(Index a) const { return at(lines_[static_cast<std::size_t>(a)]); }
  std::string name(Index a) const {
    return "constraint " + std::to_string(a + 1) + " (" +
           result_.problem.constraints[static_cast<std::size_t>(a)].name + ")";
  }
  /// The joint or rigid body that a constraint is a part of; empty if it is a whole one.
  const std::string& whole(Index a) const { return wholes_[static_cast<std::size_t>(a)]; }
  /// Joints and rigid bodies once.
  std::vector<std::string> names(const std::vector<Index>& constraints) const {
    std::vector<std::string> result;
    for (const Index a : constraints) {
      std::string text = whole(a).empty() ? name(a) : whole(a);
      if (std::find(result.begin(), result.end(), text) == result.end()) result.push_back(std::move(text));
    }
    return result;
  }
  std::string list(const std::vector<Index>& constraints) const { return listed(names(constraints)); }

  /// Those of one joint together.
  void list_redundant(const std::vector<Dependence<S>>& redundant) {
    for (auto first = redundant.begin(); first != redundant.end();) {
      const std::string& of = whole(first->constraint);
      const auto last = std::find_if(first + 1, redundant.end(), [&](const Dependence<S>& next) {
        return of.empty() || whole(next.constraint) != of;
      });
      std::vector<Index> others;
      std::string numbers;
      for (auto one = first; one != last; ++one) {
        others.insert(others.end(), one->others.begin(), one->others.end());
        numbers += (one == first ? "" : one + 1 == last ? " and " : ", ") + std::to_string(one->constraint + 1);
      }
      std::sort(others.begin(), others.end());
      result_.redundant.push_back(
          {last == first + 1 ? name(first->constraint) : "constraints " + numbers + " (" + of + ")", names(others)});
      first = last;
    }
  }

  /// Contradictory constraints leave no state at all, and one whose gradient vanishes has no multiplier.
  void check_agreement(const Dependence<S>& dependence) const {
    const std::string who = where(dependence.constraint) + ": " + name(dependence.constraint) + " is ",
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
    throw InputError(where(dependence.constraint) + ": " + name(dependence.constraint) +
                     " is contradictory: at the start its gradient is a combination of those of " +
                     list(dependence.others) + ", but along the initial velocity its second derivative is " +
                     to_scientific(dependence.bending, 3) + " where they hold, tolerance " +
                     to_scientific(dependence.round_off, 3));
  }

  /// Below an angle of sqrt(epsilon) the multipliers have no digit.
  void check_angle(const Independence<S>& independence) const {
    using std::sqrt;
    if (independence.square_of_sine > epsilon<S>()) return;
    throw InputError(
        where(independence.nearest) +
        ": the Gram matrix of the constraints is singular to this precision at the start: " + "the gradient of " +
        name(independence.nearest) + " is a combination of those of " + list(independence.near) +
        " but for an angle of " + to_scientific(S(sqrt(independence.square_of_sine)), 3) + "; take more digits");
  }

  /// What is solved for the multipliers has the squares of the gradients, whose digits the range of S must leave whole.
  void check_range(Index a, const S& square, const S& size) const {
    if (is_finite(square) && (square == 0) == (size == 0) && (size == 0 || S(square * epsilon<S>()) != 0)) return;
    throw InputError(where(a) + ": the gradient of " + name(a) + " at the start is of size " + to_scientific(size, 3) +
                     ", and its square over the masses is beyond the range of this precision; multiply g or the units "
                     "by a number that brings it closer to 1");
  }

  static std::string precision() {
    if constexpr (std::same_as<S, double>) return "double";
    if constexpr (std::same_as<S, Quad>) return "quad";
    return "mpfr:" + std::to_string(digits10<S>());
  }

  void report(Index a, const std::string& what, const S& residual, const S& tolerance) const {
    if (magnitude(residual) <= tolerance) return;
    throw InputError(where(a) + ": the initial " + what + " is not consistent with " + name(a) + ": residual " +
                     to_scientific(residual, 3) + ", tolerance " + to_scientific(tolerance, 3) +
                     " at this precision; `hbvm scene project --precision " + precision() +
                     "` writes the nearest scene that is");
  }

  const Scene& scene_;
  Index d_;
  Assembled<S> result_;
  std::map<std::string, Place> places_;
  std::vector<S> positions_, velocities_, momenta_;
  std::string current_;         ///< what is being added
  std::optional<Index> clock_;  ///< its own, if it has one
  std::size_t number_ = 0;      ///< its place among effects or constraints, from 0
  std::map<std::string, RigidBody> rigid_bodies_;
  std::vector<std::size_t> lines_;   ///< of the constraints
  std::vector<std::string> wholes_;  ///< of the constraints: the joint or rigid body they are parts of
  std::string whole_;                ///< of those being added
};

}  // namespace

std::string to_text(const Redundancy& redundancy) {
  const bool several = redundancy.name.starts_with("constraints ");
  return redundancy.name + (several ? " follow from " : " follows from ") + listed(redundancy.others);
}

template <Scalar S>
Assembled<S> assemble(const Scene& scene, Consistency consistency) {
  require_working_digits<S>();
  return Assembler<S>(scene).assemble(consistency);
}

#define HBVM_DEFINE(S) template Assembled<S> assemble<S>(const Scene&, Consistency);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
