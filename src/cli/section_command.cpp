#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include "commands.hpp"
#include "door/section_of.hpp"
#include "hbvm/section.hpp"
#include "long_work.hpp"
#include "output_files.hpp"
#include "picture_file.hpp"
#include "scene_argument.hpp"
#include "section/section_page.hpp"
#include "signals.hpp"

namespace hbvm::core {
namespace {

struct SectionArguments {
  SceneArgument scene;
  std::string plane, direction = "up";
  std::vector<std::string> axes, starts;
  std::string method = usual_method, until, precision = "double", solver = "auto";
  std::optional<std::string> step, plot, csv;
  bool json = false;
  WorkArguments work{"orbits.jsonl"};
};

void section_command(const SectionArguments& o) {
  std::optional<PictureFile> picture;
  if (o.plot) picture.emplace(*o.plot);
  if (o.csv) refuse_dash("--csv", *o.csv);
  const SectionRequest request{.scene = o.scene.load(),
                               .plane = o.plane,
                               .direction = o.direction,
                               .axes = {o.axes.at(0), o.axes.at(1)},
                               .starts = o.starts,
                               .method = o.method,
                               .step = o.step,
                               .until = o.until,
                               .precision = o.precision,
                               .solver = o.solver};
  const SectionWork work = section_work(request);
  end_runs_on_signals();
  CellOptions options;
  const std::optional<std::filesystem::path> folder = o.work.make_folder();
  std::optional<Section> found;
  {
    const LongWork long_work(o.work, folder, o.scene.name, options);
    found = run_section(work, options);
  }
  if (!found) {
    std::cout << "the orbits of shard " << *o.work.shard << " are in " << (*folder / o.work.store).string()
              << "; points come from all shards, by --merge\n"
              << std::flush;
    return;
  }
  if (o.csv) write_and_say(*o.csv, to_csv(*found));
  if (picture) picture->write([&] { return figure_of(*found); }, [&] { return section_page(*found, work); });
  std::cout << (o.json ? to_json(*found) + "\n" : to_text(*found)) << std::flush;
}

}  // namespace

void add_section_command(CLI::App& app) {
  auto o = std::make_shared<SectionArguments>();
  CLI::App* const command =
      app.add_subcommand("section", "Where many motions of a scene cross a surface: Poincare's section");
  o->scene.add_to(*command);
  command
      ->add_option("--plane", o->plane,
                   "The surface is where this is 0: a formula of what may be observed, as a.x, or a.x-b.x")
      ->required();
  command->add_option("--direction", o->direction, "Crossings that count: up, down or any")->capture_default_str();
  command->add_option("--axes", o->axes, "Two formulas likewise, the coordinates of points")->required()->expected(2);
  command
      ->add_option("--starts", o->starts,
                   "What starts differ by, as y0=-3/10:6/10:12 for twelve, or y0=0.1,0.2: a constant of the scene, "
                   "a.mass or a.charge; repeatable, for all combinations")
      ->allow_extra_args(false);
  command->add_option("--method", o->method, "As of hbvm run")->capture_default_str();
  command->add_option("--step", o->step, "Step size; without, one that suits the scene's own start");
  command->add_option("--until", o->until, "Final time of each motion")->required();
  command->add_option("--precision", o->precision, "double, quad, or mpfr:N, or N alone: crossings are found to that")
      ->capture_default_str();
  command->add_option("--solver", o->solver, "Of the stage equations, as of hbvm run")->capture_default_str();
  command->add_option("--csv", o->csv, "Write the points to this file, a line each");
  command->add_option(
      "--plot", o->plot,
      "Draw the points into this file: .svg, .pdf or .png; in .html a click on a point shows its orbit");
  command->add_flag("--json", o->json, "Print one JSON object and nothing else");
  o->work.add_to(*command, "Folder for orbits.jsonl, from which interrupted work goes on", "Threads");
  command->footer(
      "Example: hbvm section henon_heiles --plane star.x --axes star.y star.vy --step 1/4 --until 500 --plot s.html");
  command->callback([o] { section_command(*o); });
}

}  // namespace hbvm::core
