#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "door/run_of.hpp"
#include "door/trajectory_lines.hpp"
#include "hbvm/version.hpp"
#include "integrate/time_grid.hpp"
#include "interruption.hpp"
#include "output_files.hpp"
#include "outside_parentheses.hpp"
#include "picture_file.hpp"
#include "progress_bar.hpp"
#include "read_file.hpp"
#include "resume.hpp"
#include "run/run_figure.hpp"
#include "run/run_page.hpp"
#include "run/scene_run.hpp"
#include "run/trajectory_metadata.hpp"
#include "scene_argument.hpp"
#include "signals.hpp"
#include "step/registry.hpp"
#include "write_file.hpp"

namespace hbvm::core {
namespace {

struct RunArguments {
  SceneArgument scene;
  std::string method = usual_method, until;
  std::optional<std::string> step;
  std::string precision = "double", solver = "auto", on_failure = "stop";
  std::optional<std::string> out, start, plot;
  std::optional<std::string> every_time, until_event;
  std::vector<std::string> portraits, at;
  long every = 1;
  bool json = false, account = false, strict = false, shadow = false, reverse = false, error = false, prove = false,
       horizon = false;
  bool states = false, state = false, linear_energy = false;
  std::optional<std::string> checkpoint, resume;
  double every_seconds = 60;
  std::optional<Checkpoint> resumed;
  bool scene_given = true, start_given = true;  ///< now, and not only when the checkpoint was written
};

std::unique_ptr<CsvFile> open(const std::string& path, const RunArguments& o) {
  try {
    if (o.resumed) return std::make_unique<CsvFile>(path, CsvFile::Opening::to_go_on);
    for (const std::optional<std::string>& input : {std::optional(o.scene.name), o.start}) {
      std::error_code ignored;
      if (input && std::filesystem::equivalent(path, *input, ignored))
        throw InputError("'" + path + "' is what the run starts from");
    }
    return std::make_unique<CsvFile>(path, CsvFile::Opening::anew);
  } catch (const InputError& error) {
    throw InputError(std::string("--out: ") + error.what());
  }
}

/// What the run is; of one that goes on, what it was. \throws InputError if it is not the same
RunIdentity identity_of(const RunArguments& o, const CLI::App& command) {
  const auto refuse = [&](const std::string& why) { throw InputError("--resume: '" + *o.resume + "' " + why); };
  RunIdentity identity;
  if (o.resumed) {
    identity = o.resumed->identity;
    if (identity.program != version())
      refuse("was written by hbvm " + identity.program + ", and this is " + version() +
             ", whose steps may differ in the last bits");
    if (o.scene_given && write_scene(scene_of(o.scene.load())) != identity.scene)
      refuse("is of another scene: of '" + identity.scene_name + "' as it was then");
    if (o.start && o.start_given && read_file(*o.start) != identity.start)
      refuse("starts from another state than that in '" + *o.start + "'");
  } else {
    const Scene scene = scene_of(o.scene.load());
    identity = {version(), scene.name, write_scene(scene), o.start ? read_file(*o.start) : std::string(), {}};
  }
  identity.options = given_options(command);
  return identity;
}

/// "a.x,a.px", at the comma that is in no parentheses.
std::pair<std::string, std::string> portrait_of(const std::string& pair) {
  const std::size_t comma = find_outside_parentheses(pair, ',');
  if (comma != std::string::npos) return {pair.substr(0, comma), pair.substr(comma + 1)};
  throw InputError("--plot-xy " + pair + ": use two quantities, as a.x,a.px");
}

hbvm::RunRequest asked_of(const RunArguments& o, const RunIdentity& identity) {
  std::vector<std::pair<std::string, std::string>> portraits;
  for (const std::string& pair : o.portraits) portraits.push_back(portrait_of(pair));
  return {.scene = o.resumed ? hbvm::read_scene(identity.scene, identity.scene_name) : o.scene.load(),
          .method = o.method,
          .step = o.step,
          .until = o.until,
          .precision = o.precision,
          .solver = o.solver,
          .on_failure = o.on_failure,
          .reverse = o.reverse,
          .account = o.account,
          .shadow = o.shadow,
          .horizon = o.horizon,
          .error = o.error,
          .prove = o.prove,
          .start = identity.start,
          .portraits = portraits,
          .linear_energy = o.linear_energy,
          .at = Numbers(o.at.begin(), o.at.end()),
          .every_time = o.every_time,
          .until_event = o.until_event};
}

/// The file that keeps the run: the one it goes on from, unless it is to be another.
std::optional<Checkpoints> checkpoints_of(const RunArguments& o, const RunIdentity& identity) {
  const std::optional<std::string>& file = o.checkpoint ? o.checkpoint : o.resume;
  if (!file) return std::nullopt;
  std::error_code ignored;
  if (o.out && (*o.out == *file || std::filesystem::equivalent(*o.out, *file, ignored)))
    throw InputError("--checkpoint: '" + *file + "' is the file of --out");
  Checkpoints checkpoints(*file, o.every_seconds, identity);
  if (o.resumed) checkpoints.resume(o.resumed->state);
  return checkpoints;
}

/// Describes the trajectory in a file beside it, if it is one. \return the files of --out
std::vector<std::string> write_metadata(const RunArguments& o, const RunRequest& request, const std::string& command,
                                        const std::vector<TrajectoryColumn>& columns) {
  if (!has_neighbours(*o.out)) return {*o.out};
  const std::string file = csvw_file(*o.out), with_rows = command + " --every " + std::to_string(o.every);
  write_file(file, to_csvw(trajectory_metadata(request, columns, with_rows, o.every), *o.out));
  return {*o.out, file};
}

/// The picture of --plot, once there is something to be seen.
class Plot {
 public:
  explicit Plot(const std::string& file) : file_(file) {}

  Recording* recording() { return &recording_; }

  void draw(const RunRequest& request, const std::string& command) const {
    if (recording_.samples.size() < 2) return;
    file_.write([&] { return figure_of(request, recording_, command); },
                [&] { return run_page(request, recording_, command); }, [&] { return frames_of(request, recording_); });
  }

 private:
  PictureFile file_;
  Recording recording_;
};

void run_command(const RunArguments& o, const CLI::App& command) {
  if (o.every < 1 || o.every > TimeGrid<double>::max_steps)
    throw InputError("--every " + std::to_string(o.every) + " is not between 1 and " +
                     TimeGrid<double>::max_steps_text);
  if (!(o.every_seconds >= 0)) throw InputError("--every-seconds is negative");
  if (o.state && o.json) throw InputError("--state does not go with --json, which has the state with all digits");
  if (o.states && !o.json) throw InputError("--states goes with --json; a trajectory in a file is --out FILE.csv");
  if (o.states && (o.out || o.checkpoint || o.resume))
    throw InputError("--states does not go with --out, --checkpoint or --resume: the file of --out holds the states");
  for (const auto& [option, file] : {std::pair("--out", o.out), {"--checkpoint", o.checkpoint}})
    if (file) refuse_dash(option, *file);
  const RunIdentity identity = identity_of(o, command);
  const hbvm::RunRequest asked = asked_of(o, identity);
  RunRequest request = request_of(asked, o.start);
  if (o.resumed) request.scene.changes = o.scene.changes();
  const std::string made_by = command_of(asked, request);
  std::optional<Checkpoints> checkpoints = checkpoints_of(o, identity);
  RunHooks hooks;
  hooks.every = o.every;
  hooks.checkpoints = checkpoints ? &*checkpoints : nullptr;
  ProgressBar bar(request.scene.name);
  hooks.progress = [&](long done, long total) { bar.update(done, total); };
  std::vector<std::string> written;
  if (o.out) {
    hooks.open_csv = [&] { return open(*o.out, o); };
    hooks.describe_csv = [&](const std::vector<TrajectoryColumn>& columns) {
      written = write_metadata(o, request, made_by, columns);
    };
  }
  TrajectoryLines lines;
  std::ostream states(&lines);
  if (o.states) hooks.trajectory = &states;
  std::optional<Plot> plot;
  const auto show_files = [&] {
    std::for_each(written.begin(), written.end(), say_written);
    if (plot) plot->draw(request, made_by);
  };
  if (o.plot) hooks.recording = plot.emplace(*o.plot).recording();
  Account account;
  hooks.account = &account;
  end_runs_on_signals();
  try {
    Run result = [&] {
      try {
        return run(request, hooks);
      } catch (const InputError&) {
        throw;  // there may be no room for the files
      } catch (const Error&) {
        show_files();  // what was computed before is to be seen
        throw;
      }
    }();
    show_files();
    result.command = made_by;
    result.trajectory = lines.take();
    if (o.json)
      std::cout << to_json(result, o.states) << std::endl;
    else
      fmt::print("{}{}", to_text(result, o.state), request.account ? "\n" + to_text(account) : "");
    constexpr int doubtful = 3;
    if (o.strict && !result.health.warnings.empty()) throw CLI::RuntimeError(doubtful);
  } catch (const Interrupted& end) {
    const std::string file = o.checkpoint ? *o.checkpoint : o.resume.value_or("");
    throw Interrupted(end.signal(), end.what() + (file.empty() ? "; --checkpoint FILE would have kept it"
                                                               : "; go on with: hbvm run --resume " + file));
  }
}

}  // namespace

void add_run_command(CLI::App& app) {
  auto o = std::make_shared<RunArguments>();
  CLI::App* const command = app.add_subcommand("run", "Integrate a scene and report the final state and its errors");
  o->scene.add_to(*command);
  o->scene.add_observations_to(*command);
  command->add_option("--method", o->method, method_usage())->capture_default_str();
  command->add_option(
      "--step", o->step,
      "Step size: a number or an expression, as 2^(3/4)*pi/40; without, one that suits the scene: at most "
      "an eighth of the radius of convergence of the motion's Taylor series");
  command->add_option("--until", o->until, "Final time; the last step is shortened if it is no multiple of the step")
      ->required();
  command->add_option("--at", o->at, "Tell the state at these times, too, with commas between; any from 0 to the end")
      ->delimiter(',');
  command->add_option("--until-event", o->until_event,
                      "End at an event of this name, or at its third, as turn,3; --until is the latest end");
  command->add_option("--every-time", o->every_time, "Tell the state at the multiples of this time, too");
  command->add_option("--precision", o->precision, "double, quad, or mpfr:N, or N alone, for N digits")
      ->capture_default_str();
  command
      ->add_option(
          "--solver", o->solver,
          "auto, newton (mixed precision), fixed-point (newest values, warm start) or paper (its iteration, (55))")
      ->capture_default_str();
  command
      ->add_option("--on-failure", o->on_failure,
                   "What to do with a step that cannot be made: stop, or halve it, again and again, to at most 2^-20")
      ->capture_default_str();
  command->add_option("--out", o->out,
                      "Write the trajectory to this CSV file, and what describes it to FILE-metadata.json");
  command->add_option(
      "--plot", o->plot,
      "Draw motion, multipliers and errors into this file: .svg, .pdf or .png; as .html or .gif the motion moves");
  command
      ->add_option(
          "--plot-xy", o->portraits,
          "Two quantities, as a.x,a.px: in the picture of --plot draw the second against the first; repeatable")
      ->allow_extra_args(false)
      ->needs("--plot");
  command->add_flag("--plot-linear", o->linear_energy, "In the picture of --plot also draw H - H_0 on a linear axis")
      ->needs("--plot");
  command->add_option("--every", o->every, "Steps between two lines of the CSV file, or two states")
      ->check(CLI::Number)
      ->capture_default_str();
  command->add_option(
      "--start", o->start,
      "Start from the state in this JSON file, as --json prints it: q, p and their carry; t begins at 0");
  command->add_flag("--reverse", o->reverse, "Integrate backwards in time, from t = 0 to minus the final time");
  command->add_option("--checkpoint", o->checkpoint, "Keep the run in this file, from which --resume goes on");
  command->add_option("--every-seconds", o->every_seconds, "Seconds between two checkpoints")
      ->check(CLI::Number)
      ->capture_default_str();
  command
      ->add_option_function<std::string>(
          "--resume",
          [o, command](const std::string& file) {
            o->resume = file;
            o->scene_given = command->get_option("scene")->count() > 0;
            o->start_given = command->get_option("--start")->count() > 0;
            o->resumed = read_checkpoint(file);
            take_options(*command, file, *o->resumed);
          },
          "Go on from this checkpoint, and keep the run in it; all else may be repeated or left out")
      ->type_name("TEXT");
  command->add_flag("--account", o->account, "Also show what effects and parts of the solver did and took");
  command->add_flag("--strict", o->strict, "Exit code 3 if a warning says that the run may be worth little");
  command->add_flag("--error", o->error,
                    "Print the digits that are right, by a stored reference of this scene and time, or else by the "
                    "motion's Taylor series with 16 more digits");
  command->add_flag("--prove", o->prove,
                    "Prove of hbvm:K,S that each step's equations have one solution, and print bounds of what the "
                    "motion without rounding is, and of its H and g");
  command->add_flag("--shadow", o->shadow,
                    "Repeat the run with 16 more digits and say how many of each component survived rounding");
  command->add_flag("--horizon", o->horizon,
                    "Say how many digits of the start are lost by each time, and when a precision has none left");
  command->add_flag("--json", o->json, "Print one JSON object and nothing else");
  command->add_flag("--state", o->state,
                    "Print the state at the end with all digits, the propagated one and that of output");
  command->add_flag("--states", o->states, "Also put the mesh points into the JSON object, of --every steps one");
  command->footer(
      "Example: hbvm run tethered_satellites --method hbvm:5,1 --step 0.1 --until 100 --out satellites.csv");
  command->callback([o, command] { run_command(*o, *command); });
}

}  // namespace hbvm::core
