#pragma once

#include "section/run_section.hpp"

namespace hbvm::core {

/// What is asked for, read. \throws InputError
SectionWork section_work(const SectionRequest& asked);

}  // namespace hbvm::core
