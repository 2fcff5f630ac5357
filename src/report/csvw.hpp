#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hbvm/table.hpp"

namespace hbvm::core {

/// What is in a column of a CSV file, as CSV on the Web names it.
enum class CsvType {
  text,
  integer,
  binary64,  ///< a decimal that double holds
  decimal    ///< one of more digits, or beyond the range of double: text of that form, so that no reader rounds it
};

struct CsvColumn {
  std::string name;  ///< as in the first line of the file
  CsvType type = CsvType::text;
  std::string description;
};

/// What describes a CSV file, beside it.
struct CsvMetadata {
  std::string title;                                            ///< dc:title
  std::string source;                                           ///< dc:source: what it was made from, if that is a text
  std::vector<std::pair<std::string, std::string>> properties;  ///< further ones: "hbvm:" and the name
  std::vector<CsvColumn> columns;
};

/// The name under which readers look for it: "FILE.csv-metadata.json".
std::string csvw_file(const std::string& csv);

/// The metadata as JSON of W3C's "Metadata Vocabulary for Tabular Data", CSVW. \param csv the file, named from beside
/// it
std::string to_csvw(const CsvMetadata& metadata, const std::string& csv);

/// Writes a table as CSV, and beside it what describes it. \throws InputError if a file cannot be written
void write_csv(const std::string& file, const Table& table, const CsvMetadata& metadata);
/// Writes a table as CSV, described by its caption and, line by line, its provenance.
void write_csv(const std::string& file, const Table& table);

}  // namespace hbvm::core
