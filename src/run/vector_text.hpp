#pragma once

#include <string>
#include <vector>

#include "linear/matrix.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {

/// A vector's numbers as to_text() writes them.
template <Scalar S>
std::vector<std::string> to_texts(const Vector<S>& v) {
  std::vector<std::string> result;
  for (Index i = 0; i < v.size(); ++i) result.push_back(to_text(v[i]));
  return result;
}

}  // namespace hbvm::core
