#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hbvm::core {

/// A piece of long work under a key that no other has. Its result is JSON, the same whenever, wherever and beside
/// whatever it is made.
struct WorkCell {
  std::string key;
  std::function<std::string()> run;
};

/// The part of a list of cells that one of several computers does: every N-th.
struct Shard {
  int index = 1, of = 1;

  /// "3/7", counted from 1. \throws InputError
  static Shard parse(std::string_view text);
  bool has(std::size_t cell) const {
    return cell % static_cast<std::size_t>(of) + 1 == static_cast<std::size_t>(index);
  }
  std::string text() const { return std::to_string(index) + "/" + std::to_string(of); }
};

/// A file of results, a line a cell, {"key", "version", "result", "checksum"}. It grows as they come, so that a run
/// that was ended at any moment goes on from it. Put in order it is the same file however the work was divided.
class CellStore {
 public:
  /// A store without a file.
  CellStore() = default;
  /// A store with what the file holds, if it is there. Lines that were cut off or damaged, or that another version of
  /// the program wrote, are left out. \throws InputError if it cannot be written to
  explicit CellStore(std::filesystem::path file);

  /// The result under a key, or null.
  const std::string* find(const std::string& key) const;
  /// Appends a result, from any thread. \throws InputError if it cannot be written
  void add(const std::string& key, const std::string& result);

  /// Takes over another store's results. \throws InputError with file and line for one that is damaged, or of another
  /// version, and if there is no such file
  void merge(const std::filesystem::path& other);
  /// Writes the file anew, at once: the results of these keys in this order, then the others by their keys.
  /// \throws InputError if it cannot be written
  void put_in_order(const std::vector<std::string>& keys);

 private:
  std::filesystem::path file_;  ///< empty: none
  std::map<std::string, std::string> results_;
  std::mutex adding_;
};

/// Makes the results of these cells, by their places in the list, and hands over each as it comes, from any thread.
using TakeResult = std::function<void(std::size_t cell, std::string result)>;
using CellRunner = std::function<void(const std::vector<std::size_t>& cells, const TakeResult& take)>;

/// How a cell ended that ran apart from the others.
struct ProcessEnd {
  std::string text;     ///< its result
  std::string failure;  ///< if it has none: a crash, an exception, or no end in its time
  double cpu_seconds = 0;
};

/// Makes what runs cells apart from one another, so many at a time, each for so many seconds of processor time.
/// \param seconds of a cell, by its place; \param result made of how it ended
using RunApart =
    std::function<CellRunner(const std::vector<WorkCell>& cells, int jobs, std::function<double(std::size_t)> seconds,
                             std::function<std::string(std::size_t, const ProcessEnd&)> result)>;

struct CellOptions {
  int jobs = 1;  ///< threads, or processes
  Shard shard{};
  CellStore* store = nullptr;                ///< results known from before, to which new ones are added
  std::function<void(long, long)> progress;  ///< (cells done, of those of the shard)
};

/// Runs the cells of the shard that the store does not know, in threads. The first exception of one ends all once those
/// at work are done, and is thrown. What was made before is in the store, which is put in order in the end.
/// \return a result a cell, in order; none for cells of other shards that the store does not know either
std::vector<std::optional<std::string>> run_cells(const std::vector<WorkCell>& cells, const CellOptions& options);
/// Runs the cells by something else than threads. The runner minds the number of jobs itself.
std::vector<std::optional<std::string>> run_cells(const std::vector<WorkCell>& cells, const CellOptions& options,
                                                  const CellRunner& runner);

}  // namespace hbvm::core
