#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>

#include "clock.hpp"
#include "commands.hpp"
#include "compare_results.hpp"
#include "door/door.hpp"
#include "hbvm/reference.hpp"
#include "hbvm/version.hpp"
#include "long_work/cells.hpp"
#include "output_files.hpp"
#include "progress_bar.hpp"
#include "read_file.hpp"
#include "reference/check_proof.hpp"
#include "reference/compute_reference.hpp"
#include "reference/event_times.hpp"
#include "reference/literals.hpp"
#include "reference/store.hpp"
#include "scene/coordinate_names.hpp"
#include "scene/set_number.hpp"
#include "scene_argument.hpp"
#include "signals.hpp"

namespace hbvm::core {
namespace {

struct ReferenceArguments {
  std::optional<std::string> scene, until, route, out, verify, check, show, checkpoint;
  SceneArgument settings;  ///< what is set in the scene
  std::vector<std::string> at;
  ComparisonArguments against;
  int digits = 30;
  bool digits_given = false;
  bool json = false, list = false, force = false, prove = false;
};

Expression time_of(const std::string& text) { return expression_of(text, "a time of the reference:"); }

/// What `file`, if any, keeps of the way.
Reference compute(ReferenceRequest request, const std::optional<std::string>& file = {}) {
  ProgressBar bar("reference");
  std::optional<CellStore> store;
  std::mutex using_store;
  if (file) {
    store.emplace(*file);
    request.keeper.find = [&](const std::string& key) -> std::optional<std::string> {
      const std::lock_guard lock(using_store);
      const std::string* const found = store->find(key);
      return found ? std::optional(*found) : std::nullopt;
    };
    request.keeper.keep = [&](const std::string& key, const std::string& json) {
      const std::lock_guard lock(using_store);
      store->add(key, json);
    };
  }
  end_runs_on_signals();
  request.estimate = [](const Effort& effort) {
    constexpr double long_work = 60;
    if (effort.seconds > long_work)
      fmt::print(stderr, "route {}: about {}\n", effort.route, duration_text(effort.seconds));
  };
  request.progress =
      bar.part_done(file ? "the reference was not finished; the same command goes on from '" + *file + "'"
                         : "the reference was not finished: nothing is given out");
  return compute_reference(request);
}

/// Lines of a name and a number, the numbers below one another.
class Lines {
 public:
  void add(const std::string& symbol, const std::string& name, const std::string& value) {
    lines_.push_back({symbol, name, value});
    symbols_ = std::max(symbols_, symbol.size());
    names_ = std::max(names_, name.size());
  }
  void add_vector(const char* symbol, const std::vector<std::string>& names, const std::vector<std::string>& values) {
    for (std::size_t i = 0; i < values.size(); ++i)
      add(fmt::format("{}_{}", symbol, i + 1), i < names.size() ? names[i] : "", values[i]);
  }
  void print() const {
    for (const Line& line : lines_)
      fmt::print("  {:<{}}  {:<{}}  {}\n", line.symbol, symbols_, line.name, names_, line.value);
  }

 private:
  struct Line {
    std::string symbol, name, value;
  };
  std::vector<Line> lines_;
  std::size_t symbols_ = 0, names_ = 0;
};

void print(const Scene& scene, const Reference& r) {
  fmt::print("{}: {}\n", r.scene, r.title);
  for (const ReferenceState& state : r.times) {
    fmt::print("\nt = {}\n", state.t);
    Lines lines;
    lines.add_vector("q", coordinate_names(scene), state.q);
    lines.add_vector("p", coordinate_names(scene, "p"), state.p);
    lines.add_vector("lambda", {}, state.lambda);
    lines.add("H", "", state.H);
    for (std::size_t i = 0; i < state.momenta.size(); ++i) lines.add(r.momentum_names[i], "", state.momenta[i]);
    for (std::size_t i = 0; i < state.observed.size(); ++i) lines.add(r.observed_names[i], "", state.observed[i]);
    lines.print();
    if (state.radius)
      fmt::print(
          "{} digits after the leading one, proved: q is within {}, p {}, lambda {}, H {} of the number that was "
          "rounded\n",
          r.digits, state.radius->q, state.radius->p, state.radius->lambda, state.radius->H);
    else if (r.routes.size() > 1)
      fmt::print("{} digits after the leading one; the routes agree in {}\n", r.digits, state.agreed);
    else
      fmt::print("{} digits after the leading one, by one route: nothing confirms them\n", r.digits);
    if (state.digits_lost && &state != &r.times.back())
      fmt::print("an error of the start has grown by 10^{:.1f}\n", *state.digits_lost);
  }
  fmt::print("\n");
  for (const RouteReport& route : r.routes)
    fmt::print("{:<13}{}, {:.3g} s of processor time\n", route.name, route.settings, route.cpu_seconds);
  fmt::print("the motion magnifies an error of the start by 10^{:.1f}\n", r.digits_lost);
}

StoredReference stored_reference(const std::string& file) { return read_reference(read_file(file), file); }

/// How to read the first number in programs that compute with many digits.
void print_loading(const StoredReference& stored) {
  const Reference& r = stored.reference;
  const std::string x = r.times.back().q.front();
  const int digits = r.digits + 5;
  fmt::print("\nq_1 at t = {} elsewhere:\n", r.times.back().t);
  fmt::print("  Python   from mpmath import mp, mpf; mp.dps = {}; q1 = mpf(\"{}\")\n", digits, x);
  fmt::print("  Python   from decimal import Decimal, getcontext; getcontext().prec = {}; q1 = Decimal(\"{}\")\n",
             digits, x);
  fmt::print("  Julia    setprecision(BigFloat, {}); q1 = parse(BigFloat, \"{}\")\n", 10 * digits / 3 + 1, x);
  fmt::print("  Matlab   digits({}); q1 = vpa('{}')\n", digits, x);
  std::string power = x;
  if (const auto e = power.find('e'); e != std::string::npos) power.replace(e, 1, "*^");
  fmt::print("  Mathematica   q1 = SetPrecision[{}, {}]\n", power, digits);
}

void list_references() {
  for (const auto& [name, text] : shipped_references()) {
    const StoredReference stored = read_reference(text, name);
    std::string times;
    for (const ReferenceState& state : stored.reference.times) times += (times.empty() ? "" : ", ") + state.t;
    fmt::print("{:<36}t = {:<14}{:>5} digits{}\n", name, times, stored.reference.digits,
               stored.reference.proved > 0 ? ", proved" : "");
  }
}

/// \param out where the first of them is written for other programs, if it is to be
void show_references(const std::string& scene, const std::optional<std::string>& out) {
  bool found = false;
  for (const auto& [name, text] : shipped_references()) {
    const StoredReference stored = read_reference(text, name);
    if (stored.reference.scene != scene && name != scene) continue;
    const Scene own = load_scene(stored.reference.scene);
    if (out) {
      const std::optional<Language> language = language_of_file(*out);
      if (!language) throw InputError("reference --show: --out takes a name that ends with .csv, .jl, .py, .f90 or .h");
      Reference named = stored.reference;
      named.title = own.title;
      named.q_names = coordinate_names(own);
      named.p_names = coordinate_names(own, "p");
      return write_and_say(*out, to_literals(named, *language));
    }
    found = true;
    print(own, stored.reference);
    print_loading(stored);
  }
  if (!found) throw InputError("no reference of '" + scene + "' is shipped (see hbvm reference --list)");
}

void verify(const ReferenceArguments& o) {
  if (o.out && !o.prove) throw InputError("reference --verify: --out writes the file with what is proved, by --prove");
  const StoredReference stored = stored_reference(*o.verify);
  const Reference& r = stored.reference;
  ReferenceRequest request;
  request.scene = load_scene(o.scene.value_or(r.scene));
  request.digits = r.digits;
  if (o.route) request.only = parse_route(*o.route);
  request.prove = o.prove;
  request.force = o.force;
  if (scene_hash(request.scene) != r.scene_hash)
    throw InputError(*o.verify + ": scene '" + request.scene.name + "' is not the one it was made of: its hash is " +
                     scene_hash(request.scene) + ", not " + r.scene_hash);
  for (const ReferenceState& state : r.times) request.times.push_back(time_of(state.t));
  const Reference again = compute(request);
  const std::vector<Difference> found = differences(r, again);
  for (const Difference& d : found) fmt::print("t = {}: {} is {}, not {}\n", d.t, d.what, d.found, d.stored);
  if (!found.empty()) {
    fmt::print("{}: {} numbers differ\n", *o.verify, found.size());
    std::fflush(stdout);
    throw CLI::RuntimeError(1);
  }
  fmt::print("{}: all digits of {} times are {}\n", *o.verify, r.times.size(), o.prove ? "proved" : "found again");
  if (!o.out) return;
  StoredReference kept = stored;
  kept.reference.proved = again.proved;
  for (std::size_t n = 0; n < r.times.size(); ++n) kept.reference.times[n].radius = again.times[n].radius;
  std::erase_if(kept.reference.routes, [](const RouteReport& route) { return route.name == "proof"; });
  kept.reference.routes.push_back(again.routes.front());
  write_and_say(*o.out, to_toml(kept));
}

/// Goes through a proof again. The last line is what was proved.
void check(const ReferenceArguments& o) {
  if (o.scene || o.out) throw InputError("reference --check: scene, times and digits are those of the proof");
  const std::string text = read_file(*o.check);
  ProgressBar bar("check");
  end_runs_on_signals();
  const ProofFile file = read_proof(text, *o.check);
  const Reference r = check_proof(file, bar.part_done("the proof was not checked to its end"));
  if (o.json) {
    std::cout << to_json(r, "hbvm reference --check " + *o.check) << std::endl;
    return;
  }
  print(read_scene(file.proof.scene, r.scene), r);
  std::string times;
  for (const ReferenceState& state : r.times) times += (times.empty() ? "" : ", ") + state.t;
  fmt::print("\n{}: {} steps hold, each by itself\nproved: q, p, lambda and H of {} at t = {} to {} digits\n", *o.check,
             file.proof.steps.size(), r.scene, times, r.proved);
}

/// When the events come, in place of the end; each is said.
std::vector<Expression> times_of_events(ReferenceRequest request, const ReferenceArguments& o) {
  if (!o.at.empty() || !o.until)
    throw InputError("reference --event: --until says until when, and --at does not go with it");
  if (o.prove || o.route || o.checkpoint)
    throw InputError("reference --event: it takes two routes, and no --prove, --route or --checkpoint");
  ProgressBar bar("events");
  end_runs_on_signals();
  request.progress = bar.part_done("the events were not found: nothing is given out");
  std::vector<Expression> times;
  for (const EventTime& event : event_times(request)) {
    if (!o.json) fmt::print("event {}, {}: t = {}\n", event.name, event.rises ? "up" : "down", event.t.text());
    times.push_back(event.t);
  }
  if (times.empty()) throw InputError("reference --event: none comes until t = " + *o.until);
  return times;
}

bool is_proof(const std::string& file) { return file.ends_with(".proof"); }

void reference_command(const ReferenceArguments& o) {
  const auto loaded = [&] {
    return SceneArgument{*o.scene, o.settings.settings, o.settings.observations, o.settings.events}.load();
  };
  const auto scene = [&] { return scene_of(loaded()); };
  if (!o.against.files.empty()) {
    if (!o.scene)
      throw InputError("reference --against: a scene is missing, as in hbvm reference SCENE --against FILE.csv");
    if (o.until || !o.at.empty() || o.digits_given || o.route || o.out || o.checkpoint || o.prove || o.force)
      throw InputError(
          "reference --against compares at the times of the file, with as many digits as that takes: it "
          "goes with no --until, --at, --digits, --route, --out, --checkpoint, --prove or --force");
    return compare_results(loaded(), o.json, o.against);
  }
  o.against.refuse_alone();
  if (o.prove && (o.route || o.checkpoint))
    throw InputError("reference: --prove takes neither --route nor --checkpoint");
  if (o.out && is_proof(*o.out) && !o.prove)
    throw InputError("reference --out " + *o.out + ": a proof is made by --prove");
  if (o.list) return list_references();
  if (o.show) return show_references(*o.show, o.out);
  if (o.verify) return verify(o);
  if (o.check) return check(o);
  if (!o.scene) throw InputError("reference: a scene is missing (see hbvm reference --help)");
  if (!o.until && o.at.empty()) throw InputError("reference: --until or --at is missing");
  ReferenceRequest request;
  request.scene = scene();
  request.digits = o.digits;
  request.force = o.force;
  request.prove = o.prove;
  for (const std::string& text : o.at) request.times.push_back(time_of(text));
  if (o.at.empty()) request.times.push_back(time_of(*o.until));
  if (o.route) request.only = parse_route(*o.route);
  std::string command = "hbvm reference " + *o.scene + settings_in_command(request.scene);
  if (o.until) command += " --until " + *o.until;
  for (std::size_t i = 0; i < o.at.size(); ++i) command += (i == 0 ? " --at " : ",") + o.at[i];
  command += fmt::format(" --digits {}", o.digits);
  if (o.route) command += " --route " + *o.route;
  if (o.prove) command += " --prove";
  if (!o.settings.events.empty()) request.times = times_of_events(request, o);
  ProofFile file;
  if (o.out && is_proof(*o.out)) request.proof = &file.proof;
  const Reference reference = compute(request, o.checkpoint);
  if (o.out) {
    if (o.route) throw InputError("--out: what one route found alone is no reference");
    file.claim = {reference, version(), today()};
    const std::optional<Language> language = language_of_file(*o.out);
    write_and_say(*o.out, is_proof(*o.out) ? to_text(file)
                          : language       ? to_literals(reference, *language)
                                           : to_toml(file.claim));
  }
  if (o.json)
    std::cout << to_json(reference, command) << std::endl;
  else
    print(request.scene, reference);
}

}  // namespace

void add_reference_command(CLI::App& app) {
  auto o = std::make_shared<ReferenceArguments>();
  CLI::App* const command = app.add_subcommand("reference",
                                               "A solution with as many digits as asked for, each found by two routes "
                                               "that share only the scene, and by the closed "
                                               "form where there is one");
  command->add_option("SCENE,--scene", o->scene, "Scene file or built-in scene");
  o->settings.add_settings_to(*command);
  o->settings.add_observations_to(*command);
  command->add_option("--until", o->until, "Time of the state, as 10 or '2*pi'");
  command->add_option("--at", o->at, "Times T1,T2,... of the states instead, ascending")->delimiter(',');
  command->add_option("--digits", o->digits, "Digits after the leading one of each vector's greatest component")
      ->capture_default_str();
  command->add_option("--route", o->route, "taylor, hbvm or closed_form alone, which confirms nothing");
  command->add_option(
      "--out", o->out,
      "Write it to this file, in TOML; .csv, .jl, .py, .f90 and .h for other programs, also with --show; "
      "with --prove .proof, with what proves it");
  command->add_option("--checkpoint", o->checkpoint,
                      "Keep what is done in this file, some hundred steps at a time: the same command goes on from it");
  command->add_flag("--prove", o->prove,
                    "Prove the digits: bounds of the motion, step by step, in place of two routes that agree");
  command->add_flag("--force", o->force, "Do also what is expected to take more than a day, or 16 GB");
  command->add_flag("--json", o->json, "Print one JSON object and nothing else");
  command->add_flag("--list", o->list, "List the references that are shipped");
  command->add_option("--show", o->show, "Print those of a scene, and how to load them elsewhere");
  command->add_option("--verify", o->verify, "Compute the reference of this file again, and compare digit by digit");
  command->add_option("--check", o->check, "Go through the proof in this file again, each step by itself");
  add_comparison_options(*command, o->against);
  command->footer("Example: hbvm reference tethered_satellites --until 10 --digits 50");
  command->callback([o, command] {
    o->digits_given = command->count("--digits") > 0;
    reference_command(*o);
  });
}

}  // namespace hbvm::core
