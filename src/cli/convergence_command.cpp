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

struct ConvergenceArguments {
  SceneArgument scene;
  std::string steps;
  std::vector<std::string> methods, precisions{"double"};
  std::optional<std::string> until, plot;
  bool propagated = false, json = false;
};

void convergence_command(const ConvergenceArguments& o) {
  std::optional<PictureFile> picture;
  if (o.plot) picture.emplace(*o.plot);
  ProgressBar bar(o.scene.name);
  end_runs_on_signals();
  const ConvergenceStudy result = convergence({.scene = o.scene.load(),
                                               .methods = o.methods,
                                               .steps = o.steps,
                                               .until = o.until,
                                               .precisions = o.precisions,
                                               .propagated = o.propagated,
                                               .picture = picture.has_value(),
                                               .progress = [&](long done, long of) { bar.update(done, of); }});
  if (picture) picture->write([&] { return *result.figure; }, {});
  std::cout << (o.json ? to_json(result) + "\n" : to_text(result)) << std::flush;
}

}  // namespace

void add_convergence_command(CLI::App& app) {
  auto o = std::make_shared<ConvergenceArguments>();
  CLI::App* const command =
      app.add_subcommand("convergence", "Measure the orders of methods: errors against the step, and their rates");
  o->scene.add_to(*command);
  command->add_option("--methods", o->methods, "One method or more, as `hbvm methods` lists them")->required();
  command->add_option("--steps", o->steps, "A:B, each step half of the one before, as 1/8:1/256; five at least")
      ->required();
  command->add_option("--until", o->until, "Final time, a multiple of the steps; without, sixteen of the longest");
  command->add_option("--precision", o->precisions, "Precisions: double, quad, mpfr:N, or N alone, for N digits")
      ->capture_default_str();
  command->add_flag("--propagated", o->propagated,
                    "Measure p and lambda as they are carried on, instead of those of the output state");
  command->add_option("--plot", o->plot, "Draw errors against the step into this file: .svg, .pdf or .png");
  command->add_flag("--json", o->json, "Print one JSON object and nothing else");
  command->footer(
      "Example: hbvm convergence double_pendulum --methods rattle hbvm:4,2 --steps 1/8:1/256 --precision 50");
  command->callback([o] { convergence_command(*o); });
}

}  // namespace hbvm::core
