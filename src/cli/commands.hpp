#pragma once

#include <CLI/CLI.hpp>

namespace hbvm::core {

/// Each adds one subcommand to the program; its callback does the work and throws on failure.
void add_run_command(CLI::App& app);
void add_nodes_command(CLI::App& app);
void add_scenes_command(CLI::App& app);
void add_methods_command(CLI::App& app);
void add_scene_command(CLI::App& app);
void add_convergence_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_study_command(CLI::App& app);
void add_audit_command(CLI::App& app);
void add_stability_command(CLI::App& app);
void add_reference_command(CLI::App& app);
void add_cost_command(CLI::App& app);
void add_report_command(CLI::App& app);
void add_lesson_command(CLI::App& app);
void add_tangent_command(CLI::App& app);
void add_section_command(CLI::App& app);
void add_periodic_command(CLI::App& app);
void add_help_command(CLI::App& app);
void add_completion_command(CLI::App& app);

}  // namespace hbvm::core
