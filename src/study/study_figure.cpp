#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>

#include "experiment.hpp"
#include "hbvm/figure.hpp"
#include "hbvm/version.hpp"
#include "long_work/json.hpp"
#include "read_file.hpp"
#include "report/csv_table.hpp"
#include "run/run_figure.hpp"
#include "run/scene_run.hpp"
#include "run/trajectory_metadata.hpp"
#include "scalar/big_float.hpp"
#include "scene/coordinate_names.hpp"
#include "write_file.hpp"

namespace hbvm::core {
namespace {

/// A run of a figure, and the file of its trajectory.
struct FigureRun {
  RunRequest request;
  long every = 1;
  std::string csv;
};

/// The text of the file and of its metadata, which is what a run leaves.
std::string trajectory(const FigureRun& run, const std::string& command) {
  RunHooks hooks;
  hooks.every = run.every;
  std::string metadata;
  hooks.describe_csv = [&](const std::vector<TrajectoryColumn>& columns) {
    metadata = to_csvw(trajectory_metadata(run.request, columns, command, run.every), run.csv);
  };
  hooks.open_csv = [&] { return std::make_unique<CsvFile>(run.csv, CsvFile::Opening::anew); };
  hbvm::core::run(run.request, hooks);
  return dumped({{"csv", read_file(run.csv)}, {"metadata", metadata}}, -1);
}
/// CSV and what describes it.
std::pair<std::string, std::string> read_trajectory(const std::string& text) {
  return read_json(text, "a figure", [](const OrderedJson& j) {
    return std::pair(j.at("csv").get<std::string>(), j.at("metadata").get<std::string>());
  });
}

/// A trajectory, column by column.
class Columns {
 public:
  /// \param file its name, for messages
  Columns(const std::string& csv, const std::string& file) : table_(read_csv_table(csv, file)) {}

  /// \throws InputError by way of the reader
  std::vector<double> column(const TomlTable& reader, const std::string& name, AxisScale scale) const {
    const std::vector<std::string>& names = table_.columns;
    const auto place = std::find(names.begin(), names.end(), name);
    if (place == names.end())
      reader.fail("there is no column '" + name + "': there are " + fmt::format("{}", fmt::join(names, ", ")));
    const auto i = static_cast<std::size_t>(place - names.begin());
    std::vector<double> values;
    for (const auto& row : table_.rows)
      values.push_back(scale == AxisScale::decimal ? log10_of(row.at(i)) : number(row.at(i)));
    return values;
  }

  /// Its states: t stands first, then the m coordinates of q.
  Recording recording(std::size_t m) const {
    Recording recording;
    for (const auto& row : table_.rows) {
      Recording::Sample& sample = recording.samples.emplace_back();
      sample.t = number(row.at(0));
      for (std::size_t i = 1; i <= m; ++i) sample.q.push_back(number(row.at(i)));
    }
    return recording;
  }

 private:
  static double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }
  /// Of its magnitude, which may lie beyond the range of double.
  static double log10_of(const std::string& text) {
    constexpr unsigned digits = 20;
    BigFloat x(digits);
    mpfr_set_str(raw(x), text.c_str(), 10, MPFR_RNDN);
    if (mpfr_zero_p(raw(x))) return -std::numeric_limits<double>::infinity();
    mpfr_abs(raw(x), raw(x), MPFR_RNDN);
    mpfr_log10(raw(x), raw(x), MPFR_RNDN);
    return mpfr_get_d(raw(x), MPFR_RNDN);
  }

  CsvTable table_;
};

/// The trajectory of the run that a table names by its number; the first if it does not.
const Columns& stated_run(TomlTable& reader, const std::vector<Columns>& runs) {
  const long run = reader.has("run") ? reader.integer("run") : 1;
  if (run < 1 || run > static_cast<long>(runs.size())) reader.fail("there is no run " + std::to_string(run));
  return runs[static_cast<std::size_t>(run - 1)];
}

bool stated(TomlTable& reader, const std::string& key) {
  const toml::node* const node = reader.take(key);
  return node && node->value_or(false);
}

/// motion = "xz": the scene's motion as it is seen along y, with its rods at so many times.
Panel motion(TomlTable& reader, const Scene& scene, const std::vector<Columns>& runs) {
  const std::string plane = reader.string("motion"), axes = "xyz";
  const std::size_t across = axes.find(plane.substr(0, 1)),
                    up = axes.find(plane.substr(std::min<std::size_t>(1, plane.size())));
  if (plane.size() != 2 || across == up || std::max(across, up) >= static_cast<std::size_t>(scene.dimension))
    reader.fail("'motion' is two axes of the scene, as \"xy\"");
  const long rods = reader.has("rods") ? reader.integer("rods") : 0;
  if (rods < 0) reader.fail("'rods' is a number of times");
  const std::size_t m = coordinate_names(scene).size();
  const Recording recording = stated_run(reader, runs).recording(m);
  return motion_panel(sketch(scene, recording.states()), recording,
                      {static_cast<int>(across), static_cast<int>(up), rods});
}

/// Columns of the trajectories against each other.
Panel curves(TomlTable& reader, const std::vector<Columns>& runs) {
  Panel panel;
  panel.x.label = reader.string("x_label");
  panel.y.label = reader.string("y_label");
  panel.equal_axes = stated(reader, "equal_axes");
  if (stated(reader, "y_log")) panel.y.scale = AxisScale::decimal;
  for (const toml::table* table : reader.tables("curve")) {
    TomlTable curve(reader.source(), *table, "curve");
    const Columns& run = stated_run(curve, runs);
    const std::vector<double> x = run.column(curve, curve.string("x"), panel.x.scale),
                              y = run.column(curve, curve.string("y"), panel.y.scale);
    Curve& c = panel.curves.emplace_back(Curve{curve.optional_string("label"), {}});
    for (std::size_t i = 0; i < x.size(); ++i) c.points.push_back({x[i], y[i]});
    curve.finish();
  }
  return panel;
}

Panel panel(TomlTable reader, const Scene& scene, const std::vector<Columns>& runs) {
  const std::string title = reader.string("title");
  Panel panel = reader.has("motion") ? motion(reader, scene, runs) : curves(reader, runs);
  panel.title = title;
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

void draw(const Experiment& experiment, const Figure& figure, Drawn& drawn) {
  const std::string picture = (experiment.results / (figure.name + ".svg")).string();
  try {
    if (!experiment.draw) throw Error("nothing was given that draws");
    experiment.draw(figure, picture);
    drawn.files.push_back(picture);
  } catch (const InputError&) {
    throw;
  } catch (const Error& error) {  // without gnuplot there are tables all the same
    drawn.warnings.push_back("'" + picture + "' is not drawn: " + error.what());
  }
}

Part<Drawn> study_figure(const Experiment& experiment, TomlTable reader) {
  Figure figure;
  figure.name = reader.string("name");
  reader.rename("figure '" + figure.name + "'");
  figure.caption = reader.optional_string("caption");
  const std::string of_figure = " of figure '" + figure.name + "'";
  Part<Drawn> part;
  std::vector<std::string> csvs;
  for (const toml::table* table : reader.tables("run")) {
    csvs.push_back((experiment.results / fmt::format("{}_{}.csv", figure.name, csvs.size() + 1)).string());
    const FigureRun run = read_run(experiment, TomlTable(reader.source(), *table, "run" + of_figure), csvs.back());
    const RunRequest& request = run.request;
    // Its file describes itself: two figures with the same run have results of their own.
    std::string further = std::to_string(run.every) + "|" + version() + "|" + experiment.command + "|" +
                          std::filesystem::path(run.csv).filename().string();
    part.cells.push_back({experiment.key("described trajectory", request.scene, request.method->key(), request.step,
                                         request.until, further),
                          [run, command = experiment.command] { return trajectory(run, command); }});
  }
  const std::vector<const toml::table*> panels = reader.tables("panel");
  reader.finish();
  part.conclude = [&experiment, &source = reader.source(), figure, csvs, panels,
                   of_figure](const std::vector<std::string>& results) {
    Drawn made;
    std::vector<Columns> runs;
    for (std::size_t n = 0; n < csvs.size(); ++n) {
      const auto [csv, metadata] = read_trajectory(results[n]);
      write_file(csvs[n], csv);
      write_file(csvw_file(csvs[n]), metadata);
      made.files.insert(made.files.end(), {csvs[n], csvw_file(csvs[n])});
      runs.emplace_back(csv, csvs[n]);
    }
    Figure drawn = figure;
    drawn.footnote = experiment.provenance[0] + ", " + experiment.provenance[1];
    for (const toml::table* table : panels)
      drawn.panels.push_back(panel(TomlTable(source, *table, "panel" + of_figure), experiment.scene, runs));
    draw(experiment, drawn, made);
    return made;
  };
  return part;
}

}  // namespace hbvm::core
