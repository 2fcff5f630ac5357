#include "reference/closed_form/rounds.hpp"

#include <fmt/format.h>

#include "interruption.hpp"

namespace hbvm::core {

void Rounds::next() {
  if (stop_asked()) throw Interrupted(stop_request->number(), fmt::format("{} was not finished", what_));
  // Not finite where the numbers of the loop are not.
  if (!(made_ < most_))
    throw IntegrationError(
        fmt::format("{} does not end: {} rounds were made, and {} should suffice", what_, made_, most_));
  ++made_;
}

}  // namespace hbvm::core
