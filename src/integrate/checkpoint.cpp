#include "integrate/checkpoint.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "checksum.hpp"
#include "clock.hpp"
#include "hbvm/error.hpp"
#include "read_file.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

const std::string magic = "hbvm checkpoint ";
const std::string format = "4";
const std::string checksum_key = "checksum ";

std::string why() { return std::strerror(errno); }

/// Writes and puts on the disk. \return why that failed, empty if it did not
std::string write_whole(const std::string& file, const std::string& text) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) return why();
  std::string failure;
  for (std::size_t done = 0; done < text.size() && failure.empty();) {
    const ssize_t written = write(descriptor, text.data() + done, text.size() - done);
    if (written >= 0)
      done += static_cast<std::size_t>(written);
    else if (errno != EINTR)
      failure = why();
  }
  if (failure.empty() && fsync(descriptor) != 0) failure = why();
  if (close(descriptor) != 0 && failure.empty()) failure = why();
  return failure;
}

/// Puts the new name of a file on the disk, where folders allow it.
void sync_folder(const fs::path& folder) {
  const int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

/// What stands in the way of a checkpoint is not overwritten, unless it is one.
void expect_replaceable(const std::string& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return;
  std::ifstream there(file, std::ios::binary);
  std::string start(magic.size(), '\0');
  there.read(start.data(), static_cast<std::streamsize>(start.size()));
  const bool empty = fs::is_regular_file(file, ignored) && there.gcount() == 0;
  if (!empty && start != magic) throw InputError("--checkpoint: '" + file + "' is there and is no checkpoint");
}

}  // namespace

void RunIdentity::remember(Archive& archive) {
  auto count = static_cast<long>(options.size());
  archive(program, scene_name, scene, start, count);
  if (archive.reading()) options.assign(static_cast<std::size_t>(count), {});
  for (auto& [name, text] : options) archive(name, text);
}

void write_checkpoint(const std::string& file, const Checkpoint& checkpoint) {
  expect_replaceable(file);
  Archive archive;
  RunIdentity identity = checkpoint.identity;
  std::string state = checkpoint.state;
  archive(identity, state);
  std::string text = magic + format + "\n" + archive.text();
  text += checksum_key + Checksum(text).text() + "\n";
  const std::string part = file + ".part";
  std::string failure = write_whole(part, text);
  if (failure.empty() && std::rename(part.c_str(), file.c_str()) != 0) failure = why();
  if (!failure.empty()) {
    unlink(part.c_str());
    throw InputError("--checkpoint: cannot write '" + file + "': " + failure);
  }
  sync_folder(fs::path(file).parent_path());
}

Checkpoint read_checkpoint(const std::string& file) {
  const auto refuse = [&](const std::string& reason) { throw InputError("--resume: '" + file + "' " + reason); };
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) refuse("is no file");
  const std::string text = read_file(file);
  if (text.empty()) refuse("is empty");
  if (!text.starts_with(magic)) refuse("is no checkpoint: it does not begin with '" + magic + "'");

  const std::size_t trailer = checksum_key.size() + Checksum().text().size() + 1;
  const std::size_t first = text.find('\n');
  if (first == std::string::npos || text.size() < first + 1 + trailer) refuse("is damaged: it is cut off");
  const std::string contents = text.substr(0, text.size() - trailer), last = text.substr(contents.size());
  const std::string written_as = text.substr(magic.size(), first - magic.size());
  if (last != checksum_key + Checksum(contents).text() + "\n")
    refuse(written_as != format && last.starts_with(checksum_key)
               ? "is damaged, or of a format this program does not know"
               : std::string("is damaged: ") +
                     (last.starts_with(checksum_key) ? "its checksum is another" : "it is cut off"));
  if (written_as != format)
    refuse("has the format '" + written_as + "' of another version of this program, which knows '" + format + "'");

  Checkpoint checkpoint;
  try {
    Archive archive(contents.substr(first + 1));
    archive(checkpoint.identity, checkpoint.state);
    archive.expect_end();
  } catch (const InputError& error) {
    refuse(std::string("is damaged: ") + error.what());
  }
  return checkpoint;
}

Checkpoints::Checkpoints(std::string file, double every_seconds, RunIdentity identity)
    : file_(std::move(file)),
      every_seconds_(every_seconds),
      last_(elapsed_seconds()),
      checkpoint_{std::move(identity), {}} {
  expect_replaceable(file_);
  const fs::path folder = fs::path(file_).parent_path();
  if (file_.empty() || access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0)
    throw InputError("--checkpoint: cannot write '" + file_ + "': " + (file_.empty() ? "it has no name" : why()));
}

void Checkpoints::resume(std::string state) {
  checkpoint_.state = std::move(state);
  resumes_ = true;
}

bool Checkpoints::due() const { return elapsed_seconds() - last_ >= every_seconds_; }

void Checkpoints::save(const std::function<void(Archive&)>& contents) {
  Archive archive;
  contents(archive);
  checkpoint_.state = archive.text();
  write_checkpoint(file_, checkpoint_);
  last_ = elapsed_seconds();
}

void Checkpoints::load(const std::function<void(Archive&)>& contents) {
  Archive archive(std::move(checkpoint_.state));
  contents(archive);
  archive.expect_end();
}

}  // namespace hbvm::core
