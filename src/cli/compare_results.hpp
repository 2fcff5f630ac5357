#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace hbvm::core {

/// What `hbvm reference --against` is asked for.
struct ComparisonArguments {
  std::vector<std::string> files, map, steps;
  std::optional<std::string> plot;
  std::optional<double> order, digits;

  /// \throws InputError if there is any of it without files
  void refuse_alone() const;
};

void add_comparison_options(CLI::App& command, ComparisonArguments& arguments);

/// Compares the files with the reference and prints what is right.
/// \throws InputError as compare_with_reference() does; CLI::RuntimeError with exit code 1 if the order or the digits
/// that were asked for are not there
void compare_results(const Scene& scene, bool json, const ComparisonArguments& arguments);

}  // namespace hbvm::core
