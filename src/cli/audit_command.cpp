#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>

#include "audit/audit.hpp"
#include "audit/claims.hpp"
#include "audit/report.hpp"
#include "audit_program.hpp"
#include "commands.hpp"
#include "hbvm/error.hpp"
#include "hbvm/scheme.hpp"
#include "hbvm/version.hpp"
#include "interruption.hpp"
#include "long_work.hpp"
#include "long_work/json.hpp"
#include "method/method_spec.hpp"
#include "method/read_tableau.hpp"
#include "processes/draw.hpp"
#include "progress_bar.hpp"
#include "report/csvw.hpp"
#include "scalar/literal.hpp"
#include "scheme/scheme_text.hpp"
#include "signals.hpp"
#include "step/registry.hpp"
#include "step/tableau_method.hpp"
#include "write_file.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

struct AuditArguments {
  std::optional<std::string> claims, method, until, file, write, program, junit;
  std::vector<std::string> scenes, map;
  std::optional<int> order, embedded_order;
  double limit = AuditOptions().limit;
  bool quick = false, full = false, json = false;
  WorkArguments work{"findings.jsonl"};
};

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::vector<Claim> filtered(std::vector<Claim> claims, const std::string& filter) {
  const std::string wanted = lower(filter);
  std::string labels;
  for (const Claim& claim : claims)
    if (labels.find(claim.label + "; ") == std::string::npos) labels += claim.label + "; ";
  std::erase_if(claims, [&](const Claim& c) {
    const std::string all =
        readable(c.label) + "\n" + std::string(name_of(c.quantity)) + "\n" + c.problem + "\n" + c.method_text();
    return lower(all).find(wanted) == std::string::npos;
  });
  if (claims.empty())
    throw InputError("--claims: '" + filter + "' is no file and occurs in no claim; the claims are: " + labels);
  return claims;
}

/// A file with a tableau, or what parse_method reads.
std::vector<Claim> claims_about(const std::string& method) {
  const bool known = is_method_name(MethodSpec::parse(method).family);
  const bool names_a_file = method.ends_with(".toml") || method.find('/') != std::string::npos;
  if (fs::is_regular_file(method) || (!known && names_a_file)) return tableau_claims(read_tableau(method));
  const MethodPtr parsed = parse_method(method);
  const TableauMethod* const tableau = as_tableau(*parsed);
  if (tableau && tableau->formulation().on_constraints == OnConstraints::drift)
    return tableau_claims(tableau->tableau());
  return method_claims(parsed);
}

std::vector<Claim> claims_of(const AuditArguments& o) {
  std::vector<Claim> claims;
  const bool from_file = o.claims && fs::is_regular_file(*o.claims);
  if (from_file) {
    if (o.method) throw InputError("--method: a file of claims names its methods itself");
    return read_claims(*o.claims);
  }
  if (o.claims && (o.claims->ends_with(".toml") || o.claims->find('/') != std::string::npos))
    throw InputError("--claims: there is no file '" + *o.claims + "'");
  if (o.method) {
    claims = claims_about(*o.method);
  } else {
    const Extent extent = o.full ? Extent::full : Extent::quick;
    claims = paper_claims(extent);
    for (const std::vector<Claim>& more : {general_claims(extent), work_claims(extent), between_claims(extent)})
      claims.insert(claims.end(), more.begin(), more.end());
  }
  return o.claims ? filtered(std::move(claims), *o.claims) : claims;
}

/// \throws InputError
Expression time_from(const std::string& text) {
  try {
    Expression time = Expression::parse(text);
    if (evaluate<double>(time) > 0) return time;
  } catch (const ExpressionError& error) {
    throw InputError("--until: '" + text + "' is no time: " + error.what());
  }
  throw InputError("--until: '" + text + "' is no time after the start");
}

/// Whether this names a file of coefficients that are more than A, b and c of a Runge-Kutta method. What is wrong with
/// a file is for its reader to say.
bool is_other_scheme(const std::string& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  try {
    const SchemeText text = read_scheme_text(file);
    const auto is_plain = [](const auto& array) {
      return array.first == "A" || array.first == "b" || array.first == "c";
    };
    return fs::path(file).extension() != ".toml" || !text.family.empty() ||
           !std::all_of(text.arrays.begin(), text.arrays.end(), is_plain);
  } catch (const InputError&) {
    return false;
  }
}

/// Those of coefficients in a folder, and in folders within.
std::vector<std::string> scheme_files(const std::string& folder) {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && (entry.path().extension() == ".toml" || entry.path().extension() == ".json"))
      files.push_back(entry.path().string());
  if (files.empty()) throw InputError(folder + ": there is no .toml or .json file in it");
  std::sort(files.begin(), files.end());
  return files;
}

/// Holds all coefficients of a folder against their conditions, a line each.
void atlas_command(const AuditArguments& o, const std::string& folder) {
  if (o.write || o.junit || o.order || o.embedded_order)
    throw InputError("FILE: of a folder no --write, --junit, --order or --embedded-order can be");
  ProgressBar bar(folder);
  const std::vector<std::string> files = scheme_files(folder);
  OrderedJson list = OrderedJson::array();
  bool holds = true;
  for (std::size_t n = 0; n < files.size(); ++n) {
    end_if_asked("the folder was not gone through to its end");
    bar.update(static_cast<long>(n), static_cast<long>(files.size()));
    const SchemeAudit found = audit_scheme({.file = files[n]});
    holds = holds && found.holds;
    if (o.json)
      list.push_back(OrderedJson::parse(to_json(found)));
    else
      std::cout << to_line(found) << std::endl;
  }
  if (o.json) std::cout << dumped(list, 2) << std::endl;
  if (!holds) throw CLI::RuntimeError(1);
}

/// Holds the coefficients in a file against their conditions.
void scheme_command(const AuditArguments& o, const std::string& file) {
  if (o.claims || o.quick || o.full || o.until || o.work.out || o.work.is_divided())
    throw InputError("FILE: coefficients are held against their conditions alone; --claims, --quick, --full, --until " +
                     std::string("and --out are for audits that make runs"));
  end_runs_on_signals();
  if (std::error_code ignored; fs::is_directory(file, ignored)) return atlas_command(o, file);
  const SchemeAudit found = audit_scheme({.file = file, .order = o.order, .embedded_order = o.embedded_order});
  if (o.write) {
    if (found.mended.empty())
      throw InputError("--write: there is nothing to mend" +
                       (found.repair_says.empty() ? std::string() : ": " + found.repair_says));
    write_file(*o.write, found.mended);
  }
  if (o.junit) write_file(*o.junit, to_junit(found));
  if (o.json)
    std::cout << to_json(found) << std::endl;
  else
    std::cout << (o.order || o.embedded_order ? to_line(found) + "\n" : to_text(found)) << std::flush;
  if (!found.holds) throw CLI::RuntimeError(1);
}

/// Holds a program against references, by its runs.
void program_command(const AuditArguments& o) {
  if (o.file || o.method || o.claims || o.quick || o.full || o.write || o.embedded_order || o.work.out ||
      o.work.is_divided())
    throw InputError("--command: a program is judged by --order, --scene, --until, --map and --limit alone");
  const SolverAudit found = audit_program(
      {.command = *o.program, .scenes = o.scenes, .map = o.map, .order = o.order, .until = o.until, .limit = o.limit});
  if (o.junit) write_file(*o.junit, to_junit(found));
  std::cout << (o.json ? to_json(found) + "\n" : to_text(found)) << std::flush;
  if (!found.holds) throw CLI::RuntimeError(1);
  if (!found.decided) throw CLI::RuntimeError(4);
}

void audit_command(const AuditArguments& o) {
  if (o.program) return program_command(o);
  if (!o.scenes.empty() || !o.map.empty()) throw InputError("--scene and --map are for a program: --command");
  if (o.file && o.method) throw InputError("FILE and --method: name one of them");
  if (o.file) return scheme_command(o, *o.file);
  if (o.method && is_other_scheme(*o.method)) return scheme_command(o, *o.method);
  if (o.order || o.embedded_order || o.write)
    throw InputError("--order, --embedded-order and --write are for a FILE of coefficients: hbvm audit FILE --order 4");
  const std::vector<Claim> claims = claims_of(o);
  std::string command = "hbvm audit";
  if (o.method) command += " --method " + *o.method;
  if (o.claims) command += " --claims '" + *o.claims + "'";
  if (o.full || o.quick) command += o.full ? " --full" : " --quick";
  if (o.until) command += " --until '" + *o.until + "'";
  command += o.work.provenance();
  if (o.limit != AuditArguments().limit) command += fmt::format(" --limit {}", o.limit);

  const std::optional<fs::path> folder = o.work.make_folder();
  if (folder) write_file(*folder / "audit.csv", "this audit is not finished\n");
  AuditOptions options;
  options.starts = o.full ? 3 : 2;
  options.limit = o.limit;
  if (o.until) options.until = time_from(*o.until);
  std::vector<Finding> findings;
  {
    LongWork work(o.work, o.full || o.work.is_divided() ? folder : std::nullopt, "audit", options);
    findings = audit(claims, options);
  }
  if (o.junit) write_file(*o.junit, to_junit(findings, command));
  Table table = audit_table(findings);
  table.provenance = {std::string("hbvm ") + version(), "command " + command, summary(findings)};
  if (folder) {
    Table with_reasons = audit_table(findings, true);
    with_reasons.provenance = table.provenance;
    write_csv((*folder / "audit.csv").string(), with_reasons);
    write_file(*folder / "audit.md", to_markdown(table));
    write_file(*folder / "audit.tex", to_latex(table));
    // It explains the audit of the paper.
    if (!o.claims && !o.method) draw(audit_figure(folder->string()), (*folder / "orders.svg").string());
  }
  if (o.json) {
    std::cout << to_json(findings, command) << std::endl;
  } else {
    fmt::print("{}", to_text(table));
    for (const Finding& f : findings)
      if (f.verdict != Verdict::holds || f.claim.quantity == Quantity::order_conditions)
        fmt::print("{}: {} of {} on {}: {}\n", name_of(f.verdict), name_of(f.claim.quantity), f.claim.method_text(),
                   f.claim.problem, f.reason);
    fmt::print("{}\n", summary(findings));
    if (folder) fmt::print("written to {}\n", folder->string());
    std::fflush(stdout);
  }
  const auto any = [&](const auto& is) { return std::any_of(findings.begin(), findings.end(), is); };
  if (any([](const Finding& f) { return f.verdict == Verdict::fails; })) throw CLI::RuntimeError(1);
  if (any([](const Finding& f) { return f.verdict != Verdict::holds; })) throw CLI::RuntimeError(4);
}

}  // namespace

void add_audit_command(CLI::App& app) {
  auto o = std::make_shared<AuditArguments>();
  CLI::App* const command =
      app.add_subcommand("audit", "Decide the paper's claims, or your own, with as many digits as it takes");
  command->add_option("FILE", o->file,
                      "Hold the coefficients in this file against their order conditions, and find a wrong entry: "
                      "TOML, JSON or a printed tableau, of any family, or a folder of such files; no runs are made");
  command->add_option(
      "--order", o->order,
      "The order that the coefficients of FILE should have, and the answer is one line; or that of --command");
  command->add_option("--embedded-order", o->embedded_order, "That of its embedded weights");
  command->add_option("--write", o->write, "Write the mended coefficients of FILE into this TOML file");
  command->add_option(
      "--command", o->program,
      "Judge a program of yours by its runs of scenes, as 'python3 mine.py {scene} {step} {until} "
      "{out}': it reads a scene file and writes a CSV with t and coordinates; --order claims its order");
  command->add_option("--scene", o->scenes, "Scenes for --command (if absent, simple, conical and double pendulum)");
  command->add_option("--map", o->map, "What columns of its CSV are: theirs=ours, with commas between")->delimiter(',');
  command->add_option("--junit", o->junit, "Write the verdicts into this XML file, too, for services that run tests");
  command->add_option("--claims", o->claims,
                      "Only claims whose label, quantity, problem or method holds this text; or a TOML file of claims");
  auto* const quick = command->add_flag("--quick", o->quick, "s = 1, 2, 3 (default): about a minute");
  command->add_flag("--full", o->full, "s = 1 .. 8, 12 and 20, every problem: a third of an hour, see --out")
      ->excludes(quick);
  command->add_option("--method", o->method,
                      "Audit the Runge-Kutta tableau in this TOML file (A, b, c as exact text), or what a method "
                      "says of itself: " +
                          method_usage());
  o->work.add_to(*command,
                 "Folder for the table (CSV, Markdown, LaTeX) and, of all the paper's claims, a figure; nothing is "
                 "written without; "
                 "--full goes on from what it finds there",
                 "Threads");
  command->add_option(
      "--until", o->until,
      "Look at all of the motion up to this time, in the scene's units (if absent, at half of the time in "
      "which it changes, from two or three states); takes longer in proportion");
  command
      ->add_option(
          "--limit", o->limit,
          "Seconds of processor time that a claim may take before it is undecidable, 0: any; claims that share "
          "their runs share their time; seconds of one run of --command")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_flag("--json", o->json, "Print one JSON object and nothing else");
  command->footer(
      "Exit code 0 if all claims hold, 1 if one fails, 4 if none fails but some are undecidable, of a degenerate "
      "motion or\n"
      "could not be run. A file of claims: tables [[claim]] with quantity, problem, method and rate, as\n"
      "  quantity = \"raw p\", problem = \"double_pendulum\", method = \"hbvm:3,2\", rate = \"2*s\"; a tableau:\n"
      "  A = [[\"1/4\", \"1/4-sqrt(3)/6\"], [\"1/4+sqrt(3)/6\", \"1/4\"]], b = [\"1/2\", \"1/2\"], c if it is not the "
      "row sums,\n"
      "  order = 4 if you claim one, digits = 30 if its numbers are decimals rounded to so many (guessed if absent).\n"
      "See studies/orders_beyond_round_off.\n"
      "Example: hbvm audit --claims evaik --out audit");
  command->callback([o] { audit_command(*o); });
}

}  // namespace hbvm::core
