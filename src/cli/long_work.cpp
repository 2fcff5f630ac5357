#include "long_work.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <thread>

#include "file_lock.hpp"
#include "hbvm/error.hpp"
#include "output_files.hpp"

namespace hbvm::core {

namespace fs = std::filesystem;

namespace {

std::string shard_flaw(const std::string& text) {
  try {
    Shard::parse(text);
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

WorkArguments::WorkArguments(std::string file)
    : store(std::move(file)), jobs(static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))) {}

void WorkArguments::add_to(CLI::App& command, const std::string& help_of_out, const std::string& workers) {
  command.add_option("--out", out, help_of_out);
  auto* const one_of = command
                           .add_option("--shard", shard,
                                       "I/N: every N-th piece of the work, from the I-th on, for one of N computers; "
                                       "its results go to " +
                                           store + " in --out")
                           ->check(shard_flaw);
  command
      .add_option(
          "--merge", merge,
          "The " + store + " of all shards, of the same work and options: ends in the same files as one run does")
      ->excludes(one_of);
  command.add_option("--jobs", jobs, workers)->check(CLI::Range(1, 1024))->capture_default_str();
}

std::optional<fs::path> WorkArguments::make_folder() const {
  if (!out) return std::nullopt;
  refuse_dash("--out", *out);
  std::error_code failure;
  fs::create_directories(*out, failure);
  if (failure) throw InputError("--out: cannot make the folder '" + *out + "': " + failure.message());
  // Held to the end of the program: two at once would mix their results.
  static std::map<fs::path, FileLock> held;
  try {
    held.try_emplace(fs::canonical(*out), *out);
  } catch (const InputError& error) {
    throw InputError(std::string("--out: ") + error.what());
  }
  return out;
}

LongWork::LongWork(const WorkArguments& arguments, const std::optional<fs::path>& folder, const std::string& title,
                   CellOptions& options)
    : arguments_(arguments), bar_(title) {
  if (arguments.is_divided() && !folder) throw InputError("--out is needed: the folder for " + arguments.store);
  if (folder) store_.emplace(*folder / arguments.store);
  for (const std::string& file : arguments.merge) store_->merge(file);
  options.jobs = arguments_.jobs;
  if (arguments_.shard) options.shard = Shard::parse(*arguments_.shard);
  if (store_) options.store = &*store_;
  options.progress = [this](long done, long total) {
    if (!arguments_.merge.empty() && done < total)
      throw InputError(fmt::format("--merge: {} of {} pieces of work are in none of these files", total - done, total));
    bar_.update(done, total);
  };
}

}  // namespace hbvm::core
