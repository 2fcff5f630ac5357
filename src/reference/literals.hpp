#pragma once

#include <optional>
#include <string>

#include "hbvm/reference.hpp"

namespace hbvm::core {

/// The numbers of a reference as they are written in other programs.
enum class Language { csv, julia, python, fortran, c };

/// \throws InputError
Language parse_language(const std::string& name);
/// By the end of a file's name: .csv, .jl, .py, .f90 or .h; none for another.
std::optional<Language> language_of_file(const std::string& file);
std::string to_literals(const Reference& reference, Language language);

}  // namespace hbvm::core
