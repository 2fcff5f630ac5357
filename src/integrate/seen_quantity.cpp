#include "integrate/seen_quantity.hpp"

#include <fmt/format.h>

#include <cmath>

#include "integrate/constraint_moment.hpp"
#include "integrate/support_force.hpp"
#include "integrate/work_done.hpp"
#include "linear/product.hpp"
#include "nearest.hpp"
#include "problem/redundant_constraints.hpp"
#include "problem/state_evaluator.hpp"
#include "scene/places.hpp"

namespace hbvm::core {
namespace {

/// A vector of space along the motion, and how it changes.
template <Scalar S>
struct SeenVector {
  std::function<Vector<S>(const SeenState<S>&)> now, rate;
};

/// a x b; in the plane its only component.
template <Scalar S>
Vector<S> cross(const Vector<S>& a, const Vector<S>& b) {
  if (a.size() == 2) return Vector<S>::Constant(1, S(a[0] * b[1] - a[1] * b[0]));
  Vector<S> result(3);
  for (Index i = 0; i < 3; ++i) {
    const Index j = (i + 1) % 3, k = (i + 2) % 3;
    result[i] = a[j] * b[k] - a[k] * b[j];
  }
  return result;
}

template <Scalar S>
S length(const Vector<S>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

/// How fast a vector of the plane turns.
template <Scalar S>
S turning(const SeenVector<S>& u, const SeenState<S>& state) {
  const Vector<S> now = u.now(state);
  return cross(now, u.rate(state))[0] / dot(now, now);
}

/// "f(a, b)" is f and {"a", "b"}. A name may have brackets with commas in them: bar[1, 0].
std::vector<std::string> parts_of_call(const std::string& name) {
  const std::size_t open = name.find('(');
  std::vector<std::string> parts{name.substr(0, open), ""};
  int depth = 0;
  for (std::size_t i = open + 1; i + 1 < name.size(); ++i) {
    const char c = name[i];
    depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
    if (depth == 0 && c == ',') {
      parts.emplace_back();
      ++i;  // the blank that follows
    } else {
      parts.back() += c;
    }
  }
  if (parts.size() == 2 && parts.back().empty()) parts.pop_back();
  return parts;
}

}  // namespace

template <Scalar S>
class SeenQuantities<S>::Names {
 public:
  using State = SeenState<S>;
  using Quantity = SeenQuantity<S>;
  using Along = SeenVector<S>;

  Names(const Scene& scene, const Problem<S>& problem)
      : scene_(scene),
        problem_(problem),
        d_(scene.dimension),
        places_(places_of<S>(scene)),
        constraints_(all_constraints(problem)) {
    for (const auto& [name, unused] : places_) bodies_.push_back(name);
    for (const SceneRigidBody& body : scene.rigid_bodies)
      for (std::size_t i = 1; i <= body.directors.size(); ++i) {
        directors_[body.name].push_back(body.name + ".d" + std::to_string(i));
        std::erase(bodies_, directors_[body.name].back());
      }
    for (const SceneBody& body : scene.bodies) movers_.push_back(body.name);
    for (const SceneRigidBody& body : scene.rigid_bodies) movers_.push_back(body.name);
  }

  Quantity named(const std::string& name) const {
    if (name.find('(') != std::string::npos) return call(parts_of_call(name));
    if (name == "t") return {[](const State& state) { return state.t; }};
    const std::size_t point = name.rfind('.');
    if (point == std::string::npos)
      throw InputError("there is no '" + name + "'; there are t, coordinates as " + bodies_.front() +
                       ".x, and the quantities " + list_of_functions());
    return component(name.substr(0, point), name.substr(point + 1));
  }

 private:
  using Arguments = std::vector<std::string>;

  static std::string list_of_functions() {
    std::string list;
    for (const std::string& name : functions()) list += (list.empty() ? "" : ", ") + name;
    return list;
  }
  static const std::vector<std::string>& functions() {
    static const std::vector<std::string> names{"distance", "speed",     "angle",   "rate",  "omega",  "kinetic",
                                                "energy",   "potential", "tension", "force", "torque", "slide",
                                                "work",     "power",     "x",       "y",     "z",      "vx",
                                                "vy",       "vz",        "px",      "py",    "pz"};
    return names;
  }

  Quantity call(const Arguments& parts) const {
    const std::string& f = parts.front();
    const Arguments of(parts.begin() + 1, parts.end());
    const auto expect = [&](std::size_t least, std::size_t most, const char* form) {
      if (of.size() < least || of.size() > most) throw InputError(fmt::format("'{}' is {}", f, form));
    };
    if (f == "distance") {
      expect(2, 2, "distance(a, b)");
      return {[u = way(of[0], of[1])](const State& state) { return length(u.now(state)); }};
    }
    if (f == "speed") {
      expect(1, 1, "speed(a)");
      return {[u = place(of[0])](const State& state) { return length(u.rate(state)); }};
    }
    if (d_ == 1 && (f == "angle" || f == "rate" || f == "omega"))
      throw InputError("'" + f + "' is of a plane or of space, and the scene has dimension = 1");
    if (f == "angle") {
      expect(1, 2, "angle(a.d1), angle(a, b) or angle(a.d1, b.d1)");
      return angle(of);
    }
    if (f == "rate") {
      expect(1, 2, "rate(a.d1), rate(a, b) or rate(a.d1, b.d1)");
      if (d_ == 3) throw InputError("'rate' is of an angle in the plane; in space there is omega(a, z)");
      return {angle(of).rate};
    }
    if (f == "omega") {
      expect(d_ == 2 ? 1 : 2, d_ == 2 ? 1 : 2,
             d_ == 2 ? "omega(a)" : "omega(a, z) or omega(a, a.d3): along a direction");
      return omega(of);
    }
    if (f == "kinetic") {
      expect(0, 1, "kinetic(a), or kinetic() of all");
      return of.empty() ? Quantity{[](const State& state) { return state.T; }} : kinetic(of[0]);
    }
    if (f == "energy") {
      expect(0, 0, "energy()");
      return {[](const State& state) { return state.H; }};
    }
    if (f == "potential") {
      expect(0, 0, "potential()");
      return {[](const State& state) { return S(state.H - state.T); }};
    }
    if (f == "tension") {
      expect(2, 2, "tension(a, b)");
      return tension(of[0], of[1]);
    }
    if (f == "force") {
      expect(2, 3,
             "force(a, b, x): on a, along a direction; or force(a, x) of what holds a rigid body where it is fixed");
      return of.size() == 2 ? support(of[0], direction(of[1])) : force(of[0], of[1], direction(of[2]));
    }
    if (f == "torque") {
      expect(d_ == 2 ? 2 : 3, d_ == 2 ? 2 : 3,
             d_ == 2 ? "torque(a, b): of what holds a rigid body at a, on it"
                     : "torque(a, b, z): of what holds a rigid body at a, on it and along a direction");
      return torque(of);
    }
    if (f == "work" || f == "power") {
      expect(0, 1, (f + "(a) of an effect, a constraint or a moving point, or " + f + "() of all").c_str());
      return f == "work" ? work(of) : power(of);
    }
    if (f == "slide") {
      expect(2, 2, "slide(a, b): how far b is from a along their joint");
      return slide(of[0], of[1]);
    }
    if (std::find(functions().begin(), functions().end(), f) == functions().end())
      throw InputError("there is no quantity '" + f + "'" + did_you_mean_or_list(f, functions()));
    expect(1, 1, (f + "(a)").c_str());
    return component(of[0], f);
  }

  const Displacement<S>& displacement(const std::string& name) const {
    const auto found = places_.find(name);
    if (found == places_.end())
      throw InputError("there is no body or point '" + name + "'" + did_you_mean_or_list(name, others_like(name)));
    return found->second;
  }

  /// The points of the body that a name is a point of, as a[1, 0]; else all that has a place.
  std::vector<std::string> others_like(const std::string& name) const {
    std::vector<std::string> points;
    const std::size_t bracket = name.find('[');
    if (bracket != std::string::npos)
      for (const std::string& other : bodies_)
        if (other.starts_with(name.substr(0, bracket + 1))) points.push_back(other);
    return points.empty() ? bodies_ : points;
  }

  /// The rods and joints of the bodies of a and b, "a[1, 0], b[0, 0]"; of all bodies if those have none.
  std::string pairs_of(const std::string& a, const std::string& b) const {
    const auto body_of = [](const std::string& name) { return name.substr(0, name.find('[')); };
    std::vector<std::string> near, all;
    for (const Constraint<S>& constraint : constraints_) {
      const std::string& name = constraint.name;
      const std::size_t first = name.find(" '"), middle = name.find("'-'"), last = name.find('\'', middle + 3);
      if (first == std::string::npos || middle == std::string::npos || last == std::string::npos) continue;
      const std::string one = name.substr(first + 2, middle - first - 2),
                        other = name.substr(middle + 3, last - middle - 3);
      const std::string pair = one + " and " + other;
      if (std::find(all.begin(), all.end(), pair) != all.end()) continue;
      all.push_back(pair);
      for (const std::string& end : {one, other})
        if ((body_of(end) == body_of(a) || body_of(end) == body_of(b)) && (near.empty() || near.back() != pair))
          near.push_back(pair);
    }
    std::string list;
    for (const std::string& pair : near.empty() ? all : near) list += (list.empty() ? "" : "; ") + pair;
    return list;
  }

  Along place(const std::string& name) const {
    const Displacement<S>& x = displacement(name);
    return {[x, d = d_](const State& state) { return displaced(x, d, state.q); },
            [x, d = d_](const State& state) { return moved(x, d, state.v); }};
  }
  /// From a to b.
  Along way(const std::string& a, const std::string& b) const {
    const Along from = place(a), to = place(b);
    return {[=](const State& state) { return Vector<S>(to.now(state) - from.now(state)); },
            [=](const State& state) { return Vector<S>(to.rate(state) - from.rate(state)); }};
  }

  bool is_direction(const std::string& name) const {
    for (const auto& [body, directors] : directors_)
      if (std::find(directors.begin(), directors.end(), name) != directors.end()) return true;
    return !places_.contains(name) && axis_of(name) >= 0;
  }
  /// 0 for "x"; -1 for what is no axis.
  Index axis_of(const std::string& name) const {
    const std::size_t axis = std::string("xyz").substr(0, static_cast<std::size_t>(d_)).find(name);
    return name.size() == 1 && axis != std::string::npos ? static_cast<Index>(axis) : -1;
  }
  Along direction(const std::string& name) const {
    if (!is_direction(name))
      throw InputError("'" + name + "' is no direction" +
                       (name.starts_with("angle(") ? ", and rate() takes what angle() takes, as rate(a, b)" : "") +
                       "; there are " +
                       (d_ == 1   ? "x"
                        : d_ == 2 ? "x, y"
                                  : "x, y, z") +
                       " of space and the directors of rigid bodies, as a.d1");
    if (places_.contains(name)) return place(name);
    const Vector<S> unit = Vector<S>::Unit(d_, axis_of(name));
    return {[unit](const State&) { return Vector<S>(unit); },
            [unit](const State&) { return Vector<S>::Zero(unit.size()); }};
  }

  /// \param what "x", "vx" or "px"
  Quantity component(const std::string& owner, const std::string& what) const {
    const Displacement<S>& x = displacement(owner);
    const Index axis = axis_of(what.substr(what.size() - 1));
    const std::string of = what.substr(0, what.size() - 1);
    if (axis < 0 || (!of.empty() && of != "v" && of != "p"))
      throw InputError("'" + owner + "' has no '" + what + "'; it has " +
                       (d_ == 1   ? "x, vx, px"
                        : d_ == 2 ? "x, y, vx, vy, px, py"
                                  : "x, y, z, vx, vy, vz, px, py, pz"));
    if (of != "p") {
      const Along u = place(owner);
      return {[u, axis, velocity = of == "v"](const State& state) {
        return S((velocity ? u.rate(state) : u.now(state))[axis]);
      }};
    }
    if (x.blocks.size() != 1 || x.shift.size() > 0)
      throw InputError("'" + owner + "' has no momentum of its own: it is a fixed point, or a point of a rigid body");
    return {[at = x.blocks.front().offset + axis](const State& state) { return state.p[at]; }};
  }

  Quantity angle(const Arguments& of) const {
    if (of.size() == 1) {
      if (d_ == 3) throw InputError("in space an angle is between two directions: angle(a.d3, z)");
      return against_x(direction(of[0]));
    }
    if (!is_direction(of[0]) || !is_direction(of[1])) {
      if (d_ == 3)
        throw InputError("in space an angle is between two directions, each x, y, z or a director, as angle(a.d3, z)");
      return against_x(way(of[0], of[1]));
    }
    const Along u = direction(of[0]), v = direction(of[1]);
    const auto value = [=](const State& state) {
      using std::atan2;
      const Vector<S> a = u.now(state), b = v.now(state), across = cross(a, b);
      return S(atan2(across.size() == 1 ? across[0] : length(across), dot(a, b)));
    };
    if (d_ == 3) return {value};
    return {value, [=](const State& state) { return S(turning(v, state) - turning(u, state)); }};
  }
  static Quantity against_x(const Along& u) {
    return {[u](const State& state) {
              using std::atan2;
              const Vector<S> now = u.now(state);
              return S(atan2(now[1], now[0]));
            },
            [u](const State& state) { return turning(u, state); }};
  }

  const Arguments& directors(const std::string& body) const {
    const auto found = directors_.find(body);
    if (found != directors_.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [name, unused] : directors_) names.push_back(name);
    throw InputError("there is no rigid body '" + body + "'" + did_you_mean_or_list(body, names));
  }

  /// 1/2 sum_i d_i x d_i' in space.
  Quantity omega(const Arguments& of) const {
    std::vector<Along> frame;
    for (const std::string& director : directors(of[0])) frame.push_back(place(director));
    if (d_ == 2) return {[u = frame.front()](const State& state) { return turning(u, state); }};
    return {[frame, along = direction(of[1])](const State& state) {
      Vector<S> twice = Vector<S>::Zero(3);
      for (const Along& u : frame) twice += cross(u.now(state), u.rate(state));
      return S(dot(twice, along.now(state)) / 2);
    }};
  }

  Quantity kinetic(const std::string& body) const {
    if (std::find(movers_.begin(), movers_.end(), body) == movers_.end())
      throw InputError("there is no body '" + body + "'" + did_you_mean_or_list(body, movers_));
    std::vector<Index> offsets;
    const auto add = [&](const std::string& name) {
      for (const auto& block : places_.find(name)->second.blocks) offsets.push_back(block.offset);
    };
    add(body);
    if (const auto rigid = directors_.find(body); rigid != directors_.end())
      for (const std::string& director : rigid->second) add(director);
    return {[offsets, d = d_](const State& state) {
      S twice = 0;
      for (const Index offset : offsets)
        for (Index i = offset; i < offset + d; ++i) twice += state.p[i] * state.v[i];
      return S(twice / 2);
    }};
  }

  /// Constraints between two places, by their numbers: rods, components of common points, and x.e = 0 across an axis of
  /// one of them. Of the latter two it is said whether the first place is that of the joint.
  struct Between {
    struct Component {
      Index constraint, axis;
      bool forward;
    };
    struct Across {
      Index constraint;
      Displacement<S> e;
      bool forward;
    };
    std::vector<Index> rods;
    std::vector<Component> points;
    std::vector<Across> across;
    std::vector<Index> all;  ///< of any form
  };
  enum class Kinds { rods, forces, any };
  Between between(const std::string& a, const std::string& b, Kinds kinds) const {
    for (const std::string& name : {a, b}) displacement(name);
    Between found;
    for (std::size_t i = 0; i < constraints_.size(); ++i)
      for (const bool forward : {true, false}) {
        const std::string pair = forward ? " '" + a + "'-'" + b + "'" : " '" + b + "'-'" + a + "'";
        const std::string& name = constraints_[i].name;
        const std::size_t at = name.find(pair);
        if (at == std::string::npos || name.find(' ') != at) continue;
        const std::string part = name.substr(at + pair.size());
        const auto number = static_cast<Index>(i);
        found.all.push_back(number);
        if (name == "rod" + pair) found.rods.push_back(number);
        if (kinds == Kinds::rods) continue;
        for (Index axis = 0; axis < d_; ++axis)
          if (part == std::string(" (point, ") + "xyz"[axis] + ")") found.points.push_back({number, axis, forward});
        if (part.starts_with(" (across"))
          found.across.push_back({number, std::get<DisplacementProduct<S>>(constraints_[i].form).y, forward});
      }
    if (found.rods.empty() && found.points.empty() && found.across.empty() &&
        (kinds != Kinds::any || found.all.empty())) {
      const std::string pairs = pairs_of(a, b);
      throw InputError(fmt::format("there is no {} between '{}' and '{}'{}",
                                   kinds == Kinds::rods ? "rod" : "rod or joint", a, b,
                                   pairs.empty() ? "" : "; there is one between " + pairs));
    }
    return found;
  }

  Quantity tension(const std::string& a, const std::string& b) const {
    return {[rods = between(a, b, Kinds::rods).rods, u = way(a, b)](const State& state) {
      S sum = 0;
      for (const Index rod : rods) sum += state.lambda[rod];
      return S(2 * sum * length(u.now(state)));
    }};
  }

  /// -grad g lambda, with respect to the first place.
  Quantity force(const std::string& a, const std::string& b, const Along& along) const {
    return force(between(a, b, Kinds::forces), way(a, b), along);
  }
  Quantity force(const Between& found, const Along& u, const Along& along) const {
    return {[found, u, along](const State& state) {
      S sum = 0;
      const Vector<S> unit = along.now(state);
      for (const Index rod : found.rods) sum += 2 * state.lambda[rod] * dot(u.now(state), unit);
      for (const auto& point : found.points) {
        const S part = state.lambda[point.constraint] * unit[point.axis];
        sum = point.forward ? S(sum - part) : S(sum + part);
      }
      for (const auto& line : found.across) {
        const S part = state.lambda[line.constraint] * dot(displaced(line.e, unit.size(), state.q), unit);
        sum = line.forward ? S(sum - part) : S(sum + part);
      }
      return sum;
    }};
  }

  /// Along n = e x f, and in the plane along e turned to the right.
  Quantity slide(const std::string& a, const std::string& b) const {
    const std::vector<typename Between::Across> across = between(a, b, Kinds::forces).across;
    if (across.empty()) throw InputError(fmt::format("nothing slides between '{}' and '{}'", a, b));
    return {[across, u = way(a, b), d = d_](const State& state) {
      const Vector<S> e = displaced(across.front().e, d, state.q);
      const Vector<S> n = d == 2 ? Vector<S>{{e[1], S(-e[0])}} : cross(e, displaced(across.back().e, d, state.q));
      return S(dot(n, u.now(state)));
    }};
  }

  Quantity support(const std::string& body, const Along& along) const {
    directors(body);
    const auto held = std::find_if(scene_.rigid_bodies.begin(), scene_.rigid_bodies.end(),
                                   [&](const SceneRigidBody& one) { return one.name == body; });
    if (!held->fixed) throw InputError("'" + body + "' is not 'fixed_at' a point, where a support would hold it");
    std::shared_ptr<SupportForce<S>>& force = supports_[body];
    if (!force) force = std::make_shared<SupportForce<S>>(scene_, problem_, *held);
    return {[force, along](const State& state) { return S(dot((*force)(state), along.now(state))); }};
  }

  /// The rigid body on which a place is; none for others.
  const std::string* body_at(const std::string& place) const {
    std::string body = place.substr(0, place.find('['));
    for (const SceneAttachment& attachment : scene_.attachments)
      if (attachment.name == place) body = attachment.of;
    const auto found = directors_.find(body);
    return found == directors_.end() ? nullptr : &found->first;
  }

  /// About the place a, of all that holds the body there: M - (a - X) x F, where M is about the reference point X.
  Quantity torque(const Arguments& of) const {
    const std::string &a = of[0], &b = of[1];
    if (d_ == 1) throw InputError("'torque' is of a plane or of space, and the scene has dimension = 1");
    const Between found = between(a, b, Kinds::any);
    const std::string* const body = body_at(a);
    if (!body) {
      if (!body_at(b)) throw InputError("neither '" + a + "' nor '" + b + "' is on a rigid body");
      Arguments turned_round = of;
      std::swap(turned_round[0], turned_round[1]);
      return {[other = torque(turned_round).value](const State& state) { return S(-other(state)); }};
    }
    std::vector<Index> directors;
    for (const std::string& director : directors_.at(*body))
      directors.push_back(displacement(director).blocks.front().offset);
    std::vector<Quantity> forces;
    for (Index i = 0; i < d_; ++i) forces.push_back(force(found, way(a, b), direction(std::string(1, "xyz"[i]))));
    if (!moment_) moment_ = std::make_shared<ConstraintMoment<S>>(problem_);
    const Along along =
        d_ == 3 ? direction(of[2]) : Along{[](const State&) { return Vector<S>::Constant(1, S(1)); }, {}};
    return {[moment = moment_, all = found.all, directors, forces, arm = way(*body, a), along](const State& state) {
      Vector<S> F(static_cast<Index>(forces.size()));
      for (std::size_t i = 0; i < forces.size(); ++i) F[static_cast<Index>(i)] = forces[i].value(state);
      const Vector<S> w = along.now(state);
      return S((*moment)(state, all, directors, w) - dot(cross(arm.now(state), F), w));
    }};
  }

  Quantity work(const Arguments& of) const {
    return {[points = working(problem_, of.empty() ? "" : of[0]), &problem = problem_](const State& state) {
      return work_done(problem, points, state.p);
    }};
  }
  /// That of the exact motion through the state.
  Quantity power(const Arguments& of) const {
    const std::vector<std::size_t> points = working(problem_, of.empty() ? "" : of[0]);
    if (!evaluator_) evaluator_ = std::make_shared<StateEvaluator<S>>(problem_);
    return {[points, evaluator = evaluator_, &problem = problem_](const State& state) {
      return work_done(problem, points, evaluator->force(state.q, state.p));
    }};
  }

  const Scene& scene_;
  const Problem<S>& problem_;
  Index d_;
  std::map<std::string, Displacement<S>, std::less<>> places_;
  std::vector<Constraint<S>> constraints_;
  std::vector<std::string> bodies_, movers_;  ///< what has a place, and what has a mass
  std::map<std::string, Arguments, std::less<>> directors_;
  // Made where they are asked for
  mutable std::map<std::string, std::shared_ptr<SupportForce<S>>> supports_;
  mutable std::shared_ptr<ConstraintMoment<S>> moment_;
  mutable std::shared_ptr<StateEvaluator<S>> evaluator_;
};

template <Scalar S>
SeenQuantities<S>::SeenQuantities(const Scene& scene, const Problem<S>& problem)
    : names_(std::make_unique<const Names>(scene, problem)) {}
template <Scalar S>
SeenQuantities<S>::~SeenQuantities() = default;

template <Scalar S>
SeenQuantity<S> SeenQuantities<S>::named(const std::string& name) const {
  return names_->named(name);
}

#define HBVM_DEFINE(S) template class SeenQuantities<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
