#include <pybind11/stl.h>

#include "bindings.hpp"
#include "hbvm/scene.hpp"

namespace py = pybind11;

namespace hbvm::python {

void add_scene(py::module_& module) {
  py::class_<Scene>(module, "Scene")
      .def(py::init(&read_scene), py::arg("toml"), py::arg("name"))
      .def_static("load", &load_scene)
      .def_property_readonly("name", &Scene::name)
      .def("toml", &Scene::toml)
      .def("check", &Scene::check)
      .def("set", [](Scene& scene, const std::string& what, const std::string& value) { scene.set(what, value); })
      .def("event", [](Scene& scene, const std::string& text) { scene.event(text); })
      .def("observe",
           [](Scene& scene, const std::string& name, const std::string& formula) { scene.observe(name, formula); });
  module.def("describe", [](const Scene& scene, const std::string& precision) {
    const SceneFacts facts = describe(scene, precision);
    return std::pair(to_json(facts), to_text(facts));
  });
  module.def("project", &project);
  module.def("scenes", [] { return std::pair(to_json(scenes()), to_text(scenes())); });
  module.def("scene_template", &scene_template);
}

}  // namespace hbvm::python
