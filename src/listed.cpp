#include "listed.hpp"

#include <fmt/format.h>

namespace hbvm::core {

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 8;
  const std::size_t shown = names.size() > most + 1 ? most : names.size();
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) text += (i > 0 ? ", " : "") + names[i];
  return text + (shown < names.size() ? fmt::format(", and {} more", names.size() - shown) : "");
}

}  // namespace hbvm::core
