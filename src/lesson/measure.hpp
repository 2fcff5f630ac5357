#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hbvm/lesson.hpp"
#include "toml/toml_table.hpp"

namespace hbvm::core {

using NamedTexts = std::vector<std::pair<std::string, std::string>>;

/// Numbers that the engine is asked for: a request, and where in the JSON of its result the numbers are. In every text
/// {blank} stands for what was answered.
struct Measure {
  std::string kind;   ///< "run", "compare", "convergence", "audit" or "reference"
  NamedTexts values;  ///< names, and for each a JSON pointer, as "/runs/0/e_H"
  std::string scene, step, until, precision, steps, digits;
  std::vector<std::string> methods;
  std::string tableau;  ///< of an audit: the text of its file
  NamedTexts set;
  NamedTexts files;  ///< those of the lesson, whose names may stand for the scene, the tableau, and after "tableau:"
  bool error = false, reverse = false, reference = false;
  bool back = false;  ///< the result is that of a second run, back from the end of the first
};

/// The texts of a table: set = { "a.mass" = "3" }; none if it is absent. \throws InputError with the line
NamedTexts named_texts(TomlTable& table, std::string_view key);

/// From a table [[measure]] of an exercise. \throws InputError with the line
Measure read_measure(const TomlSource& source, const toml::table& table, const std::string& what);

/// With what was answered in place of each {blank}.
Measure filled(const Measure& measure, const Answers& answers);

}  // namespace hbvm::core
