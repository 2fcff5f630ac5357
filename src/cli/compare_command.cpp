#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include "commands.hpp"
#include "hbvm/study.hpp"
#include "picture_file.hpp"
#include "progress_bar.hpp"
#include "scene_argument.hpp"
#include "signals.hpp"

namespace hbvm::core {
namespace {

struct CompareArguments {
  SceneArgument scene;
  std::string until, precision = "double";
  std::vector<std::string> methods, plots;
  std::optional<std::string> step;
  bool reference = false, json = false;
};

void compare_command(const CompareArguments& o) {
  const std::vector<PictureFile> pictures(o.plots.begin(), o.plots.end());
  ProgressBar bar(o.scene.name);
  end_runs_on_signals();
  const MethodComparison comparison = compare_methods({.scene = o.scene.load(),
                                                       .methods = o.methods,
                                                       .step = o.step,
                                                       .until = o.until,
                                                       .precision = o.precision,
                                                       .reference = o.reference,
                                                       .picture = !pictures.empty(),
                                                       .progress = [&](long done, long of) { bar.update(done, of); }});
  for (const PictureFile& picture : pictures)
    picture.write([&] { return *comparison.figure; }, [&] { return comparison.page; });
  std::cout << (o.json ? to_json(comparison) + "\n" : to_text(comparison)) << std::flush;
}

}  // namespace

void add_compare_command(CLI::App& app) {
  auto o = std::make_shared<CompareArguments>();
  CLI::App* const command =
      app.add_subcommand("compare", "Run several methods on one scene: one table, one figure, one page that moves");
  o->scene.add_to(*command);
  command->add_option("--methods", o->methods, "Two methods or more, as `hbvm methods` lists them")
      ->required()
      ->delimiter(' ');
  command->add_option("--step", o->step, "Step size of all; without, one that suits the scene, as of hbvm run");
  command->add_option("--until", o->until, "Final time, a multiple of the step")->required();
  command->add_option("--precision", o->precision, "double, quad, or mpfr:N, or N alone, for N digits")
      ->capture_default_str();
  command->add_flag("--reference", o->reference,
                    "Tell how many digits of the positions are right at the end, by the motion's Taylor series");
  command
      ->add_option("--plot", o->plots,
                   "Draw motions and errors into this file: .svg, .pdf or .png; as .html all move on one clock")
      ->allow_extra_args(false);
  command->add_flag("--json", o->json, "Print one JSON object and nothing else");
  command->footer("Example: hbvm compare kepler --methods rk4 verlet hbvm:auto,3 --until 50 --reference");
  command->callback([o] { compare_command(*o); });
}

}  // namespace hbvm::core
