#pragma once

#include <string_view>
#include <vector>

#include "step/method.hpp"

namespace hbvm::core {

/// One kind of method: its name before the colon, how it is used, and what makes one from the text after the colon.
struct MethodFamily {
  std::string_view name, usage;
  MethodPtr (*make)(std::string_view arguments);
};

/// All there are.
const std::vector<MethodFamily>& method_families();
/// One more, unless one of its name is there. Its method may need what this folder must not know, as `taylor`, or be of
/// a program of one's own. Before threads are started.
void add_method_family(const MethodFamily& family);

/// \throws InputError for a family or arguments that do not exist, with what there is
MethodPtr parse_method(std::string_view text);

/// The usage of each family, separated by "; ".
std::string method_usage();

}  // namespace hbvm::core
