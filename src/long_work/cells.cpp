#include "long_work/cells.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <exception>
#include <fstream>
#include <future>
#include <mutex>

#include "beside.hpp"
#include "checksum.hpp"
#include "hbvm/error.hpp"
#include "hbvm/version.hpp"
#include "interruption.hpp"
#include "json.hpp"
#include "thread_caches.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view seal = ",\"checksum\":\"";

/// Without the end of the line.
std::string line_of(const std::string& key, const std::string& result) {
  std::string line = "{\"key\":" + dumped(key, -1) + ",\"version\":" + dumped(version(), -1) + ",\"result\":" + result;
  const std::string sum = Checksum(line).text();
  return line + std::string(seal) + sum + "\"}";
}

struct Line {
  std::string key, version, result;
};

/// Nothing for one that is damaged.
std::optional<Line> read_line(const std::string& text) {
  const std::size_t end = text.rfind(seal);
  if (end == std::string::npos) return std::nullopt;
  const std::string sealed = text.substr(0, end);
  if (text.substr(end) != std::string(seal) + Checksum(sealed).text() + "\"}") return std::nullopt;
  try {
    const OrderedJson json = OrderedJson::parse(text);
    return Line{json.at("key"), json.at("version"), dumped(json.at("result"), -1)};
  } catch (const OrderedJson::exception&) {
    return std::nullopt;
  }
}

void refuse_unless(bool written, const fs::path& file) {
  if (!written) throw InputError("cannot write '" + file.string() + "'");
}

}  // namespace

Shard Shard::parse(std::string_view text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.index);
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == '/') {
    const auto second = std::from_chars(first.ptr + 1, end, shard.of);
    if (second.ec == std::errc() && second.ptr == end && shard.index >= 1 && shard.index <= shard.of) return shard;
  }
  throw InputError("shard '" + std::string(text) + "': use I/N with whole numbers 1 <= I <= N, as 3/7");
}

CellStore::CellStore(fs::path file) : file_(std::move(file)) {
  {
    std::ifstream lines(file_);
    for (std::string text; std::getline(lines, text);)
      if (std::optional<Line> line = read_line(text); line && line->version == version())
        results_.insert_or_assign(std::move(line->key), std::move(line->result));
  }
  // The last line may have been cut off.
  std::ofstream store(file_, std::ios::app | std::ios::ate | std::ios::binary);
  if (store.tellp() > 0) store << '\n';
  refuse_unless(static_cast<bool>(store.flush()), file_);
}

const std::string* CellStore::find(const std::string& key) const {
  const auto place = results_.find(key);
  return place == results_.end() ? nullptr : &place->second;
}

void CellStore::add(const std::string& key, const std::string& result) {
  const std::lock_guard lock(adding_);
  if (!file_.empty()) {
    std::ofstream store(file_, std::ios::app | std::ios::binary);
    store << line_of(key, result) + '\n';
    refuse_unless(static_cast<bool>(store.flush()), file_);
  }
  results_.insert_or_assign(key, result);
}

void CellStore::merge(const fs::path& other) {
  std::ifstream lines(other);
  if (!lines) throw InputError("cannot read '" + other.string() + "'");
  long number = 0;
  for (std::string text; std::getline(lines, text);) {
    ++number;
    if (text.empty()) continue;
    std::optional<Line> line = read_line(text);
    const std::string place = other.string() + ":" + std::to_string(number) + ": ";
    if (!line) throw InputError(place + "the line is damaged: let this shard go on");
    if (line->version != version())
      throw InputError(place + "written by hbvm " + line->version + ", and this is " + version());
    results_.insert_or_assign(std::move(line->key), std::move(line->result));
  }
}

void CellStore::put_in_order(const std::vector<std::string>& keys) {
  if (file_.empty()) return;
  fs::path anew = file_;
  anew += ".new";
  std::ofstream store(anew, std::ios::binary | std::ios::trunc);
  std::map<std::string, std::string> others = results_;
  for (const std::string& key : keys) {
    if (const std::string* const result = find(key)) store << line_of(key, *result) << '\n';
    others.erase(key);
  }
  for (const auto& [key, result] : others) store << line_of(key, result) << '\n';
  store.close();
  refuse_unless(!store.fail(), anew);
  std::error_code failure;
  fs::rename(anew, file_, failure);
  refuse_unless(!failure, file_);
}

std::vector<std::optional<std::string>> run_cells(const std::vector<WorkCell>& cells, const CellOptions& options,
                                                  const CellRunner& runner) {
  std::vector<std::optional<std::string>> results(cells.size());
  std::vector<std::size_t> open;
  long done = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (const std::string* const known = options.store ? options.store->find(cells[i].key) : nullptr)
      results[i] = *known;
    if (!options.shard.has(i)) continue;
    if (results[i])
      ++done;
    else
      open.push_back(i);
  }
  const long total = done + static_cast<long>(open.size());
  if (options.progress) options.progress(done, total);

  std::mutex taking;
  runner(open, [&](std::size_t i, std::string result) {
    if (options.store) options.store->add(cells[i].key, result);
    const std::lock_guard lock(taking);
    results[i] = std::move(result);
    if (options.progress) options.progress(++done, total);
  });
  if (options.store) {
    std::vector<std::string> keys;
    for (const WorkCell& cell : cells) keys.push_back(cell.key);
    options.store->put_in_order(keys);
  }
  return results;
}

std::vector<std::optional<std::string>> run_cells(const std::vector<WorkCell>& cells, const CellOptions& options) {
  return run_cells(cells, options, [&](const std::vector<std::size_t>& open, const TakeResult& take) {
    std::atomic<std::size_t> next{0};
    std::mutex failing;
    std::exception_ptr error;
    const auto work = [&, asker = stop_request] {
      const StopScope scope(asker);
      const ThreadCaches freed;
      for (std::size_t n = next++; n < open.size(); n = next++) {
        try {
          end_if_asked("the work was not finished");
          take(open[n], cells[open[n]].run());
        } catch (...) {
          const std::lock_guard lock(failing);
          if (!error) error = std::current_exception();
          next = open.size();
        }
      }
    };
    std::vector<std::future<void>> others;
    for (int i = 1; i < options.jobs; ++i) others.push_back(std::async(beside, work));
    work();
    for (const std::future<void>& other : others) other.wait();
    if (error) std::rethrow_exception(error);
  });
}

}  // namespace hbvm::core
