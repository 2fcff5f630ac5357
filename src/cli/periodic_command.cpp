#include <iostream>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "hbvm/periodic.hpp"
#include "progress_bar.hpp"
#include "scene_argument.hpp"
#include "signals.hpp"

namespace hbvm::core {
namespace {

struct PeriodicArguments {
  SceneArgument scene;
  std::string until;
  std::optional<std::string> plane;
  int digits = 30;
  bool json = false;
};

void periodic_command(const PeriodicArguments& o) {
  hbvm::PeriodicRequest request{.scene = o.scene.load(), .until = o.until, .plane = o.plane};
  request.digits = o.digits;
  ProgressBar bar(o.scene.name);
  request.progress = bar.part_done("the search for a periodic motion was not finished");
  end_runs_on_signals();
  const Periodic found = periodic(request);
  std::cout << (o.json ? to_json(found) + "\n" : to_text(found)) << std::flush;
}

}  // namespace

void add_periodic_command(CLI::App& app) {
  auto o = std::make_shared<PeriodicArguments>();
  CLI::App* const command = app.add_subcommand(
      "periodic", "Find a motion that comes back to its start, near that of a scene and of the same H");
  o->scene.add_to(*command);
  command->add_option("--until", o->until, "Time before which the scene's motion comes back near its start")
      ->required();
  command->add_option("--plane", o->plane,
                      "A formula of what may be observed that is 0 at the start that is looked for, as a.x");
  command->add_option("--digits", o->digits, "Digits of start and period")->capture_default_str();
  command->add_flag("--json", o->json, "Print one JSON object and nothing else; hbvm run --start reads it, too");
  command->footer("Example: hbvm periodic henon_heiles --until 8 --digits 40");
  command->callback([o] { periodic_command(*o); });
}

}  // namespace hbvm::core
