#include "hbvm/analysis/study.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "hbvm/analysis/run.hpp"
#include "hbvm/analysis/step_halving.hpp"
#include "hbvm/report/figure.hpp"
#include "hbvm/report/table.hpp"
#include "hbvm/scalar/literal.hpp"
#include "hbvm/version.hpp"
#include "scene/toml_table.hpp"

namespace hbvm {
namespace {

namespace fs = std::filesystem;

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError("cannot read " + path.string());
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  if (!line.empty() && line.back() == ',') cells.emplace_back();
  return cells;
}

/// expected.csv: column names in the first line, after "# ".
struct Expected {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  explicit Expected(const fs::path& path) {
    std::istringstream text(read_file(path));
    for (std::string line; std::getline(text, line);) {
      if (line.starts_with("# ") && columns.empty())
        columns = split(line.substr(2));
      else if (!line.empty() && !line.starts_with('#'))
        rows.push_back(split(line));
      if (!rows.empty() && rows.back().size() != columns.size())
        throw InputError(path.string() + ": '" + line + "' has " + std::to_string(rows.back().size()) +
                         " cells instead of " + std::to_string(columns.size()));
    }
  }
  /// The cell of a row, empty if the column does not exist.
  std::string cell(const std::vector<std::string>& row, const std::string& column) const {
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i] == column) return row[i];
    return {};
  }
};

double value(const std::string& text) { return literal<double>(text); }

/// A study.toml being run.
class Study {
 public:
  Study(const std::string& folder, const Precision& precision, bool check,
        const std::function<void(long, long)>& progress)
      : folder_(folder),
        source_(read_file(folder_ / "study.toml"), (folder_ / "study.toml").string()),
        root_(source_.parse()),
        top_(source_, root_, "study"),
        precision_(precision),
        check_(check),
        progress_(progress) {}

  StudyOutcome run() {
    outcome_.title = top_.string("title");
    const std::string kind = top_.string("kind");
    scene_ = find_scene(top_.string("scene"));
    figures_ = top_.tables("figure");
    std::string file = precision_.name();
    for (char& c : file)
      if (c == ':') c = '_';
    results_ = folder_ / "results" / file;
    std::error_code failure;
    fs::create_directories(results_, failure);
    if (failure) throw InputError("cannot write " + results_.string() + ": " + failure.message());
    table_.caption = outcome_.title;
    table_.provenance = {std::string("hbvm ") + version(),
                         "command hbvm study " + folder_.filename().string() + " --precision " + precision_.name(),
                         "scene " + scene_.name + ": " + scene_.title};
    if (kind == "step_halving")
      step_halving_table();
    else if (kind == "long_run")
      long_run_table();
    else
      top_.fail("unknown kind '" + kind + "': use step_halving or long_run");
    write("table.csv", to_csv(table_));
    write("table.md", to_markdown(table_));
    write("table.tex", to_latex(table_));
    outcome_.table = to_markdown(table_);
    for (const toml::table* table : figures_) figure(TomlTable(source_, *table, "figure"));
    top_.finish();
    return std::move(outcome_);
  }

 private:
  /// A scene file beside the study, or a built-in name.
  Scene find_scene(const std::string& name) const {
    const fs::path beside = folder_ / name;
    return load_scene(fs::exists(beside) ? beside.string() : name);
  }

  static MethodName method_of(TomlTable& reader) {
    const MethodName method = MethodName::parse(reader.string("method"));
    if (method.is_auto()) reader.fail("a study states its k");
    return method;
  }

  void write(const std::string& name, const std::string& text) {
    const fs::path path = results_ / name;
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw InputError("cannot write " + path.string());
    outcome_.files.push_back(path.string());
  }

  void complain(const std::string& what) { outcome_.complaints.push_back(what); }

  // --- The paper's tables ------------------------------------------------------------------------------------------

  struct Block {
    HalvingRequest request;
    std::vector<HalvingRow> rows;
  };

  void step_halving_table() {
    const Expression step = top_.number("step"), until = top_.number("until");
    const std::string group = top_.string("group");
    if (group != "k" && group != "s") top_.fail("'group' must be \"k\" or \"s\"");
    table_.key_columns = {"k", "s"};
    table_.columns = {"i"};
    for (const std::string& column : top_.strings("columns")) {
      HalvingRow().cell(column);  // refuses what is none
      table_.columns.push_back(column);
    }
    std::vector<Block> blocks;
    long runs = 0, done = 0;
    for (const toml::table* table : top_.tables("block")) {
      TomlTable reader(source_, *table, "block");
      HalvingRequest request{&scene_,
                             method_of(reader),
                             SolverKind::fixed_point,
                             step,
                             until,
                             static_cast<int>(reader.integer("first")),
                             static_cast<int>(reader.integer("last"))};
      if (request.first < 0 || request.last < request.first || request.last > 40)
        reader.fail("'first' and 'last' must be 0 <= first <= last <= 40");
      reader.finish();
      runs += request.last - request.first + 2;
      blocks.push_back({request, {}});
    }
    for (Block& block : blocks) {
      block.rows = step_halving(block.request, precision_, [&] { progress_(++done, runs); });
      const auto [k, s] = block.request.method;
      Table::Group rows{
          group + " = " + std::to_string(group == "k" ? k : s), {std::to_string(k), std::to_string(s)}, {}};
      for (const HalvingRow& row : block.rows) {
        std::vector<std::string> cells;
        for (const std::string& column : table_.columns) cells.push_back(row.cell(column));
        rows.rows.push_back(std::move(cells));
      }
      table_.groups.push_back(std::move(rows));
    }
    const std::vector<std::string> round_off = top_.strings("round_off");
    for (const std::string& column : round_off)
      if (column != "e_lambda" && column != "e_hid" && column != "e_g" && column != "e_H")
        top_.fail(top_.require("round_off"), "'round_off' has no column '" + column + "'");
    std::map<std::string, Expression> orders;
    if (const toml::node* const node = top_.take("orders")) {
      if (!node->is_table()) top_.fail(*node, "'orders' must be a table");
      for (const auto& [column, order] : *node->as_table())
        orders.emplace(column.str(), top_.to_number(order, "an order"));
    }
    const Expression above_round_off = top_.number("compare_above");
    if (check_) check_halvings(blocks, value(above_round_off.text()), round_off, orders);
  }

  /// Every printed figure above round-off, to all printed digits; beyond double also that what was round-off in double
  /// is round-off here, and that the rates double could not show (***) are there.
  void check_halvings(const std::vector<Block>& blocks, double above_round_off,
                      const std::vector<std::string>& round_off, const std::map<std::string, Expression>& orders) {
    const Expected expected(folder_ / "expected.csv");
    outcome_.what = "printed figures";
    for (const auto& printed : expected.rows) {
      const std::string k = expected.cell(printed, "k"), s = expected.cell(printed, "s"),
                        i = expected.cell(printed, "i");
      const std::string place = "k = " + k + ", s = " + s + ", i = " + i + ": ";
      const HalvingRow* found = nullptr;
      for (const Block& block : blocks)
        for (const HalvingRow& row : block.rows)
          if (std::to_string(block.request.method.k) == k && std::to_string(block.request.method.s) == s &&
              std::to_string(row.i) == i)
            found = &row;
      for (std::size_t c = 0; c < expected.columns.size(); ++c) {
        const std::string& column = expected.columns[c];
        const std::string& figure = printed[c];
        if (column.starts_with("e_") && !figure.empty() && value(figure) > above_round_off) {
          ++outcome_.stated;
          const std::string computed = found ? found->cell(column) : "nothing";
          if (computed == figure)
            ++outcome_.agreed;
          else
            complain(place + column + " is " + computed + ", printed " + figure);
        }
        if (precision_.kind() == Precision::Kind::binary64 || !found) continue;
        if (figure == "***" && orders.contains(column)) {
          ++outcome_.further;
          const Constants method{{"k", Expression::parse(k)}, {"s", Expression::parse(s)}};
          const double order = evaluate<double>(orders.at(column), method);
          const std::string computed = found->cell(column);
          if (computed != "***" && std::abs(value(computed) - order) <= value("1/10"))
            ++outcome_.further_agreed;
          else
            complain(place + column + " is " + computed + " instead of " + fmt::format("{}", order));
        }
      }
      if (precision_.kind() == Precision::Kind::binary64 || !found) continue;
      for (const std::string& column : round_off) {
        ++outcome_.further;
        const double ulps = column == "e_g"     ? found->ulps_g
                            : column == "e_H"   ? found->ulps_H
                            : column == "e_hid" ? found->ulps_hid
                                                : found->ulps_lambda;
        // A few roundings each step; the multiplier divides momenta by the step, and so do their roundings.
        if (ulps <= static_cast<double>(64 * (1 + found->steps)))
          ++outcome_.further_agreed;
        else
          complain(place + column + " is " + found->cell(column) + ", not round-off");
      }
    }
  }

  // --- Long runs ---------------------------------------------------------------------------------------------------

  void long_run_table() {
    const Expression step = top_.number("step");
    table_.columns = {"k", "s", "until", "e_H", "e_g", "e_hid", "output_delta_H", "iterations per step", "seconds"};
    table_.groups.emplace_back();
    const auto runs = top_.tables("run");
    std::vector<RunResult> results;
    for (const toml::table* table : runs) {
      TomlTable reader(source_, *table, "run");
      const RunRequest request{
          scene_, method_of(reader), SolverKind::fixed_point, step, reader.number("until"), precision_, false};
      reader.finish();
      const RunResult result = hbvm::run(request, {});
      const auto three = [](const std::string& text) { return to_three_digits(text); };
      table_.groups.back().rows.push_back(
          {std::to_string(request.method.k), std::to_string(request.method.s), request.until.text(), three(result.e_H),
           three(result.e_g), three(result.e_hid), three(result.output_delta_H),
           fmt::format("{:.1f}", result.iterations_per_step), fmt::format("{:.2f}", result.cpu_seconds)});
      results.push_back(result);
      progress_(static_cast<long>(results.size()), static_cast<long>(runs.size()));
    }
    if (check_) check_bounds(results);
  }

  static std::string to_three_digits(const std::string& text) {
    BigFloat x(200);
    mpfr_set_str(raw(x), text.c_str(), 10, MPFR_RNDN);
    char* digits = nullptr;
    mpfr_asprintf(&digits, "%.2Re", raw(x));
    const std::unique_ptr<char, void (*)(char*)> owner(digits, mpfr_free_str);
    return digits;
  }

  void check_bounds(const std::vector<RunResult>& results) {
    const Expected expected(folder_ / "expected.csv");
    outcome_.what = "stated bounds";
    for (const auto& row : expected.rows) {
      for (std::size_t n = 0; n < results.size(); ++n) {
        const auto& cells = table_.groups.back().rows[n];
        if (cells[0] != expected.cell(row, "k") || cells[1] != expected.cell(row, "s") ||
            cells[2] != expected.cell(row, "until"))
          continue;
        const std::string only = expected.cell(row, "only");
        if (!only.empty() && only != precision_.name()) continue;
        const std::string place = "k = " + cells[0] + ", s = " + cells[1] + ", until " + cells[2] + ": ";
        const auto bound = [&](const char* name, const std::string& computed, const std::string& limit, bool upper) {
          if (limit.empty()) return;
          ++outcome_.stated;
          if (upper ? value(computed) <= value(limit) : value(computed) >= value(limit))
            ++outcome_.agreed;
          else
            complain(place + name + " is " + computed + (upper ? ", above " : ", below ") + limit);
        };
        bound("e_H", results[n].e_H, expected.cell(row, "e_H_min"), false);
        bound("e_H", results[n].e_H, expected.cell(row, "e_H_max"), true);
        bound("e_g", results[n].e_g, expected.cell(row, "e_g_max"), true);
      }
    }
  }

  // --- Figures -----------------------------------------------------------------------------------------------------

  void figure(TomlTable reader) {
    Figure figure;
    figure.name = reader.string("name");
    reader.rename("figure '" + figure.name + "'");
    figure.caption = reader.optional_string("caption");
    std::vector<std::string> csvs;
    std::vector<std::string> columns;
    for (const toml::table* table : reader.tables("run")) {
      TomlTable run_reader(source_, *table, "run of figure '" + figure.name + "'");
      const RunRequest request{scene_,
                               method_of(run_reader),
                               SolverKind::fixed_point,
                               run_reader.number("step"),
                               run_reader.number("until"),
                               precision_,
                               false};
      const std::string name = fmt::format("{}_{}.csv", figure.name, csvs.size() + 1);
      csvs.push_back((results_ / name).string());
      outcome_.files.push_back(csvs.back());
      RunHooks hooks;
      hooks.every = run_reader.has("every") ? run_reader.integer("every") : 1;
      if (hooks.every < 1) run_reader.fail("'every' must be positive");
      run_reader.finish();
      hooks.provenance = table_.provenance;
      hooks.provenance.push_back("method " + request.method.text() + ", step " + request.step.text() + ", until " +
                                 request.until.text());
      hooks.open_csv = [&] {
        auto file = std::make_unique<std::ofstream>(csvs.back());
        if (!*file) throw InputError("cannot write " + csvs.back());
        return std::unique_ptr<std::ostream>(std::move(file));
      };
      hbvm::run(request, hooks);
      columns = split(first_line(csvs.back()).substr(2));
    }
    for (const toml::table* table : reader.tables("panel"))
      figure.panels.push_back(
          panel(TomlTable(source_, *table, "panel of figure '" + figure.name + "'"), csvs, columns));
    reader.finish();
    const std::string svg = (results_ / (figure.name + ".svg")).string();
    draw(figure, svg);
    outcome_.files.push_back(svg);
  }

  static std::string first_line(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    return line;
  }

  static Panel panel(TomlTable reader, const std::vector<std::string>& csvs, const std::vector<std::string>& columns) {
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

  static std::vector<std::string> coordinates(const TomlTable& reader, const toml::node& node) {
    const std::size_t size = node.is_array() ? node.as_array()->size() : 0;
    if (size != 2 && size != 3) reader.fail(node, "a point has two or three coordinates");
    std::vector<std::string> result;
    for (const Expression& x : reader.to_vector(node, size, "a point"))
      result.push_back(fmt::format("{}", evaluate<double>(x)));
    return result;
  }

  fs::path folder_;
  TomlSource source_;
  toml::table root_;
  TomlTable top_;
  Precision precision_;
  bool check_;
  const std::function<void(long, long)>& progress_;
  Scene scene_;
  fs::path results_;
  Table table_;
  std::vector<const toml::table*> figures_;
  StudyOutcome outcome_;
};

}  // namespace

StudyOutcome run_study(const std::string& folder, const Precision& precision, bool check,
                       const std::function<void(long, long)>& progress) {
  return Study(folder, precision, check, progress).run();
}

}  // namespace hbvm
