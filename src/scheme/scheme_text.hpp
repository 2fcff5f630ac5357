#pragma once

#include <map>
#include <string>
#include <vector>

namespace hbvm::core {

/// A scheme as it stands in a file: arrays of numbers as text by their names, and what is stated of it.
struct SchemeText {
  using Rows = std::vector<std::vector<std::string>>;  ///< one row of a vector

  std::string file;          ///< for messages
  std::string name, family;  ///< the family may be empty: the names of the arrays then tell it
  std::map<std::string, Rows> arrays;
  std::map<std::string, long> stated;  ///< "order", "embedded_order", "dense_order", "digits"
};

/// From a file in TOML or JSON, or an array of numbers as a Butcher tableau is printed. In such an array the rows have
/// c and then A. One or two rows of weights follow, with or without a bar or an empty line before them. Numbers stand
/// apart by blanks, commas, semicolons or bars. "?" stands for a number that is not known.
/// \throws InputError with the file and what is wrong
SchemeText read_scheme_text(const std::string& file);

}  // namespace hbvm::core
