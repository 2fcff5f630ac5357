#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reference/compute_reference.hpp"

namespace hbvm::core {

/// A reference with what made it.
struct StoredReference {
  Reference reference;
  std::string version, date;
};

/// Writes a TOML file. It has the scene's name and hash, the routes' settings, version and date. Each time has its
/// numbers as texts of as many digits as are certain.
std::string to_toml(const StoredReference& stored);

/// What such a file says; `name` is for messages.
/// \throws InputError with the line where it is none, or holds what is no number
StoredReference read_reference(const std::string& toml, const std::string& name);

/// Name and text of each reference compiled in.
const std::vector<std::pair<std::string, std::string>>& shipped_references();

/// A shipped reference at one time.
struct FoundReference {
  std::string name;
  int digits = 0;
  ReferenceState state;
  int proved = 0;  ///< digits
};
/// The reference of a scene that says the same, whatever its name, at exactly this time, whatever its text, with so
/// many digits at least. Of several it is that with the most.
/// \throws InputError for a time without a value
std::optional<FoundReference> find_reference(const Scene& scene, const Expression& t, int digits);

/// A number that is not the same in two references.
struct Difference {
  std::string t, what;  ///< "q_3"
  std::string stored, found;
};
/// Compares the texts of numbers digit by digit. A number that only one reference has is a difference, too.
std::vector<Difference> differences(const Reference& stored, const Reference& found);

}  // namespace hbvm::core
