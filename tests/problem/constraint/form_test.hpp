#pragma once

#include "printing.hpp"
#include "problem/constraint.hpp"

namespace hbvm::core {

/// Forms with whole coefficients, whose values are exact.
template <class S>
class FormTest : public ::testing::Test {
 protected:
  PrecisionScope digits{50};

  static Vector<S> vector(std::initializer_list<int> entries) {
    Vector<S> v(static_cast<Index>(entries.size()));
    Index i = 0;
    for (const int entry : entries) v[i++] = S(entry);
    return v;
  }
};

}  // namespace hbvm::core
