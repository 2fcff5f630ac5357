#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "problem/effect/interaction.hpp"
#include "scalar/expression.hpp"

namespace hbvm::core {

/// What a scene file says, as exact text: no number in it has been rounded. Made by read_scene, or in C++. Lines are
/// those of the file, for messages; 0 if there is none.

using SceneVector = std::vector<Expression>;
using SceneMatrix = std::vector<SceneVector>;  ///< row by row

/// A point at rest, or one that moves along formulas of t.
struct ScenePoint {
  std::string name;
  SceneVector position;
  std::optional<Expression> charge;
  std::size_t line = 0;
};

struct SceneBody {
  std::string name;
  std::optional<Expression> mass;  ///< scalar, or
  std::optional<SceneMatrix> mass_matrix;
  SceneVector position;
  SceneVector velocity;  ///< one of velocity and momentum is empty
  SceneVector momentum;
  std::optional<Expression> charge;
  std::size_t line = 0;
};

/// What a rigid body looks like; it moves nothing.
struct SceneShape {
  std::string kind = {};   ///< box, cylinder, disc, ring or sphere
  SceneVector sizes = {};  ///< the edges of a box, radius and length of a cylinder, the radius of others
  SceneVector axis = {};   ///< of a cylinder, disc or ring in space; the third director if empty
  SceneVector at = {};     ///< its middle in the body frame; the centre of mass if empty
};

/// A rigid body in natural coordinates: reference point (unless fixed) and d directors. Vectors and matrices have d
/// entries a row; in the plane the angular velocity is one number.
struct SceneRigidBody {
  std::string name;
  bool fixed = false;
  SceneVector position;  ///< of the reference point
  SceneVector velocity;  ///< of the reference point, unless fixed
  Expression mass;
  SceneVector center;         ///< of mass, in the body frame
  SceneMatrix second_moment;  ///< integral of X X^T dm about the reference point, body frame
  SceneMatrix directors;      ///< row i is director i in space
  SceneVector angular_velocity;
  std::size_t line = 0;
  std::optional<SceneShape> shape = {};
};

/// A point fixed in the frame of a rigid body, which constraints and effects name like a body.
struct SceneAttachment {
  std::string name;
  std::string of;  ///< the rigid body
  SceneVector at;  ///< in its frame, from the reference point
  std::optional<Expression> charge;
  std::size_t line = 0;
};

/// Where a text begins in a file: line and column from 1, column 0 if the file has it in other words.
struct TextBegin {
  std::size_t line = 0, column = 0;

  /// "line 3, column 12" of character `at`, from 0, of the text.
  std::string place(std::string_view text, std::size_t at) const;
};

/// A formula, U of an effect or g of a constraint, and what its names are about.
struct SceneFormula {
  Expression expression;
  Acts acts = Acts::on_each_body;
  std::vector<std::string> of = {};  ///< of a group, and the body or pair of a constraint
  TextBegin begin = {};
};

/// A constraint by its kind, which says the keys: see ConstraintForms and ConstraintGroups. One by a formula has the
/// kind "formula".
struct SceneConstraint {
  std::string kind;
  std::map<std::string, std::array<std::string, 2>, std::less<>> pairs;
  std::map<std::string, std::string, std::less<>> bodies;
  std::map<std::string, Expression, std::less<>> numbers;
  std::map<std::string, SceneVector, std::less<>> vectors;
  std::map<std::string, SceneMatrix, std::less<>> matrices;
  std::optional<SceneFormula> formula = {};
  std::size_t line = 0;

  bool has(std::string_view key) const {
    return pairs.contains(key) || bodies.contains(key) || numbers.contains(key) || vectors.contains(key) ||
           matrices.contains(key);
  }
};

struct SceneEffect {
  std::string kind;
  std::map<std::string, Expression, std::less<>> numbers;
  std::map<std::string, SceneVector, std::less<>> vectors;
  std::string center;                                                         ///< of an effect about a centre
  std::optional<std::vector<std::string>> on;                                 ///< all bodies if absent
  std::optional<std::vector<std::pair<std::string, std::string>>> between;    ///< all pairs if absent
  std::optional<SceneFormula> formula = {};                                   ///< of the kind "formula"
  std::map<std::string, std::vector<Expression>, std::less<>> formulas = {};  ///< keys of a force, by components
  std::vector<std::string> of = {};                                           ///< the bodies of a force on several
  std::size_t line = 0;

  /// Whether it is a force between two, where there is one on a single body as well.
  bool is_mutual() const { return kind == "torque" && between.has_value(); }
};

/// What is looked at along the motion: see Observations.
struct SceneObservation {
  std::string name;
  Expression value;
  std::size_t line = 0;
};

/// In which direction a value crosses 0.
enum class Crossing { any, up, down };

/// A time at which a value of the motion crosses 0: see EventFinder.
struct SceneEvent {
  std::string name;
  Expression value;  ///< of what may be observed
  Crossing direction = Crossing::any;
  std::size_t line = 0;
};

struct Scene {
  std::string name;  ///< built-in name or path
  std::string title, source;
  int dimension = 0;  ///< 1, 2 or 3
  Constants constants;
  std::vector<ScenePoint> points;
  std::vector<SceneBody> bodies;
  std::vector<SceneRigidBody> rigid_bodies;
  std::vector<SceneAttachment> attachments;
  std::vector<SceneConstraint> constraints;
  std::vector<SceneEffect> effects;
  std::vector<std::string> observables;  ///< among energy, linear_momentum, angular_momentum
  std::vector<SceneObservation> observations = {};
  std::vector<SceneEvent> events = {};
  std::vector<std::string> changes = {};  ///< options that make it of what the name stands for: "--set 'L=1.2'"

  bool observes(std::string_view what) const {
    return std::find(observables.begin(), observables.end(), what) != observables.end();
  }
};

/// Reads the TOML text of a scene and checks all that can be checked without computing. The name stands in messages and
/// results.
/// \throws InputError with name, line and what is wrong
Scene read_scene(const std::string& toml, const std::string& name);

/// A scene as TOML that read_scene takes back.
std::string write_scene(const Scene& scene);

/// The text of a scene file, or of a built-in scene by its name.
/// \throws InputError
std::string scene_text(const std::string& path_or_name);

/// The scene of a file, or a built-in one by its name.
/// \throws InputError
Scene load_scene(const std::string& path_or_name);

/// The text of a scene to begin with, whose comments say what there is.
const std::string& new_scene();

/// Name and text of each scene compiled in: those of studies/scenes.
const std::vector<std::pair<std::string, std::string>>& built_in_scenes();
/// And those of studies/test_set: the field's test problems, and scenes in which forces do work.
const std::vector<std::pair<std::string, std::string>>& test_set_scenes();
/// The former, then the latter.
std::vector<std::pair<std::string, std::string>> all_scenes();

}  // namespace hbvm::core
