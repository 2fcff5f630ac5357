#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hbvm/results.hpp"

namespace hbvm::core {

/// What `hbvm reference --against` is asked for.
struct ComparisonArguments {
  std::vector<std::string> files, map, steps, plots;
  std::optional<double> order, digits;
  bool cost = false;

  /// \throws InputError if there is any of it without files
  void refuse_alone() const;
};

/// "theirs=ours", each. A comma within parentheses divides nothing. \throws InputError
std::vector<std::pair<std::string, std::string>> read_map(const std::vector<std::string>& parts);

void add_comparison_options(CLI::App& command, ComparisonArguments& arguments);

/// Compares the files with the reference and prints what is right.
/// \throws InputError as compare_results() of hbvm/results.hpp does; CLI::RuntimeError with exit code 1 if the order or
/// the digits that were asked for are not there
void compare_results(const hbvm::Scene& scene, bool json, const ComparisonArguments& arguments);

}  // namespace hbvm::core
