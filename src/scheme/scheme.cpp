#include "scheme/scheme.hpp"

#include "hbvm/error.hpp"
#include "scheme/scheme_text.hpp"

namespace hbvm::core {

std::size_t Scheme::row_length(const SchemeText& text, const std::string& key) {
  const auto found = text.arrays.find(key);
  if (found == text.arrays.end() || found->second.empty()) throw InputError(text.file + ": '" + key + "' is missing");
  return found->second.front().size();
}

void Scheme::take(const SchemeText& text, const std::string& key, std::size_t rows, std::size_t columns) {
  name_ = text.name;
  const auto found = text.arrays.find(key);
  if (found == text.arrays.end()) throw InputError(text.file + ": '" + key + "' is missing");
  SchemeBlock block{rows, columns, {}};
  const auto refuse = [&](std::size_t there, const std::string& what, std::size_t wanted) {
    throw InputError(text.file + ": " + key + " has " + std::to_string(there) + " " + what + " and not " +
                     std::to_string(wanted));
  };
  if (found->second.size() != rows) refuse(found->second.size(), "rows", rows);
  for (std::size_t i = 0; i < rows; ++i) {
    const std::vector<std::string>& row = found->second[i];
    if (row.size() != columns) refuse(row.size(), "numbers in a row", columns);
    for (std::size_t j = 0; j < columns; ++j) {
      SchemeEntry entry{key, i, j,
                        key + (rows > 1 ? "[" + std::to_string(i + 1) + "]" : "") + "[" + std::to_string(j + 1) + "]"};
      if (row[j] != "?") {
        try {
          entry.written = Expression::parse(row[j]);
          constexpr int bits = 53;
          static_cast<void>(entry.written->evaluate_to_bits(bits));
        } catch (const ExpressionError& error) {
          throw InputError(text.file + ": " + entry.name + ": " + error.what());
        }
      }
      block.places.push_back(entries_.size());
      entries_.push_back(std::move(entry));
    }
  }
  blocks_[key] = std::move(block);
}

void Scheme::add_part(const SchemeText& text, const std::string& name, const std::string& key, int max_order) {
  const auto stated = text.stated.find(key);
  SchemePart part{name, max_order, {}};
  if (stated != text.stated.end()) {
    if (stated->second < 1 || stated->second > max_order)
      throw InputError(text.file + ": '" + key + "' is " + std::to_string(stated->second) + "; conditions are known " +
                       "from order 1 to " + std::to_string(max_order));
    part.stated = static_cast<int>(stated->second);
  }
  parts_.push_back(std::move(part));
}

template <class S>
std::vector<S> Scheme::written_values() const {
  std::vector<S> values;
  for (const SchemeEntry& entry : entries_) values.push_back(entry.written ? evaluate<S>(*entry.written) : S(0));
  return values;
}
template std::vector<double> Scheme::written_values<double>() const;
template std::vector<Mpfr> Scheme::written_values<Mpfr>() const;

}  // namespace hbvm::core
