#pragma once

#include <map>
#include <string>
#include <vector>

namespace hbvm::core {

/// What something says under a name; several where more than one say it.
struct Fact {
  std::string name;
  std::vector<std::string> values;
};

/// Adds what is not yet said under the name, to few values each.
void add_fact(std::vector<Fact>& facts, const Fact& fact);

/// Whether a name tells how a result was made.
bool is_provenance(const std::string& name);

/// The numbers and texts of a JSON object under their names, those of objects in it as "pick.method". Of a list its
/// numbers and texts if it is short, else its length. \param file its name, for messages
/// \throws InputError with file and line if it is none
std::vector<Fact> read_facts(const std::string& text, const std::string& file);

/// What describes a CSV file: of CSVW.
struct Description {
  std::string title, source;
  std::vector<Fact> facts;                     ///< version, command, scene ...
  std::map<std::string, std::string> columns;  ///< what each is, by its name
};
Description read_description(const std::string& text, const std::string& file);

/// \throws InputError with file and line if it is none
void check_json(const std::string& text, const std::string& file);

}  // namespace hbvm::core
