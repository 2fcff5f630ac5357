#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hbvm/error.hpp"
#include "problem/space/displacement.hpp"

namespace hbvm::core {

/// A key of a [[constraint]] table, and what stands there.
struct ConstraintKey {
  enum class Takes {
    pair,  ///< two bodies or points: the displacement of the first from the second
    body,  ///< one body, or a point of a rigid body: its position
    number,
    vector,           ///< d numbers
    symmetric_matrix  ///< d x d numbers
  };
  std::string_view name;
  Takes takes;
  bool optional = false;
};

/// What directions are fixed to: space at a fixed point, the directors of a rigid body, nothing at a mass point.
template <Scalar S>
struct Frame {
  enum class Of { space, rigid_body, nothing };
  Of of = Of::space;
  std::vector<Index> directors = {};  ///< of a rigid body: where each begins
  Matrix<S> start = {};               ///< how it stands at the start: a row for each of its axes

  /// The vector with these components in the frame.
  /// \throws InputError if there is none
  Displacement<S> direction(const Vector<S>& v) const {
    if (of == Of::nothing) throw InputError("a body of [[body]] has no directions; name points of rigid bodies");
    if (of == Of::space) return {{}, v};
    Displacement<S> result;
    for (std::size_t a = 0; a < directors.size(); ++a)
      if (const S& weight = v[static_cast<Index>(a)]; weight != 0) result.blocks.push_back({directors[a], weight});
    return result;
  }
};

/// A [[constraint]] table in numbers, for the form to make itself of. Each map has the keys that the form names.
template <Scalar S>
struct ConstraintInput {
  Index dimension = 0;
  std::map<std::string, Displacement<S>, std::less<>> pairs;
  std::map<std::string, std::array<Frame<S>, 2>, std::less<>> frames = {};  ///< of the ends of the pairs
  std::map<std::string, Displacement<S>, std::less<>> bodies;               ///< blocks ascending
  std::map<std::string, S, std::less<>> numbers;
  std::map<std::string, Vector<S>, std::less<>> vectors;
  std::map<std::string, Matrix<S>, std::less<>> matrices;

  const Displacement<S>& pair(std::string_view key) const { return pairs.find(key)->second; }
  const Displacement<S>& body(std::string_view key) const { return bodies.find(key)->second; }
  const S& number(std::string_view key) const { return numbers.find(key)->second; }
  const Vector<S>& vector(std::string_view key) const { return vectors.find(key)->second; }
  bool has_vector(std::string_view key) const { return vectors.contains(key); }
  const Matrix<S>& matrix(std::string_view key) const { return matrices.find(key)->second; }
};

}  // namespace hbvm::core
