#include "reference/literals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <vector>

#include "csv_line.hpp"
#include "hbvm/error.hpp"
#include "listed.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {
namespace {

struct KnownLanguage {
  Language language;
  const char* name;
  const char* ending;
};
constexpr std::array languages{
    KnownLanguage{Language::csv, "csv", ".csv"}, KnownLanguage{Language::julia, "julia", ".jl"},
    KnownLanguage{Language::python, "python", ".py"}, KnownLanguage{Language::fortran, "fortran", ".f90"},
    KnownLanguage{Language::c, "c", ".h"}};

/// Times as decimals, names of the numbers at each, and these.
struct NumbersByTime {
  std::vector<std::string> names, times;
  std::vector<std::vector<std::string>> rows;
};

NumbersByTime numbers_of(const Reference& r) {
  NumbersByTime all;
  const ReferenceState& first = r.times.front();
  const auto name = [&](const std::vector<std::string>& names, const std::vector<std::string>& values,
                        const char* symbol) {
    for (std::size_t i = 0; i < values.size(); ++i)
      all.names.push_back(i < names.size() ? names[i] : fmt::format("{}_{}", symbol, i + 1));
  };
  name(r.q_names, first.q, "q");
  name(r.p_names, first.p, "p");
  name({}, first.lambda, "lambda");
  name({"H"}, {first.H}, "H");
  name(r.momentum_names, first.momenta, "momentum");
  name(r.observed_names, first.observed, "observed");
  const PrecisionScope scope(static_cast<unsigned>(r.digits) + 5);
  const Constants constants = r.scene_toml.empty() ? Constants() : read_scene(r.scene_toml, r.scene).constants;
  for (const ReferenceState& state : r.times) {
    // A time may have been asked for as an expression, such as 2*pi.
    all.times.push_back(is_decimal(state.t) ? state.t : to_text(evaluate<Mpfr>(Expression::parse(state.t), constants)));
    std::vector<std::string>& row = all.rows.emplace_back();
    for (const auto* const part : {&state.q, &state.p, &state.lambda})
      row.insert(row.end(), part->begin(), part->end());
    row.push_back(state.H);
    for (const auto* const part : {&state.momenta, &state.observed}) row.insert(row.end(), part->begin(), part->end());
  }
  return all;
}

/// Of Julia, Python and C.
std::string in_quotes(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

/// Of Fortran: a quote stands twice, and a backslash for itself.
std::string in_fortran_quotes(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

/// A whole number with a point, without which it would be an integer.
std::string with_point(const std::string& number) {
  return number.find_first_of(".eE") == std::string::npos ? number + ".0" : number;
}

/// Comments with the scene and the digits.
std::string heading(const Reference& r, const char* comment) {
  return fmt::format("{0} {1}: {2}\n{0} {3} digits after the leading one of each vector's greatest component{4}\n",
                     comment, r.scene, r.title, r.digits, r.proved > 0 ? ", proved" : "");
}

template <class Each>
std::string joined(const std::vector<std::string>& texts, const std::string& between, const Each& each) {
  std::string result;
  for (std::size_t i = 0; i < texts.size(); ++i) result += (i == 0 ? "" : between) + each(texts[i]);
  return result;
}

std::string as_csv(const Reference& r) {
  const NumbersByTime all = numbers_of(r);
  std::string text = "t," + csv_line(all.names) + "\n";
  for (std::size_t n = 0; n < all.rows.size(); ++n) text += all.times[n] + "," + csv_line(all.rows[n]) + "\n";
  return text;
}

/// Arrays in square brackets, each number by a call that reads its text.
std::string by_calls(const Reference& r, const std::string& before, const std::string& call) {
  const NumbersByTime all = numbers_of(r);
  const auto number = [&](const std::string& text) { return call + "(" + in_quotes(text) + ")"; };
  std::string text = heading(r, "#") + before + "names = [" + joined(all.names, ", ", in_quotes) + "]\n";
  text += "times = [" + joined(all.times, ", ", number) + "]\nstates = [\n";
  for (const std::vector<std::string>& row : all.rows) text += "    [" + joined(row, ",\n     ", number) + "],\n";
  return text + "]\n";
}

/// A module: one array a time, as a line may be continued 255 times only.
std::string as_fortran(const Reference& r) {
  const auto number = [](const std::string& text) { return with_point(text) + "_16"; };
  const NumbersByTime all = numbers_of(r);
  std::size_t longest = 0;
  for (const std::string& name : all.names) longest = std::max(longest, name.size());
  std::string text = heading(r, "!") + "module reference_solution\n  implicit none\n";
  text += fmt::format("  real(16), parameter :: times({}) = [ &\n    {}]\n", all.times.size(),
                      joined(all.times, ", &\n    ", number));
  for (std::size_t n = 0; n < all.rows.size(); ++n)
    text += fmt::format("  real(16), parameter :: state_{}({}) = [ &\n    {}]\n", n + 1, all.names.size(),
                        joined(all.rows[n], ", &\n    ", number));
  text += "contains\n  function name_of(i) result(name)\n    integer, intent(in) :: i\n" +
          fmt::format("    character({}) :: name\n    select case (i)\n", longest);
  for (std::size_t i = 0; i < all.names.size(); ++i)
    text += fmt::format("    case ({}); name = {}\n", i + 1, in_fortran_quotes(all.names[i]));
  return text + "    case default; name = \"\"\n    end select\n  end function\nend module\n";
}

std::string as_c(const Reference& r) {
  const auto number = [](const std::string& text) { return "HBVM_NUMBER(" + with_point(text) + ")"; };
  const NumbersByTime all = numbers_of(r);
  std::string text = heading(r, "//");
  text +=
      "// Define both for another type: __float128 and x##Q, or const char* and #x for programs with more digits.\n"
      "#ifndef HBVM_NUMBER\n#define HBVM_NUMBER(x) x##L\n#define HBVM_TYPE long double\n#endif\n";
  text += fmt::format("static const char* const reference_names[{}] = {{{}}};\n", all.names.size(),
                      joined(all.names, ", ", in_quotes));
  text += fmt::format("static HBVM_TYPE const reference_times[{}] = {{{}}};\n", all.times.size(),
                      joined(all.times, ", ", number));
  text += fmt::format("static HBVM_TYPE const reference_states[{}][{}] = {{\n", all.rows.size(), all.names.size());
  for (const std::vector<std::string>& row : all.rows) text += "    {" + joined(row, ",\n     ", number) + "},\n";
  return text + "};\n";
}

}  // namespace

Language parse_language(const std::string& name) {
  std::vector<std::string> names;
  for (const KnownLanguage& one : languages) {
    if (one.name == name) return one.language;
    names.emplace_back(one.name);
  }
  throw InputError("no way is known to write numbers for '" + name + "': there are " + listed(names));
}

std::optional<Language> language_of_file(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  for (const KnownLanguage& one : languages)
    if (one.ending == ending) return one.language;
  return std::nullopt;
}

std::string to_literals(const Reference& reference, Language language) {
  switch (language) {
    case Language::csv:
      return as_csv(reference);
    case Language::julia:
      return by_calls(reference, fmt::format("setprecision(BigFloat, {})\n", (reference.digits + 5) * 10 / 3 + 1),
                      "BigFloat");
    case Language::python:
      return by_calls(reference, fmt::format("from mpmath import mp, mpf\nmp.dps = {}\n", reference.digits + 5), "mpf");
    case Language::fortran:
      return as_fortran(reference);
    case Language::c:
      return as_c(reference);
  }
  return {};
}

}  // namespace hbvm::core
