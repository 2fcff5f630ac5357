#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "door/door.hpp"
#include "hbvm/scene.hpp"
#include "output_files.hpp"
#include "processes/draw.hpp"
#include "run/run_figure.hpp"
#include "scene/assemble.hpp"
#include "scene_argument.hpp"

namespace hbvm::core {
namespace {

constexpr const char* precision_usage = "double, quad, or mpfr:N, or N alone, for N digits";

struct CheckArguments {
  SceneArgument scene;
  std::string precision = "double";
  bool json = false;
};

void add_check(CLI::App& scene) {
  auto o = std::make_shared<CheckArguments>();
  CLI::App* const command = scene.add_subcommand("check", "Explain a scene: dimensions, effects, energy, momenta");
  o->scene.add_to(*command);
  command->add_option("--precision", o->precision, precision_usage)->capture_default_str();
  command->add_flag("--json", o->json, "Print one JSON object and nothing else");
  command->footer("Example: hbvm scene check tethered_satellites --precision quad");
  command->callback([o] {
    const SceneFacts facts = describe(o->scene.load(), o->precision);
    std::cout << (o->json ? to_json(facts) + "\n" : to_text(facts)) << std::flush;
  });
}

struct ProjectArguments {
  SceneArgument scene;
  std::string precision = "double";
  std::optional<std::string> out;
  std::vector<std::string> held;
};

void project_command(const ProjectArguments& o) {
  const std::string text = hbvm::project(o.scene.load(), o.precision, o.held).toml();
  if (!o.out || *o.out == "-") {
    std::cout << text;
    return;
  }
  try {
    write_and_say(*o.out, text);
  } catch (const InputError& error) {
    throw InputError(std::string("--out: ") + error.what());
  }
}

void add_project(CLI::App& scene) {
  auto o = std::make_shared<ProjectArguments>();
  CLI::App* const command = scene.add_subcommand(
      "project", "Write the nearest scene whose initial state fulfils the constraints, comments and all");
  o->scene.add_to(*command);
  command->add_option("--precision", o->precision, precision_usage)->capture_default_str();
  command
      ->add_option("--hold", o->held,
                   "Parts of the start that stay as they are: crank.angle,crank.rate of a rigid body; a.position, "
                   "a.velocity, or a coordinate, as a.x or a.vx")
      ->delimiter(',');
  command->add_option("--out", o->out, "Write to this file instead of standard output");
  command->footer("Example: hbvm scene project mine.toml --precision mpfr:60 --out consistent.toml");
  command->callback([o] { project_command(*o); });
}

struct ShowArguments {
  SceneArgument scene;
  std::string plot;
};

void show_command(const ShowArguments& o) {
  const Scene scene = scene_of(o.scene.load());
  // A start that is not consistent is shown, too: that is how one sees what is wrong.
  const Vector<double> q = assemble<double>(scene, Consistency::unchecked).q0;
  std::string flaw;
  try {
    assemble<double>(scene);
  } catch (const InputError& error) {
    flaw = error.what();
  }
  Figure figure = scene_figure(sketch(scene), {q.begin(), q.end()});
  figure.caption = plain(scene.title) + (flaw.empty() ? "" : " (the start is not consistent)");
  const std::string file = o.plot.empty() ? std::filesystem::path(scene.name).stem().string() + ".svg" : o.plot;
  draw(figure, file);
  say_written(file);
  if (!flaw.empty()) std::cerr << "hbvm: " << flaw << std::endl;
}

void add_show(CLI::App& scene) {
  auto o = std::make_shared<ShowArguments>();
  CLI::App* const command = scene.add_subcommand("show", "Draw a scene at its start");
  o->scene.add_to(*command);
  command->add_option("--plot", o->plot, "Draw into this file: .svg, .pdf or .png; NAME.svg of the scene if absent");
  command->footer("Example: hbvm scene show four_bar_linkage --plot linkage.pdf");
  command->callback([o] { show_command(*o); });
}

void add_new(CLI::App& scene) {
  CLI::App* const command =
      scene.add_subcommand("new", "Print a scene to begin with, whose comments say what is there");
  command->footer("Example: hbvm scene new > mine.toml");
  command->callback([] { std::cout << scene_template() << std::flush; });
}

}  // namespace

void add_scene_command(CLI::App& app) {
  CLI::App* const scene = app.add_subcommand("scene", "Begin, explain or draw a scene, or make its start consistent");
  scene->require_subcommand(1);
  scene->footer("Example: hbvm scene check tethered_satellites");
  add_new(*scene);
  add_check(*scene);
  add_project(*scene);
  add_show(*scene);
}

}  // namespace hbvm::core
