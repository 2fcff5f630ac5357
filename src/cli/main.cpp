#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "commands.hpp"
#include "hbvm/error.hpp"
#include "hbvm/version.hpp"
#include "interruption.hpp"
#include "nearest.hpp"
#include "reference/taylor_method.hpp"
#include "unexpected_word.hpp"

namespace {

enum Exit { ok = 0, failed = 1, bad_input = 2, integration_failed = 3, signalled = 128 };

/// One line on standard error, whatever the text holds.
int report(int code, std::string what) {
  for (char& c : what)
    if (c == '\n' || c == '\r') c = ' ';
  std::cerr << "hbvm: " << what << '\n';
  return code;
}

}  // namespace

// Commands whose options clash would end the program here.
int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape)
  CLI::App app{"Energy-conserving integration of constrained mechanics, HBVM(k,s), at any precision."};
  hbvm::core::add_taylor_method();
  app.require_subcommand(1);
  app.set_version_flag("--version", hbvm::version());
  app.footer("Example: hbvm run modified_pendulum --method hbvm:4,2 --step 1/16 --until 20 --precision mpfr:50 --json");
  for (const auto add :
       {hbvm::core::add_run_command, hbvm::core::add_nodes_command, hbvm::core::add_scenes_command,
        hbvm::core::add_methods_command, hbvm::core::add_scene_command, hbvm::core::add_compare_command,
        hbvm::core::add_convergence_command, hbvm::core::add_study_command, hbvm::core::add_audit_command,
        hbvm::core::add_stability_command, hbvm::core::add_reference_command, hbvm::core::add_cost_command,
        hbvm::core::add_tangent_command, hbvm::core::add_section_command, hbvm::core::add_periodic_command,
        hbvm::core::add_report_command, hbvm::core::add_lesson_command, hbvm::core::add_completion_command,
        hbvm::core::add_help_command})
    add(app);
  try {
    const CLI::App* command = &app;
    for (int i = 1; i < argc && argv[i][0] != '-' && command->get_require_subcommand_min() > 0; ++i)
      command = hbvm::core::find_command(*command, argv[i]);
    if (argc > 1 && argv[1][0] == '-' && !app.get_option_no_throw(argv[1]))
      throw hbvm::InputError("unknown option '" + std::string(argv[1]) + "' before a command" +
                             hbvm::core::did_you_mean(argv[1], hbvm::core::option_names(app)) + " (see hbvm --help)");
    app.parse(argc, argv);  // runs the subcommand
    return ok;
  } catch (const CLI::Success& request) {  // --help, --version
    return app.exit(request);
  } catch (const CLI::RuntimeError& finding) {  // a check that did not hold, already reported
    return finding.get_exit_code();
  } catch (const CLI::ParseError& error) {
    const std::string unexpected = hbvm::core::unexpected_word(app);  // comes before what is missing for its sake
    return report(bad_input, unexpected.empty() ? std::string(error.what()) + " (see hbvm --help)" : unexpected);
  } catch (const hbvm::InputError& error) {
    return report(bad_input, error.what());
  } catch (const hbvm::Interrupted& end) {
    return report(signalled + end.signal(), end.what());
  } catch (const hbvm::Error& error) {
    return report(integration_failed, error.what());
  } catch (const std::bad_alloc&) {
    return report(bad_input, "the request needs more memory than there is: use fewer digits, stages or bodies");
  } catch (const std::exception& error) {
    return report(failed, error.what());
  }
}
