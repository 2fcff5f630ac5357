#pragma once

#include <pybind11/pybind11.h>

namespace hbvm::python {

/// Each adds its part of the front door to the module. A result comes as the JSON and the text that the program prints.
/// The package makes classes of these.
void add_scene(pybind11::module_& module);
void add_run(pybind11::module_& module);
void add_reference(pybind11::module_& module);
void add_audit(pybind11::module_& module);
void add_cost(pybind11::module_& module);
void add_study(pybind11::module_& module);
void add_lesson(pybind11::module_& module);
void add_facts(pybind11::module_& module);
void add_solver(pybind11::module_& module);
void add_tangent(pybind11::module_& module);
void add_section(pybind11::module_& module);

}  // namespace hbvm::python
