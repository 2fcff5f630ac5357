#pragma once

#include <gtest/gtest.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/program.hpp"

namespace hbvm::core {

/// What the program prints with --json if all is well. On standard error it names these files and says nothing else.
inline nlohmann::ordered_json json_of(const Arguments& arguments, const Arguments& files = {}) {
  const Outcome outcome = ended_with(0, arguments + Arguments{"--json"});
  EXPECT_EQ(outcome.err, written(files));
  return nlohmann::ordered_json::parse(outcome.out);
}

/// The object has these members, with these values, and may have others.
inline void expect_members(const nlohmann::ordered_json& object, const nlohmann::ordered_json& members) {
  for (const auto& [key, value] : members.items()) EXPECT_EQ(object.at(key), value) << key;
}

inline std::vector<std::string> keys_of(const nlohmann::ordered_json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

/// The words of a text, parted by spaces.
inline std::vector<std::string> words_of(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

/// The value of a number that is printed as text.
inline double number(const nlohmann::ordered_json& text) { return std::stod(text.get<std::string>()); }

}  // namespace hbvm::core
