#include "bindings.hpp"
#include "hbvm/error.hpp"
#include "hbvm/version.hpp"

namespace py = pybind11;

namespace {

/// Raises the class of this name with the program's words.
void raise(const char* name, const std::exception& error) {
  const py::object type = py::module_::import("hbvm._errors").attr(name);
  PyErr_SetString(type.ptr(), error.what());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const hbvm::InputError& error) {
    raise("InputError", error);
  } catch (const hbvm::IntegrationError& error) {
    raise("IntegrationError", error);
  } catch (const hbvm::Interrupted& error) {
    raise("Interrupted", error);
  } catch (const hbvm::Error& error) {
    raise("Error", error);
  } catch (const std::bad_alloc&) {
    PyErr_SetString(PyExc_MemoryError,
                    "the request needs more memory than there is: use fewer digits, stages or bodies");
  }
}

}  // namespace

PYBIND11_MODULE(_hbvm, module) {
  py::register_exception_translator(translate);
  module.attr("version") = hbvm::version();
  for (const auto add :
       {hbvm::python::add_scene, hbvm::python::add_run, hbvm::python::add_reference, hbvm::python::add_audit,
        hbvm::python::add_cost, hbvm::python::add_study, hbvm::python::add_lesson, hbvm::python::add_facts,
        hbvm::python::add_solver, hbvm::python::add_tangent, hbvm::python::add_section})
    add(module);
}
