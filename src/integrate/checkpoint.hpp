#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "scalar/archive.hpp"

namespace hbvm::core {

/// What a run is, so that nothing else goes on from its checkpoint.
struct RunIdentity {
  std::string program;            ///< its version
  std::string scene_name, scene;  ///< the scene as write_scene writes it
  std::string start;              ///< the text of the file it starts from, if it does not start where the scene does
  /// The options that make it what it is, by name, as they were given.
  std::vector<std::pair<std::string, std::string>> options;

  void remember(Archive& archive);
};

/// A run between two steps: an Archive of all that its further steps, results and files depend on, to the last bit.
struct Checkpoint {
  RunIdentity identity;
  std::string state;
};

/// The file is there as a whole or, if this fails, as it was before. It is written beside as FILE.part, put on the disk
/// and renamed. Text: a first line with the format's number, an Archive, a line with the checksum of all before.
/// \throws InputError if it cannot be written, or is there and no checkpoint
void write_checkpoint(const std::string& file, const Checkpoint& checkpoint);

/// \throws InputError that says why, if it is no checkpoint, damaged, or of another format
Checkpoint read_checkpoint(const std::string& file);

/// Keeps a run in a file, and lets it go on from one: integrate() asks it between steps.
class Checkpoints {
 public:
  /// \param every_seconds of elapsed time between two of them
  /// \throws InputError if the file is there and no checkpoint, or its folder cannot be written to
  Checkpoints(std::string file, double every_seconds, RunIdentity identity);
  /// The run goes on from this state, which load() will be asked for.
  void resume(std::string state);

  bool resumes() const { return resumes_; }
  bool due() const;

  /// `contents` says what there is to remember.
  /// \throws InputError as write_checkpoint does
  void save(const std::function<void(Archive&)>& contents);
  /// \throws InputError if the state is that of another program
  void load(const std::function<void(Archive&)>& contents);

 private:
  std::string file_;
  double every_seconds_, last_;
  Checkpoint checkpoint_;
  bool resumes_ = false;
};

}  // namespace hbvm::core
