#pragma once

#include <pybind11/pybind11.h>

#include "hbvm/figure.hpp"

namespace hbvm::python {

/// Panels with their curves, lines, marks, labels and bars, as dictionaries and lists.
pybind11::dict dict_of(const Figure& figure);

}  // namespace hbvm::python
