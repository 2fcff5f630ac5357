#include "reference/proof_file.hpp"

#include <fmt/format.h>

#include "checksum.hpp"
#include "hbvm/error.hpp"
#include "reference/proof/hex_number.hpp"
#include "toml/toml_table.hpp"

namespace hbvm::core {
namespace {

constexpr const char* proof_format = "hbvm proof, format 1";

/// The lines before what the checksum is of.
std::string head(std::string_view body) {
  return fmt::format("format = \"{}\"\nchecksum = \"{}\"\n", proof_format, Checksum(body).text());
}

/// A TOML string of several lines.
std::string block(const std::string& text) {
  std::string result = "\"\"\"\n";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"\"\"\n";
}

std::string text_of(const ErrorDistance& distance) {
  return fmt::format("[\"{}\", \"{}\"]\n", hex_text(distance.length), hex_text(distance.omega));
}

std::string text_of(const std::vector<BallSeries>& all) {
  std::string text = "[\n";
  for (const BallSeries& series : all) {
    text += "  \"";
    for (Index n = 0; n < series.length(); ++n) text += (n > 0 ? " " : "") + hex_text(series[n]);
    text += "\",\n";
  }
  return text + "]\n";
}

std::string text_of(const ProvedStep& step) {
  const SeriesStep& series = step.series;
  std::string ends, omegas;
  for (const PieceEnd& piece : step.pieces) {
    ends += fmt::format("{}\"{}\"", ends.empty() ? "" : ", ", hex_text(piece.end));
    omegas += fmt::format("{}\"{}\"", omegas.empty() ? "" : ", ", hex_text(piece.omega));
  }
  return fmt::format(
      "\n[[step]]\norder = {}\nunit = \"{}\"\nend = \"{}\"\nbefore = {}tube = {}after = {}ends = [{}]\nomegas = [{}]\n"
      "q = {}lambda = {}",
      series.order(), hex_text(series.unit()), hex_text(series.end()), text_of(step.before), text_of(step.tube),
      text_of(step.after), ends, omegas, text_of(series.q()), text_of(series.lambda()));
}

RealBall number(const TomlTable& table, std::string_view text, const char* key) {
  std::optional<RealBall> x = number_of_hex(text);
  if (!x) table.fail(fmt::format("'{}' holds '{}', which is no number of a proof", key, text.substr(0, 40)));
  return *x;
}

std::vector<RealBall> numbers(TomlTable& table, const char* key) {
  std::vector<RealBall> result;
  for (const std::string& text : table.strings(key)) result.push_back(number(table, text, key));
  return result;
}

ErrorDistance distance(TomlTable& table, const char* key) {
  const std::vector<RealBall> both = numbers(table, key);
  if (both.size() != 2) table.fail(fmt::format("'{}' is not a length and a rate", key));
  return {both[0], centre_of(raw(both[1]))};
}

std::vector<BallSeries> all_series(TomlTable& table, const char* key, Index longest) {
  std::vector<BallSeries> result;
  for (const std::string& text : table.strings(key)) {
    BallSeries& series = result.emplace_back();
    Index n = 0;
    for (std::size_t from = 0; from < text.size(); ++n) {
      if (n == longest) table.fail(fmt::format("'{}' has more coefficients than its order allows", key));
      const std::size_t to = std::min(text.find(' ', from), text.size());
      series.set(n, number(table, std::string_view(text).substr(from, to - from), key));
      from = to + 1;
    }
  }
  return result;
}

ProvedStep read_step(TomlTable& table) {
  const Index order = table.integer("order");
  constexpr Index most = 100'000;
  if (order < 1 || order > most) table.fail(fmt::format("'order' is {}, not 1 to {}", order, most));
  const RealBall unit = number(table, table.string("unit"), "unit"), end = number(table, table.string("end"), "end");
  if (!unit.is_positive() || !end.is_positive()) table.fail("'unit' and 'end' are positive");
  std::vector<BallSeries> q = all_series(table, "q", order + 2), lambda = all_series(table, "lambda", order);
  ProvedStep step{SeriesStep(std::move(q), std::move(lambda), unit, end, order),
                  distance(table, "before"),
                  distance(table, "tube"),
                  distance(table, "after"),
                  {}};
  const std::vector<RealBall> ends = numbers(table, "ends"), omegas = numbers(table, "omegas");
  if (ends.size() != omegas.size() || ends.empty()) table.fail("'ends' and 'omegas' are as many, and some");
  for (std::size_t i = 0; i < ends.size(); ++i) step.pieces.push_back({ends[i], centre_of(raw(omegas[i]))});
  return step;
}

}  // namespace

std::string to_text(const ProofFile& file) {
  std::string body = fmt::format("digits = {}\nscene = {}reference = {}", file.proof.digits, block(file.proof.scene),
                                 block(to_toml(file.claim)));
  for (const ProvedStep& step : file.proof.steps) body += text_of(step);
  return head(body) + body;
}

ProofFile read_proof(const std::string& text, const std::string& name) {
  const std::size_t length = head("").size();
  if (!text.starts_with(head("").substr(0, head("").find('\n'))))
    throw InputError(fmt::format("{}: it does not begin with format = \"{}\"", name, proof_format));
  if (text.size() < length || !text.starts_with(head(std::string_view(text).substr(length))))
    throw InputError(name + ": it was changed: its text has another checksum");
  const TomlSource source(text, name);
  const toml::table parsed = source.parse();
  TomlTable root(source, parsed, "the proof");
  root.string("format");
  root.string("checksum");
  ProofFile file;
  constexpr long most_digits = 100'000;
  const long digits = root.integer("digits");
  if (digits < 1 || digits > most_digits) root.fail(fmt::format("'digits' is {}, not 1 to {}", digits, most_digits));
  file.proof.digits = static_cast<unsigned>(digits);
  file.proof.scene = root.string("scene");
  file.claim = read_reference(root.string("reference"), name + ", 'reference'");
  const PrecisionScope scope(file.proof.digits);
  const BallScope bits(significand_bits<Mpfr>());
  for (const toml::table* const entry : root.tables("step")) {
    TomlTable table(source, *entry, fmt::format("step {}", file.proof.steps.size() + 1));
    file.proof.steps.push_back(read_step(table));
    table.finish();
  }
  root.finish();
  return file;
}

}  // namespace hbvm::core
