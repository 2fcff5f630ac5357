// What accuracy costs: ratios of times measured side by side in one process.
//
//   speed                    the whole table (some minutes)
//   speed --rows double,mpfr only those groups
//   speed --out FOLDER       where table.csv, table.md and figure.svg go

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>

#include "groups.hpp"
#include "hbvm/error.hpp"
#include "hbvm/table.hpp"
#include "hbvm/version.hpp"
#include "processes/draw.hpp"

#ifndef HBVM_FLAGS
#define HBVM_FLAGS "unknown"
#endif

namespace {

using namespace hbvm;
using namespace hbvm::core;
using namespace hbvm::core::speed;

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  if (!out.flush()) throw Error("cannot write " + file.string());
}

int measure(const std::vector<std::string>& chosen, const std::filesystem::path& folder, const std::string& command) {
  std::filesystem::create_directories(folder);
  Table table;
  table.caption = "Ratios of processor time, the best of five runs in one process, observers excluded";
  table.provenance = {"hbvm " + std::string(version()), "command: " + command, "compiled with " HBVM_FLAGS};
  table.columns = {"work", "against", "ratio", "wanted", "met", "detail"};
  std::string curves;
  for (const Group& group : groups()) {
    if (!chosen.empty() && std::find(chosen.begin(), chosen.end(), group.name) == chosen.end()) continue;
    fmt::print("{}\n", group.title);
    Table::Group out{group.title, {}, {}};
    for (const Row& row : group.measure()) {
      const std::string wanted = row.limit == 0 ? "" : fmt::format("{} {:g}", row.at_least ? ">=" : "<=", row.limit);
      const std::string met = row.limit == 0 ? "" : row.met() ? "yes" : "no";
      out.rows.push_back({row.work, row.against, fmt::format("{:.2f}", row.ratio), wanted, met, row.detail});
      fmt::print("  {:<44} {:<34} {:>8.2f} {:>8} {:>4}  {}\n", row.work, row.against, row.ratio, wanted, met,
                 row.detail);
      std::fflush(stdout);
    }
    table.groups.push_back(std::move(out));
  }
  write(folder / "table.csv", to_csv(table));
  write(folder / "table.md", to_markdown(table));
  if (chosen.empty() || std::find(chosen.begin(), chosen.end(), "figure") != chosen.end()) {
    fmt::print("Curves of the figure\n");
    draw(cost_figure(folder), (folder / "figure.svg").string());
  }
  fmt::print("written to {}\n", folder.string());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Measures what accuracy costs: ratios of times, side by side in one process.\n\nExample: speed --rows "
      "double,quad"};
  std::vector<std::string> rows;
  std::string out = "results/speed";
  app.add_option("--rows", rows,
                 "Groups to measure, of double, best, quad, mpfr, raw, nodes, chain, scenes and figure; all if absent")
      ->delimiter(',')
      ->check(CLI::IsMember({"double", "best", "quad", "mpfr", "raw", "nodes", "chain", "scenes", "figure"}));
  app.add_option("--out", out, "Folder of table.csv, table.md and figure.svg")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::string command = "studies/speed/run";
  for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
  try {
    return measure(rows, out, command);
  } catch (const Error& error) {
    fmt::print(stderr, "speed: {}\n", error.what());
    return 1;
  }
}
