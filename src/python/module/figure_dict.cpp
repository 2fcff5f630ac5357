#include "figure_dict.hpp"

#include <pybind11/stl.h>

namespace py = pybind11;

namespace hbvm::python {
namespace {

using namespace pybind11::literals;

/// A list of what `convert` makes of each.
template <class T, class Convert>
py::list list_of(const std::vector<T>& items, Convert&& convert) {
  py::list list;
  for (const T& item : items) list.append(convert(item));
  return list;
}

const char* name_of(AxisScale scale) {
  switch (scale) {
    case AxisScale::linear:
      return "linear";
    case AxisScale::binary:
      return "binary";
    case AxisScale::decimal:
      return "decimal";
    case AxisScale::falling:
      return "falling";
  }
  return "";
}

const char* name_of(Polyline::Look look) {
  switch (look) {
    case Polyline::Look::solid:
      return "solid";
    case Polyline::Look::bar:
      return "bar";
    case Polyline::Look::faint:
      return "faint";
    case Polyline::Look::dashed:
      return "dashed";
    case Polyline::Look::front:
      return "front";
    case Polyline::Look::axis:
      return "axis";
    case Polyline::Look::mesh:
      return "mesh";
  }
  return "";
}

const char* name_of(Mark::Look look) {
  switch (look) {
    case Mark::Look::body:
      return "body";
    case Mark::Look::start:
      return "start";
    case Mark::Look::fixed:
      return "fixed";
    case Mark::Look::positive:
      return "positive";
    case Mark::Look::negative:
      return "negative";
    case Mark::Look::centre:
      return "centre";
    case Mark::Look::joint:
      return "joint";
  }
  return "";
}

py::dict dict_of(const Axis& axis) {
  return py::dict("label"_a = axis.label, "scale"_a = name_of(axis.scale), "names"_a = axis.names);
}

py::dict dict_of(const Panel& panel) {
  py::dict dict("title"_a = panel.title, "x"_a = dict_of(panel.x), "y"_a = dict_of(panel.y),
                "equal_axes"_a = panel.equal_axes, "round_off"_a = panel.round_off);
  dict["curves"] = list_of(panel.curves, [](const Curve& curve) {
    return py::dict("label"_a = curve.label, "points"_a = curve.points, "marked"_a = curve.marked,
                    "dots"_a = curve.dots);
  });
  dict["lines"] = list_of(panel.lines, [](const Polyline& line) {
    return py::dict("points"_a = line.points, "look"_a = name_of(line.look), "colour"_a = line.colour);
  });
  dict["marks"] = list_of(panel.marks, [](const Mark& mark) {
    return py::dict("at"_a = mark.at, "look"_a = name_of(mark.look), "label"_a = mark.label, "colour"_a = mark.colour);
  });
  dict["labels"] =
      list_of(panel.labels, [](const Label& label) { return py::dict("at"_a = label.at, "text"_a = label.text); });
  dict["bars"] = list_of(panel.bars, [](const Bar& bar) {
    return py::dict("x"_a = bar.x, "from_"_a = bar.from, "to"_a = bar.to, "colour"_a = bar.colour);
  });
  return dict;
}

}  // namespace

py::dict dict_of(const Figure& figure) {
  py::list colours;
  for (const std::string_view colour : curve_colours) colours.append(py::str(colour.data(), colour.size()));
  return py::dict("name"_a = figure.name, "caption"_a = figure.caption, "footnote"_a = figure.footnote,
                  "panels"_a = list_of(figure.panels, [](const Panel& panel) { return dict_of(panel); }),
                  "colours"_a = colours);
}

}  // namespace hbvm::python
