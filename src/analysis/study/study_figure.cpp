#include "study_figure.hpp"

#include <fmt/format.h>

#include <memory>

#include "analysis/json.hpp"
#include "expected_csv.hpp"
#include "hbvm/analysis/run/run.hpp"
#include "hbvm/read_file.hpp"
#include "hbvm/report/figure.hpp"
#include "hbvm/scalar/literal.hpp"
#include "hbvm/write_file.hpp"

namespace hbvm {
namespace {

/// A run of a figure, and the file of its trajectory.
struct FigureRun {
  RunRequest request;
  long every = 1;
  std::string csv;
};

/// The text of the file, which is what a run leaves.
std::string trajectory(const FigureRun& run, const std::vector<std::string>& provenance) {
  RunHooks hooks;
  hooks.every = run.every;
  hooks.provenance = provenance;
  hooks.open_csv = [&] { return std::make_unique<CsvFile>(run.csv, CsvFile::Opening::anew); };
  hbvm::run(run.request, hooks);
  return dumped({{"csv", read_file(run.csv)}}, -1);
}
std::string read_trajectory(const std::string& text) {
  return read_json(text, "a figure", [](const OrderedJson& j) { return j.at("csv").get<std::string>(); });
}

std::vector<std::string> coordinates(const TomlTable& reader, const toml::node& node) {
  const std::size_t size = node.is_array() ? node.as_array()->size() : 0;
  if (size != 2 && size != 3) reader.fail(node, "a point has two or three coordinates");
  std::vector<std::string> result;
  for (const Expression& x : reader.to_vector(node, size, "a point"))
    result.push_back(fmt::format("{}", evaluate<double>(x)));
  return result;
}

Panel panel(TomlTable reader, const std::vector<std::string>& csvs, const std::vector<std::string>& columns) {
  Panel panel;
  panel.title = reader.string("title");
  panel.x_label = reader.string("x_label");
  panel.y_label = reader.string("y_label");
  panel.z_label = reader.optional_string("z_label");
  if (const toml::node* const node = reader.take("equal_axes")) panel.equal_axes = node->value_or(false);
  const auto column = [&](const std::string& name) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i] == name) return static_cast<int>(i) + 1;
    reader.fail("there is no column '" + name + "'");
  };
  for (const toml::table* table : reader.tables("curve")) {
    TomlTable curve(reader.source(), *table, "curve");
    const long run = curve.has("run") ? curve.integer("run") : 1;
    if (run < 1 || run > static_cast<long>(csvs.size())) curve.fail("there is no run " + std::to_string(run));
    Curve c{csvs[static_cast<std::size_t>(run - 1)], column(curve.string("x")), column(curve.string("y")), 0,
            curve.string("label")};
    if (curve.has("z")) c.z = column(curve.string("z"));
    if (const toml::node* const node = curve.take("spokes")) c.spokes = node->value_or(false);
    curve.finish();
    panel.curves.push_back(std::move(c));
  }
  for (const toml::table* table : reader.tables("mark")) {
    TomlTable mark(reader.source(), *table, "mark");
    panel.marks.push_back({coordinates(mark, mark.require("at")), mark.string("label")});
    mark.finish();
  }
  for (const toml::table* table : reader.tables("line")) {
    TomlTable line(reader.source(), *table, "line");
    Polyline polyline{{}, line.string("label")};
    const toml::node& points = line.require("through");
    if (!points.is_array() || points.as_array()->empty()) line.fail(points, "'through' must be an array of points");
    for (const toml::node& point : *points.as_array()) polyline.points.push_back(coordinates(line, point));
    line.finish();
    panel.lines.push_back(std::move(polyline));
  }
  reader.finish();
  return panel;
}

FigureRun read_run(const Experiment& experiment, TomlTable reader, const std::string& csv) {
  FigureRun run{{experiment.scene, stated_method(reader), SolverKind::automatic, reader.number("step"),
                 reader.number("until"), experiment.precision, false},
                reader.has("every") ? reader.integer("every") : 1,
                csv};
  if (run.every < 1) reader.fail("'every' must be positive");
  reader.finish();
  return run;
}

}  // namespace

Part<std::vector<std::string>> study_figure(const Experiment& experiment, TomlTable reader) {
  Figure figure;
  figure.name = reader.string("name");
  reader.rename("figure '" + figure.name + "'");
  figure.caption = reader.optional_string("caption");
  const std::string of_figure = " of figure '" + figure.name + "'";
  Part<std::vector<std::string>> part;
  std::vector<std::string> csvs;
  for (const toml::table* table : reader.tables("run")) {
    csvs.push_back((experiment.results / fmt::format("{}_{}.csv", figure.name, csvs.size() + 1)).string());
    const FigureRun run = read_run(experiment, TomlTable(reader.source(), *table, "run" + of_figure), csvs.back());
    const RunRequest& request = run.request;
    std::vector<std::string> provenance = experiment.provenance;
    provenance.push_back("method " + request.method->text() + ", step " + request.step.text() + ", until " +
                         request.until.text());
    std::string further = std::to_string(run.every);
    for (const std::string& line : provenance) further += "|" + line;
    part.cells.push_back(
        {experiment.key("trajectory", request.scene, request.method->key(), request.step, request.until, further),
         [run, provenance] { return trajectory(run, provenance); }});
  }
  const std::vector<const toml::table*> panels = reader.tables("panel");
  reader.finish();
  part.conclude = [&experiment, &source = reader.source(), figure, csvs, panels,
                   of_figure](const std::vector<std::string>& results) {
    std::vector<std::string> files = csvs, columns;
    for (std::size_t n = 0; n < csvs.size(); ++n) {
      const std::string csv = read_trajectory(results[n]);
      write_file(csvs[n], csv);
      columns = split(csv.substr(0, csv.find('\n')).substr(2));
    }
    Figure drawn = figure;
    for (const toml::table* table : panels)
      drawn.panels.push_back(panel(TomlTable(source, *table, "panel" + of_figure), csvs, columns));
    files.push_back((experiment.results / (figure.name + ".svg")).string());
    draw(drawn, files.back());
    return files;
  };
  return part;
}

}  // namespace hbvm
