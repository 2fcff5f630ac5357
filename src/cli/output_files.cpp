#include "output_files.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "hbvm/error.hpp"
#include "write_file.hpp"

namespace hbvm::core {

void say_written(const std::string& file) { fmt::print(stderr, "written to {}\n", file); }

void say_written_together(const std::vector<std::string>& files) {
  std::string names;
  for (const std::string& file : files)
    names += (names.empty() ? "" : ", ") + std::filesystem::path(file).filename().string();
  if (!files.empty()) say_written(std::filesystem::path(files.front()).parent_path().string() + ": " + names);
}

void write_and_say(const std::filesystem::path& file, const std::string& text) {
  write_file(file, text);
  say_written(file.string());
}

void refuse_dash(const std::string& option, const std::string& file) {
  if (file == "-") throw InputError(option + ": name a file; standard output has what is said of the run");
}

bool has_neighbours(const std::string& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored);
}

}  // namespace hbvm::core
