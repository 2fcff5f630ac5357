#include "audit_program.hpp"

#include <filesystem>
#include <map>

#include "compare_results.hpp"
#include "hbvm/error.hpp"
#include "processes/shell_command.hpp"
#include "progress_bar.hpp"
#include "read_file.hpp"
#include "signals.hpp"
#include "temporary_folder.hpp"
#include "write_file.hpp"

namespace hbvm::core {
namespace {

/// The command with texts in place of names in braces. Other braces stay.
std::string filled(const std::string& command, const std::map<std::string, std::string>& texts) {
  std::string result;
  for (std::size_t at = 0; at < command.size();) {
    const std::size_t end = command[at] == '{' ? command.find('}', at) : std::string::npos;
    const auto text = end == std::string::npos ? texts.end() : texts.find(command.substr(at + 1, end - at - 1));
    if (text == texts.end()) {
      result += command[at++];
    } else {
      result += text->second;
      at = end + 1;
    }
  }
  return result;
}

void expect_places(const std::string& command) {
  for (const char* const place : {"{scene}", "{step}", "{until}", "{out}"})
    if (command.find(place) == std::string::npos)
      throw InputError("--command: '" + command + "' has no " + place +
                       "; a command is like 'python3 mine.py {scene} {step} {until} {out}'");
}

}  // namespace

SolverAudit audit_program(const ProgramArguments& arguments) {
  expect_places(arguments.command);
  SolverRequest request{.name = arguments.command, .map = read_map(arguments.map), .order = arguments.order};
  for (const std::string& scene : arguments.scenes) request.scenes.push_back(load_scene(scene));
  if (arguments.until) request.until = Number(*arguments.until);
  const TemporaryFolder folder;
  request.solve = [&](const SolverTask& task) {
    const std::string scene = folder.file(task.scene.name() + ".toml"), out = folder.file("out.csv");
    write_file(scene, task.scene.toml());
    std::filesystem::remove(out);
    run_shell_command(
        filled(
            arguments.command,
            {{"scene", shell_quoted(scene)}, {"step", task.step}, {"until", task.until}, {"out", shell_quoted(out)}}),
        arguments.limit, folder.path() / "printed");
    if (!std::filesystem::is_regular_file(out))
      throw InputError("'" + arguments.command + "' wrote no file at the place of {out}");
    return read_file(out);
  };
  ProgressBar bar("audit");
  request.progress = bar.part_done("the program was not judged to the end");
  end_runs_on_signals();
  return audit_solver(request);
}

}  // namespace hbvm::core
