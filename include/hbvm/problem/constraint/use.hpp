#pragma once

#include <map>
#include <string>
#include <string_view>

#include "hbvm/problem/space/displacement.hpp"

namespace hbvm {

/// A key of a [[constraint]] table, and what stands there.
struct ConstraintKey {
  enum class Takes {
    pair,  ///< two bodies or points: the displacement of the first from the second
    body,  ///< one body: where its coordinates begin
    number,
    vector,           ///< d numbers
    symmetric_matrix  ///< d x d numbers
  };
  std::string_view name;
  Takes takes;
};

/// A [[constraint]] table in numbers, for the form to make itself of. Each map has the keys that the form names.
template <Scalar S>
struct ConstraintUse {
  Index dimension = 0;
  std::map<std::string, Displacement<S>, std::less<>> pairs;
  std::map<std::string, Index, std::less<>> bodies;
  std::map<std::string, S, std::less<>> numbers;
  std::map<std::string, Vector<S>, std::less<>> vectors;
  std::map<std::string, Matrix<S>, std::less<>> matrices;

  const Displacement<S>& pair(std::string_view key) const { return pairs.find(key)->second; }
  Index body(std::string_view key) const { return bodies.find(key)->second; }
  const S& number(std::string_view key) const { return numbers.find(key)->second; }
  const Vector<S>& vector(std::string_view key) const { return vectors.find(key)->second; }
  const Matrix<S>& matrix(std::string_view key) const { return matrices.find(key)->second; }
};

}  // namespace hbvm
