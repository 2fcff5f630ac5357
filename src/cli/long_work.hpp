#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "long_work/cells.hpp"
#include "progress_bar.hpp"

namespace hbvm::core {

/// What a user says of long work, in the same words for every command.
struct WorkArguments {
  std::string store;  ///< name of the file of results in --out
  std::optional<std::string> out, shard;
  std::vector<std::string> merge;
  int jobs;

  explicit WorkArguments(std::string file);

  /// Adds --out with this help, --shard, --merge and --jobs, of threads or processes.
  void add_to(CLI::App& command, const std::string& help_of_out, const std::string& workers);
  bool is_divided() const { return shard || !merge.empty(); }
  /// Makes the folder that --out says, if it does. \throws InputError if that cannot be done
  std::optional<std::filesystem::path> make_folder() const;
  /// What of these options is told of results: " --shard 3/7", or nothing.
  std::string provenance() const { return shard ? " --shard " + *shard : ""; }
};

/// Long work as its arguments ask for it, with a progress bar as long as this lives.
class LongWork {
 public:
  /// Sets threads, shard, store and progress of the options, for as long as this lives.
  /// \param folder where results are kept and found again; if absent they are not \throws InputError
  LongWork(const WorkArguments& arguments, const std::optional<std::filesystem::path>& folder, const std::string& title,
           CellOptions& options);
  LongWork(const LongWork&) = delete;

 private:
  const WorkArguments& arguments_;
  std::optional<CellStore> store_;
  ProgressBar bar_;
};

}  // namespace hbvm::core
