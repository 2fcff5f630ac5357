#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hbvm/number.hpp"

namespace hbvm {

class Scene;
namespace core {
struct Scene;
Scene scene_of(const hbvm::Scene& scene);
}  // namespace core

/// A body that has a place and no extent. One of velocity and momentum is given, or neither: it is at rest then.
struct Body {
  std::string name = {};
  Number mass = 1;
  Numbers position = {};
  Numbers velocity = {}, momentum = {};
  std::optional<Number> charge = {};
  NumberRows mass_matrix = {};  ///< instead of the mass
};

/// What a rigid body looks like in pictures.
struct Shape {
  std::string kind;   ///< "box", "cylinder", "disc", "ring" or "sphere"
  Numbers size;       ///< edges of a box; radius and length of a cylinder; one radius
  Numbers axis = {};  ///< in the body's frame, of the round ones in space; d3 if empty
  Numbers at = {};    ///< its middle in the body's frame; the centre of mass if empty
};

/// How a rigid body is turned from the axes of space: one of these. In the plane the angle alone.
struct Orientation {
  std::optional<Number> angle = {};  ///< in space about the axis
  Numbers axis = {};                 ///< of any length but 0
  Numbers quaternion = {};           ///< w, x, y, z, of any length but 0
  Numbers euler = {};                ///< three angles, about the axes that the sequence names
  std::string sequence = {};         ///< "zxz": each about an axis of the body as it is turned already
};

/// A rigid body, in the plane or in space; the page of scenes, studies/scenes, says what its keys mean.
struct RigidBody {
  std::string name = {};
  Number mass = 1;
  Numbers position = {};  ///< of its reference point
  bool fixed = false;
  Numbers velocity = {};                        ///< of its reference point; at rest if absent
  Numbers center = {};                          ///< of mass, in the body's frame
  NumberRows second_moment = {};                ///< integral of X X^T dm about the reference point, in the body's frame
  NumberRows directors = {};                    ///< row i is director i in space
  std::optional<Orientation> orientation = {};  ///< instead of the directors
  NumberRows inertia = {};          ///< about the centre of mass, instead of the second moment: a matrix, or one row of
                                    ///< principal moments; in the plane one number
  Numbers angular_velocity = {};    ///< one number in the plane, three in space
  std::optional<Shape> shape = {};  ///< in pictures; without, that of a homogeneous body with these moments
};

/// A condition g(q) = 0 by its kind and keys, as a scene file has them, or by its formula.
struct Constraint {
  std::string kind;
  std::map<std::string, std::vector<std::string>> names = {};  ///< {"between", {"a", "b"}}, {"on", {"a"}}
  std::map<std::string, Number> numbers = {};
  std::map<std::string, Numbers> vectors = {};
  std::map<std::string, NumberRows> matrices = {};
  std::string g = {};  ///< the formula, of the kind "formula"
};

/// A term of U by its kind and keys, as a scene file has them, or by its formula. U is minus the potential energy.
struct Effect {
  std::string kind;
  std::map<std::string, Number> numbers = {};
  std::map<std::string, Numbers> vectors = {};
  std::string center = {};                                        ///< of an effect about a point
  std::vector<std::string> on = {};                               ///< all bodies if empty
  std::vector<std::pair<std::string, std::string>> between = {};  ///< all pairs if empty
  std::string U = {};                                             ///< the formula, of the kind "formula"
};

/// A mechanical system and its start, as exact text: no number in it is rounded. It is read from a file, found by the
/// name of a built-in scene, or built:
///
///     hbvm::Scene scene(2);
///     scene.point("pivot", {0, 0}).body({.name = "bob", .position = {"3/5", "-4/5"}}).rod("pivot", "bob", 1);
///     scene.effect({.kind = "uniform_gravity", .vectors = {{"acceleration", {0, "-9.81"}}}});
///
/// What is built is checked when it is used, or by check().
class Scene {
 public:
  /// One without bodies, to be built. \throws InputError unless dimension is 1, 2 or 3
  explicit Scene(int dimension, std::string name = "scene");

  /// Each adds something. A name must be new, and names that are used must be there by the end.
  Scene& title(const std::string& text);
  Scene& constant(const std::string& name, const Number& value);
  Scene& point(const std::string& name, const Numbers& position, const std::optional<Number>& charge = {});
  Scene& body(const Body& body);
  Scene& rigid_body(const RigidBody& body);
  /// A point at a place in the frame of a rigid body, which constraints and effects name like a body.
  Scene& attachment(const std::string& name, const std::string& of, const Numbers& at);
  Scene& constraint(const Constraint& constraint);
  Scene& rod(const std::string& a, const std::string& b, const Number& length);
  Scene& effect(const Effect& effect);
  /// Another value of a constant by its name, "L", or of a body's "a.mass" or "a.charge". The scene is read then.
  /// \throws InputError for what there is not, with what there is
  Scene& set(const std::string& what, const Number& value);
  /// "energy", "linear_momentum" or "angular_momentum": a run tells how well it is conserved.
  Scene& observe(const std::string& quantity);
  /// A run tells a formula's value along the motion, by this name: "tension(o, bob)", "180/pi*angle(a.d1)". The names
  /// that it may have are listed on the page of scene files. The scene is read then. \throws InputError
  Scene& observe(const std::string& name, const std::string& formula);

  /// A run tells when a value of the motion crosses 0, and the state there: "turn: bob.vx", or upwards alone
  /// "turn up: bob.vx". The scene is read then. \throws InputError
  Scene& event(const std::string& text);

  const std::string& name() const { return name_; }
  /// As a scene file has it.
  std::string toml() const;
  /// Reads the scene and makes its system, in 50 digits.
  /// \throws InputError with the line of toml() and what is wrong there
  void check() const;

  friend core::Scene core::scene_of(const Scene& scene);
  friend Scene read_scene(const std::string& toml, const std::string& name);

 private:
  Scene() = default;
  /// One that was read, in parts to which others can be added.
  void take_apart();
  void become(core::Scene changed);

  std::string name_;
  std::string head_;  ///< of one that was read: the whole text
  std::vector<std::string> constants_ = {}, observables_ = {};
  std::string tables_ = {};
  std::shared_ptr<const core::Scene> read_ = {};  ///< what it says; null of one that is in parts
};

/// What a scene observes, by its name, and its value at some time. A run also tells the least and the greatest value at
/// its mesh points, and when they were first met.
struct Observation {
  std::string name, formula, value;
  std::string least = {}, least_t = {}, greatest = {}, greatest_t = {};
};

/// The scene of a file, or a built-in one by its name. \throws InputError with file, line and what is wrong
Scene load_scene(const std::string& path_or_name);
/// A scene from the text of a file. \param name stands in messages and results
Scene read_scene(const std::string& toml, const std::string& name = "scene");
/// A scene to begin with: a commented text that runs, and names the parts there are.
const std::string& scene_template();
/// The scene with the nearest start that fulfils the constraints, comments and all. What changes is written in the
/// digits of the precision.
/// \param hold parts that stay as they are: "a.position", "a.velocity", a coordinate, as "a.x" or "a.vx", and
///        "crank.angle" and "crank.rate" of a rigid body
/// \throws InputError if there is none, or none that holds these
Scene project(const Scene& scene, const std::string& precision = "double", const std::vector<std::string>& hold = {});

/// What a scene is and how it starts. Numbers that are text have all digits of the precision.
struct SceneFacts {
  std::string name, title, source;
  int dimension = 0;
  long bodies = 0;
  struct Rigid {
    std::string name;
    std::vector<double> inertia;  ///< principal moments about the centre of mass
  };
  std::vector<Rigid> rigid_bodies;
  long attachments = 0;
  std::vector<std::string> coordinates;   ///< of q, in order: "a.x"
  std::vector<std::string> constraints;   ///< what each multiplier belongs to, redundant ones included
  std::vector<long> redundant;            ///< the numbers of those that follow from others, from 1
  std::vector<std::string> redundancies;  ///< from which they follow
  long degrees_of_freedom = 0;
  std::optional<int> degree_of_g, degree_of_U;  ///< none if it is not a polynomial; of g the greatest, 0 without any
  std::string settled;                          ///< how the start was moved to where the constraints hold, if it was
  std::optional<double> gram_condition;         ///< of the normalised gradients at the start
  struct Effect {
    std::string kind;
    std::optional<int> degree;                                ///< of its part of U
    bool constant_force = false;                              ///< it is evaluated once
    bool has_potential = true;                                ///< or it is a force that has none
    std::vector<std::vector<std::string>> on;                 ///< bodies, pairs or groups, an entry for each value
    std::vector<std::pair<std::string, std::string>> not_on;  ///< bodies it leaves out, and why
    std::string remark;                                       ///< where on rigid bodies it acts, if on any
  };
  std::vector<Effect> effects;
  std::vector<std::string> driven;  ///< moving points, and what depends on t or does work, each with its own account
  std::string energy, kinetic, potential;
  struct Momentum {
    std::string name, value;
    bool conserved = false;
    bool linear = false;
  };
  std::vector<Momentum> momenta;
  std::vector<Observation> observed;  ///< at the start
};

/// \throws InputError for a scene that is not consistent, or where an effect has no value at the start
SceneFacts describe(const Scene& scene, const std::string& precision = "double");

/// For people, as `hbvm scene check` prints them.
std::string to_text(const SceneFacts& facts);
/// One JSON object, as `hbvm scene check --json` prints it.
std::string to_json(const SceneFacts& facts);

/// A built-in scene, as `hbvm scenes` lists it.
struct SceneEntry {
  std::string name, title, source;
  int dimension = 0;
  long bodies = 0, rigid_bodies = 0;
  std::vector<std::string> constraints, effects;  ///< their kinds, each once
};

/// Those that are built in.
std::vector<SceneEntry> scenes();
std::string to_text(const std::vector<SceneEntry>& scenes);
std::string to_json(const std::vector<SceneEntry>& scenes);

}  // namespace hbvm
