#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hbvm::core {

inline std::vector<std::string> keys_of(const nlohmann::ordered_json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

/// The value of a number that is printed as text.
inline double number(const nlohmann::ordered_json& text) { return std::stod(text.get<std::string>()); }

}  // namespace hbvm::core
