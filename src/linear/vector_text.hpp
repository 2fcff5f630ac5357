#pragma once

#include <string>
#include <vector>

#include "linear/matrix.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {

/// A vector's numbers as to_text() writes them.
template <Scalar S>
std::vector<std::string> to_texts(const Vector<S>& v) {
  std::vector<std::string> result;
  for (Index i = 0; i < v.size(); ++i) result.push_back(to_text(v[i]));
  return result;
}

/// The vector of these numbers.
template <Scalar S>
Vector<S> vector_of(const std::vector<std::string>& texts) {
  Vector<S> result(static_cast<Index>(texts.size()));
  for (Index i = 0; i < result.size(); ++i) result[i] = literal<S>(texts[static_cast<std::size_t>(i)]);
  return result;
}

}  // namespace hbvm::core
