#include <pybind11/stl.h>

#include "bindings.hpp"
#include "hbvm/lesson.hpp"
#include "supervision.hpp"

namespace py = pybind11;

namespace hbvm::python {

void add_lesson(py::module_& module) {
  module.def("lessons", [] { return std::pair(to_json(lessons()), to_text(lessons())); });
  module.def("check_lesson", [](const std::string& lesson, const std::string& answers) {
    Supervision supervision(py::none{});
    return supervision.of([&] {
      const LessonCheck check = check_lesson(lesson, answers, "answers", supervision.token());
      return std::pair(to_json(check), to_text(check));
    });
  });
}

}  // namespace hbvm::python
