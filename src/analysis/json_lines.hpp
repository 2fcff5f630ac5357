#pragma once

#include <functional>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

namespace hbvm {

using OrderedJson = nlohmann::ordered_json;

/// A number that JSON has, or null; and back, null as NaN.
OrderedJson json_number(double x);
double number_of(const OrderedJson& json);

/// Names of files may hold bytes that are no text: they are replaced.
std::string dumped(const OrderedJson& json, int indent);

/// What was found under a key, as one line of a text that grows: {"key", "version", "finding"}.
std::string finding_line(const std::string& key, const OrderedJson& finding);

/// Hands over key and finding of each line that this version of the program wrote. A line that was cut off, or that
/// `take` cannot read (nlohmann's exceptions), is left out.
void read_finding_lines(std::istream& lines,
                        const std::function<void(const std::string& key, const OrderedJson& finding)>& take);

}  // namespace hbvm
