#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include "commands.hpp"
#include "door/run_of.hpp"
#include "hbvm/version.hpp"
#include "integrate/time_grid.hpp"
#include "interruption.hpp"
#include "output_files.hpp"
#include "picture_file.hpp"
#include "progress_bar.hpp"
#include "read_file.hpp"
#include "resume.hpp"
#include "run/error_estimate.hpp"
#include "run/health.hpp"
#include "run/run_figure.hpp"
#include "run/run_page.hpp"
#include "run/scene_run.hpp"
#include "run/shadow.hpp"
#include "run/trajectory_metadata.hpp"
#include "scalar/text.hpp"
#include "scene/coordinate_names.hpp"
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
  long every = 1;
  bool json = false, account = false, strict = false, shadow = false, reverse = false, error = false;
  bool states = false;
  std::optional<std::string> checkpoint, resume;
  double every_seconds = 60;
  std::optional<Checkpoint> resumed;
  bool scene_given = true, start_given = true;  ///< now, and not only when the checkpoint was written
};

/// A vector of the state: its symbol, and what its components are called in tables if they have names there.
struct Quantity {
  std::string symbol;
  std::vector<std::string> names = {};
};

std::size_t widest(const std::vector<std::string>& texts) {
  std::size_t width = 0;
  for (const std::string& text : texts) width = std::max(width, text.size());
  return width;
}

/// Lines "q_1  upper.x  0.123  15.2 digits", with the digits of the value where they are known.
void print_list(const Quantity& quantity, const std::vector<std::string>& values,
                const std::vector<double>& digits = {}) {
  const std::size_t of_names = widest(quantity.names), of_values = digits.empty() ? 0 : widest(values);
  for (std::size_t i = 0; i < values.size(); ++i)
    fmt::print("  {:<{}}{:<{}}{:<{}}{}\n", fmt::format("{}_{}", quantity.symbol, i + 1), of_names > 0 ? 7 : 15,
               i < quantity.names.size() ? quantity.names[i] : "",
               of_names > 0 ? std::max<std::size_t>(of_names + 2, 8) : 0, values[i], of_values,
               digits.empty() ? "" : fmt::format("  {:.1f} digits", digits[i]));
}

/// Values with the digits that are right and one more.
void print_right_digits(const Quantity& quantity, std::vector<std::string> values, const std::vector<double>& digits) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = to_right_digits(values[i], digits[i]);
  print_list(quantity, values, digits);
}

/// The state at the end, to the digits that are right if they are known.
void print_state(const Scene& scene, const Run& result) {
  const Quantity q{"q", coordinate_names(scene)}, p{"p", coordinate_names(scene, "p")}, lambda{"lambda"};
  fmt::print("state at t = {}\n", result.t);
  const char* const of_output =
      "output state: p projected to the tangent space, and the multiplier there; its energy is off by {}\n";
  if (result.error && result.error->failure.empty()) {
    const ErrorEstimate& error = *result.error;
    print_right_digits(q, result.q, error.q_digits);
    if (!result.lambda.empty()) fmt::print(fmt::runtime(of_output), to_scientific(result.output_delta_H, 3));
    print_right_digits(p, result.output_p, error.p_digits);
    print_right_digits(lambda, result.output_lambda, error.lambda_digits);
    fmt::print("{}", to_text(error));
    return;
  }
  const Shadow shadow = result.shadow.value_or(Shadow{});
  print_list(q, result.q, shadow.q);
  print_list(p, result.p, shadow.p);
  print_list(lambda, result.lambda);
  if (!result.lambda.empty()) {
    fmt::print(fmt::runtime(of_output), to_scientific(result.output_delta_H, 3));
    print_list(p, result.output_p);
    print_list(lambda, result.output_lambda);
  }
  fmt::print("{}", result.error ? to_text(*result.error) : "digits not assessed (--error)\n");
}

/// What was raised, and to how many.
std::string nodes_of(const NodesReport::Raise& raise) {
  return raise.r > 0 ? fmt::format("r = {}", raise.r) : fmt::format("{}", raise.k);
}

void print(const RunRequest& request, const Run& result, const Account& account) {
  if (result.nodes) {
    fmt::print("k = {}{}: {}\n", result.nodes->k, result.nodes->r > 0 ? fmt::format(", r = {}", result.nodes->r) : "",
               result.nodes->because);
    const auto& raised = result.nodes->raised;
    if (!raised.empty())
      fmt::print("raised to {}, {} times, first to {} in the step from t = {}\n", nodes_of(raised.back()),
                 raised.size(), nodes_of(raised.front()), raised.front().t);
    fmt::print("{}\n", result.nodes->verdict);
  }
  if (result.halving) {
    const HalvingReport& halving = *result.halving;
    if (halving.steps == 0)
      fmt::print("no step was divided\n");
    else
      fmt::print("{} divided, down to h/{}, first at t = {}\n",
                 halving.steps == 1 ? "1 step was" : fmt::format("{} steps were", halving.steps), 1L << halving.depth,
                 halving.first_t);
  }
  fmt::print("{}: {}\n", result.scene, result.title);
  fmt::print("{}, {}, solver {}, {} steps of {}\n\n", result.method, result.precision, result.solver, result.steps,
             result.step);
  if (!result.start_settled.empty()) fmt::print("the start is {}\n", result.start_settled);
  print_state(request.scene, result);
  fmt::print("greatest errors at mesh points\n");
  const auto error = [](const char* what, const char* symbol, const std::string& value) {
    fmt::print("  {:<20}{:<8}{}\n", what, symbol, to_scientific(value, 3));
  };
  error("energy", "e_H", result.e_H);
  if (!result.lambda.empty()) {
    error("constraints", "e_g", result.e_g);
    error("hidden constraints", "e_hid", result.e_hid);
  }
  fmt::print("{}", to_text(result.health));
  if (result.shadow) fmt::print("{}", to_text(*result.shadow));
  if (!result.observables.empty()) fmt::print("conserved by the exact motion\n");
  for (const Observed& o : result.observables)
    fmt::print("  {:<14} {}, changed by up to {}\n", o.name, o.initial, o.drift);
  if (!result.observations.empty()) fmt::print("observed at the end\n");
  for (const Observation& o : result.observations) fmt::print("  {:<20} {}\n", o.name, o.value);
  fmt::print("cost\n  {:.2f} iterations per step, {:.3f} s of processor time\n", result.iterations_per_step,
             result.cpu_seconds);
  if (request.account) fmt::print("\n{}", to_text(account));
}

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

hbvm::RunRequest asked_of(const RunArguments& o, const RunIdentity& identity) {
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
          .error = o.error,
          .start = identity.start};
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
                [&] { return run_page(request, recording_, command); });
  }

 private:
  PictureFile file_;
  Recording recording_;
};

void run_command(const RunArguments& o, const CLI::App& command) {
  if (o.every < 1 || o.every > TimeGrid<double>::max_steps)
    throw InputError("--every " + std::to_string(o.every) + " is not between 1 and 10^12");
  if (!(o.every_seconds >= 0)) throw InputError("--every-seconds is negative");
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
  std::stringstream lines;
  if (o.states) hooks.trajectory = &lines;
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
    result.trajectory = trajectory_of(lines);
    if (o.json)
      std::cout << to_json(result, o.states) << std::endl;
    else
      print(request, result, account);
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
  command->add_option("--until", o->until, "Final time, a multiple of the step")->required();
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
      "Draw motion, multipliers and errors into this file: .svg, .pdf or .png; as .html the motion moves");
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
  command->add_flag("--shadow", o->shadow,
                    "Repeat the run with 16 more digits and say how many of each component survived rounding");
  command->add_flag("--json", o->json, "Print one JSON object and nothing else");
  command->add_flag("--states", o->states, "Also put the mesh points into the JSON object, of --every steps one");
  command->footer(
      "Example: hbvm run tethered_satellites --method hbvm:5,1 --step 0.1 --until 100 --out satellites.csv");
  command->callback([o, command] { run_command(*o, *command); });
}

}  // namespace hbvm::core
