#include "report/csvw.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "html.hpp"
#include "write_file.hpp"

namespace hbvm::core {
namespace {

using Json = nlohmann::ordered_json;

/// A variable of URI templates, which a name of CSVW has to be: no "_" first, dots between words only.
std::string variable(const std::string& name) {
  std::string text = percent_encoded(name, ".");
  const auto escape = [&](std::size_t at) { text.replace(at, 1, text[at] == '.' ? "%2E" : "%5F"); };
  for (std::size_t i = text.size(); i-- > 0;)
    if (text[i] == '.' && (i == 0 || i + 1 == text.size() || text[i + 1] == '.')) escape(i);
  if (text.starts_with('_')) escape(0);
  return text;
}

Json datatype(CsvType type) {
  if (type == CsvType::decimal) return {{"base", "string"}, {"format", R"(-?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?)"}};
  return type == CsvType::text ? "string" : type == CsvType::integer ? "integer" : "double";
}

}  // namespace

std::string csvw_file(const std::string& csv) { return csv + "-metadata.json"; }

std::string to_csvw(const CsvMetadata& metadata, const std::string& csv) {
  Json j{{"@context", "http://www.w3.org/ns/csvw"},
         {"url", percent_encoded(std::filesystem::path(csv).filename().string(), ".-~")}};
  if (!metadata.title.empty()) j["dc:title"] = metadata.title;
  for (const auto& [name, value] : metadata.properties) j["hbvm:" + name] = value;
  if (!metadata.source.empty()) j["dc:source"] = metadata.source;
  j["tableSchema"]["columns"] = Json::array();
  for (const CsvColumn& column : metadata.columns) {
    Json entry{{"name", variable(column.name)}, {"titles", column.name}, {"datatype", datatype(column.type)}};
    if (!column.description.empty()) entry["dc:description"] = column.description;
    j["tableSchema"]["columns"].push_back(entry);
  }
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_csv(const std::string& file, const Table& table, const CsvMetadata& metadata) {
  write_file(file, to_csv(table));
  write_file(csvw_file(file), to_csvw(metadata, file));
}

void write_csv(const std::string& file, const Table& table) {
  CsvMetadata metadata{table.caption, {}, {}, {}};
  for (const std::string& line : table.provenance)
    metadata.properties.emplace_back("provenance" + std::to_string(metadata.properties.size() + 1), line);
  for (const std::string& column : csv_columns(table)) metadata.columns.push_back({column, CsvType::text, ""});
  write_csv(file, table, metadata);
}

}  // namespace hbvm::core
