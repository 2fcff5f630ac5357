#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "hbvm/error.hpp"

namespace hbvm::core {

using OrderedJson = nlohmann::ordered_json;

/// A number that JSON has, or null; and back, null as NaN.
OrderedJson json_number(double x);
double number_of(const OrderedJson& json);

/// Names of files may hold bytes that are no text: they are replaced.
std::string dumped(const OrderedJson& json, int indent);

/// What `read` makes of a cell's result. \throws InputError if it is none of `what`
template <class Read>
auto read_json(const std::string& text, const std::string& what, const Read& read) {
  try {
    return read(OrderedJson::parse(text));
  } catch (const OrderedJson::exception& error) {
    throw InputError("this is no result of " + what + ": " + error.what());
  }
}

}  // namespace hbvm::core
