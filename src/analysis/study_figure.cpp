#include "study_figure.hpp"

#include <fmt/format.h>

#include <fstream>

#include "expected_csv.hpp"
#include "hbvm/analysis/run.hpp"
#include "hbvm/report/figure.hpp"
#include "hbvm/scalar/literal.hpp"

namespace hbvm {
namespace {

std::string first_line(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
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

}  // namespace

std::vector<std::string> study_figure(const Experiment& experiment, TomlTable reader,
                                      const std::vector<std::string>& provenance,
                                      const std::filesystem::path& results) {
  std::vector<std::string> files;
  Figure figure;
  figure.name = reader.string("name");
  reader.rename("figure '" + figure.name + "'");
  figure.caption = reader.optional_string("caption");
  std::vector<std::string> csvs;
  std::vector<std::string> columns;
  for (const toml::table* table : reader.tables("run")) {
    TomlTable run_reader(reader.source(), *table, "run of figure '" + figure.name + "'");
    const RunRequest request{experiment.scene,
                             stated_method(run_reader),
                             SolverKind::fixed_point,
                             run_reader.number("step"),
                             run_reader.number("until"),
                             experiment.precision,
                             false};
    const std::string name = fmt::format("{}_{}.csv", figure.name, csvs.size() + 1);
    csvs.push_back((results / name).string());
    files.push_back(csvs.back());
    RunHooks hooks;
    hooks.every = run_reader.has("every") ? run_reader.integer("every") : 1;
    if (hooks.every < 1) run_reader.fail("'every' must be positive");
    run_reader.finish();
    hooks.provenance = provenance;
    hooks.provenance.push_back("method " + request.method->text() + ", step " + request.step.text() + ", until " +
                               request.until.text());
    hooks.open_csv = [&] { return std::make_unique<CsvFile>(csvs.back(), CsvFile::Opening::anew); };
    hbvm::run(request, hooks);
    columns = split(first_line(csvs.back()).substr(2));
  }
  for (const toml::table* table : reader.tables("panel"))
    figure.panels.push_back(
        panel(TomlTable(reader.source(), *table, "panel of figure '" + figure.name + "'"), csvs, columns));
  reader.finish();
  const std::string svg = (results / (figure.name + ".svg")).string();
  draw(figure, svg);
  files.push_back(svg);
  return files;
}

}  // namespace hbvm
