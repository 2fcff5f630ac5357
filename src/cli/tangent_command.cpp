#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include "commands.hpp"
#include "hbvm/tangent.hpp"
#include "picture_file.hpp"
#include "progress_bar.hpp"
#include "scene_argument.hpp"
#include "signals.hpp"

namespace hbvm::core {
namespace {

struct TangentArguments {
  SceneArgument scene;
  std::string method = usual_method, until, precision = "double", solver = "auto";
  std::optional<std::string> step, plot;
  std::vector<std::string> constants;
  bool json = false;
};

void tangent_command(const TangentArguments& o) {
  std::optional<PictureFile> picture;
  if (o.plot) picture.emplace(*o.plot);
  TangentRequest request{.scene = o.scene.load(), .method = o.method, .step = o.step, .until = o.until};
  request.precision = o.precision;
  request.solver = o.solver;
  request.constants = o.constants;
  ProgressBar bar(o.scene.name);
  request.progress = bar.part_done("following changes was interrupted");
  end_runs_on_signals();
  const Tangent found = tangent(request);
  if (picture) picture->write([&] { return figure_of(found); }, {});
  std::cout << (o.json ? to_json(found) + "\n" : to_text(found)) << std::flush;
}

}  // namespace

void add_tangent_command(CLI::App& app) {
  auto o = std::make_shared<TangentArguments>();
  CLI::App* const command = app.add_subcommand(
      "tangent", "How a motion changes with its start: Lyapunov exponents, digits lost, and when a precision has none");
  o->scene.add_to(*command);
  command->add_option("--method", o->method, "As of hbvm run")->capture_default_str();
  command->add_option("--step", o->step, "Step size; without, one that suits the scene");
  command->add_option("--until", o->until, "Final time: exponents are means until then")->required();
  command
      ->add_option("--precision", o->precision,
                   "Derivatives have its digits: double, quad, or mpfr:N, or N alone; more than twice as many are used")
      ->capture_default_str();
  command->add_option("--solver", o->solver, "Of the stage equations, as of hbvm run")->capture_default_str();
  command
      ->add_option("--constants", o->constants,
                   "How the end changes with these constants of the scene, with commas between")
      ->delimiter(',');
  command->add_option("--plot", o->plot,
                      "Draw how the exponents settle, and digits lost, into this file: .svg, .pdf or .png");
  command->add_flag("--json", o->json, "Print one JSON object and nothing else");
  command->footer("Example: hbvm tangent henon_heiles --step 1/8 --until 20");
  command->callback([o] { tangent_command(*o); });
}

}  // namespace hbvm::core
