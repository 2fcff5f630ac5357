#include "folder_report/folder_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "hbvm/error.hpp"
#include "json_facts.hpp"
#include "markdown.hpp"
#include "read_file.hpp"
#include "report/csv_table.hpp"
#include "report/csvw.hpp"
#include "report/html.hpp"
#include "report_parts.hpp"
#include "svg_picture.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

/// How much of its files a page shows.
struct Limits {
  std::size_t rows;              ///< of a table
  std::set<std::string> no_svg;  ///< drawings that are left out
};

/// A file of the folder, with its path within it.
struct ReportFile {
  fs::path path;
  std::string name, text;
};

bool has_ending(const ReportFile& file, const char* ending) { return file.path.extension() == ending; }

/// Those that are there, sorted, hidden ones and their folders apart.
std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code failure;
  fs::recursive_directory_iterator all(folder, failure);
  if (failure) throw InputError("'" + folder.string() + "': " + failure.message());
  for (; all != fs::recursive_directory_iterator(); all.increment(failure)) {
    const bool hidden = all->path().filename().string().starts_with(".");
    if (all->is_directory() && (hidden || all->is_symlink())) all.disable_recursion_pending();
    if (!hidden && all->is_regular_file()) paths.push_back(all->path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

class FolderReport {
 public:
  explicit FolderReport(const fs::path& folder) : folder_(folder) {
    if (!fs::is_directory(folder)) throw InputError("no folder '" + folder.string() + "'");
    for (const fs::path& path : files_of(folder)) {
      const std::string ending = path.extension().string(), name = path.lexically_relative(folder).generic_string();
      // What a study is to find is no result.
      const bool is_table = ending == ".csv" && path.filename() != "expected.csv";
      if (is_table || ending == ".json" || ending == ".svg" || ending == ".md")
        files_.push_back({path, name, read_file(path)});
      else if (name != "report.html" && path.filename() != "expected.csv")
        others_.push_back(name);
    }
    if (files_.empty())
      throw InputError("nothing to report in '" + folder.string() +
                       "': no .csv, .json, .svg or .md; --out of run, study, cost, audit and stability writes some");
  }

  std::string page(const std::string& version, const std::string& command, const Limits& limits) {
    limits_ = limits;
    facts_.clear();
    shown_.clear();
    title_.clear();
    has_heading_ = false;
    longest_ = 0;
    sections_.clear();
    // Texts first, which show drawings where they speak of them.
    for (const ReportFile& file : files_)
      if (has_ending(file, ".md")) text(file);
    for (const ReportFile& file : files_)
      if (has_ending(file, ".svg") && !shown_.contains(file.name)) add(file.name, figure(file));
    for (const ReportFile& file : files_) {
      if (has_ending(file, ".csv")) table(file);
      if (has_ending(file, ".json")) json(file);
    }
    const std::string title = fs::absolute(folder_).lexically_normal().filename().string();
    const std::string name = html(title_.empty() ? title : title_);
    std::string body = "<h1>" + name + "</h1>\n" + facts_table(facts_);
    body += "<nav><ul>";
    for (const auto& [heading, section] : sections_)
      body += "<li><a href=\"#" + html(heading) + "\">" + html(heading) + "</a></li>";
    body += "</ul></nav>\n";
    for (const auto& [heading, section] : sections_)
      body += "<section id=\"" + html(heading) + "\">\n<h2>" + html(heading) + "</h2>\n" + section + "</section>\n";
    if (!others_.empty())
      body += fmt::format("<p class=\"note\">In the folder, and not shown: {}</p>\n",
                          html(fmt::format("{}", fmt::join(others_, ", "))));
    body += "<p class=\"note\">Made by hbvm " + html(version) + ": <code>" + html(command) + "</code></p>\n";
    return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
           "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
           "img-src data:; "
           "script-src 'unsafe-inline'\">\n<link rel=\"icon\" href=\"data:,\">\n<title>" +
           name + "</title>\n<style>\n" + std::string(report_style) + "</style>\n</head>\n<body>\n" + body +
           "<div id=\"value\" role=\"status\" hidden></div>\n<script>\n" + std::string(report_script) +
           "</script>\n</body>\n</html>\n";
  }

  /// The largest drawing that is shown, or nothing.
  std::string largest_drawing(const Limits& limits) const {
    const ReportFile* largest = nullptr;
    for (const ReportFile& file : files_)
      if (has_ending(file, ".svg") && !limits.no_svg.contains(file.name) &&
          (!largest || file.text.size() > largest->text.size()))
        largest = &file;
    return largest ? largest->name : "";
  }

 private:
  void add(const std::string& heading, const std::string& section) { sections_.emplace_back(heading, section); }

  const ReportFile* file_named(const std::string& name) const {
    const auto found = std::find_if(files_.begin(), files_.end(), [&](const ReportFile& f) { return f.name == name; });
    return found == files_.end() ? nullptr : &*found;
  }

  void text(const ReportFile& file) {
    // The same table is there as CSV.
    if (file_named(fs::path(file.name).replace_extension(".csv").generic_string())) return;
    const fs::path beside = fs::path(file.name).parent_path();
    if (!has_heading_ && file.text.starts_with("# ")) {
      title_ = file.text.substr(2, file.text.find('\n') - 2);
      has_heading_ = true;
    }
    add(file.name, markdown_html(file.text, [&](const std::string& address) {
          const ReportFile* const picture = file_named((beside / address).lexically_normal().generic_string());
          if (!picture || !has_ending(*picture, ".svg")) return std::string();
          shown_.insert(picture->name);
          return figure(*picture);
        }));
  }

  std::string figure(const ReportFile& file) {
    const std::string name = html(file.name);
    if (limits_.no_svg.contains(file.name))
      return "<p class=\"note\">" + name + " is left out: the page would be too large with it.</p>\n";
    const SvgPicture picture = svg_picture(file.text, file.path.string());
    std::string data;
    if (!picture.data.empty()) {
      check_json(picture.data, file.path.string());
      data = "<script type=\"application/json\">" + within_script(picture.data) + "</script>";
    }
    return fmt::format(
        "<figure class=\"drawing\"><div class=\"sheet\"><img alt=\"{}\" src=\"{}\"></div>{}"
        "<figcaption>{}</figcaption></figure>\n",
        name, picture.address, data, name);
  }

  void table(const ReportFile& file) {
    const CsvTable csv = read_csv_table(file.text, file.path.string());
    const ReportFile* const described = file_named(csvw_file(file.name));
    Description description;
    if (described) description = read_description(described->text, described->path.string());
    for (const Fact& fact : description.facts) add_fact(facts_, fact);
    std::string section;
    // Unless a text says what all is about, the longest table does.
    if (csv.rows.size() > longest_ && !has_heading_ && !description.title.empty()) {
      title_ = description.title;
      longest_ = csv.rows.size();
    }
    if (!description.title.empty()) section += "<p>" + html(description.title) + "</p>\n";
    const std::size_t count = csv.rows.size(), shown = std::min(count, limits_.rows);
    if (shown < count)
      section += fmt::format("<p class=\"note\">{} of {} rows, from the first to the last.</p>\n", shown, count);
    section += "<div class=\"table\"><table>\n<thead><tr>";
    for (const std::string& column : csv.columns) {
      const auto meaning = description.columns.find(column);
      section += meaning == description.columns.end()
                     ? "<th>" + html(column) + "</th>"
                     : "<th title=\"" + html(meaning->second) + "\">" + html(column) + "</th>";
    }
    section += "</tr></thead><tbody>\n";
    for (std::size_t i = 0; i < shown; ++i) {
      section += "<tr>";
      // From the first to the last, as far apart as it takes.
      for (const std::string& cell : csv.rows[shown > 1 ? i * (count - 1) / (shown - 1) : 0]) {
        constexpr std::size_t is_long = 60;
        section += (cell.size() > is_long ? "<td class=\"long\">" : "<td>") + html(cell) + "</td>";
      }
      section += "</tr>\n";
    }
    section += "</tbody></table></div>\n";
    if (!description.source.empty())
      section +=
          "<details><summary>What it was made from</summary><pre>" + html(description.source) + "</pre></details>\n";
    add(file.name, section);
  }

  void json(const ReportFile& file) {
    if (file.name.ends_with(".csv-metadata.json") &&
        file_named(file.name.substr(0, file.name.size() - std::string_view("-metadata.json").size())))
      return;
    const std::vector<Fact> facts = read_facts(file.text, file.path.string());
    for (const Fact& fact : facts)
      if (is_provenance(fact.name)) add_fact(facts_, fact);
    add(file.name, facts_table(facts));
  }

  static std::string facts_table(const std::vector<Fact>& facts) {
    if (facts.empty()) return "";
    std::string text = "<div class=\"table facts\"><table>\n<tbody>\n";
    for (const Fact& fact : facts) {
      text += "<tr><th>" + html(fact.name) + "</th><td>";
      const bool is_code = fact.name.ends_with("command") || fact.name == "run";
      for (std::size_t i = 0; i < fact.values.size(); ++i) {
        const std::string value = html(fact.values[i]);
        text += (i > 0 ? "<br>" : "") + (is_code ? "<code>" + value + "</code>" : value);
      }
      text += "</td></tr>\n";
    }
    return text + "</tbody></table></div>\n";
  }

  fs::path folder_;
  std::vector<ReportFile> files_;
  std::vector<std::string> others_;
  Limits limits_{};
  std::string title_;
  bool has_heading_ = false;
  std::size_t longest_ = 0;  ///< rows of the table that the title is from
  std::vector<Fact> facts_;  ///< what all was made by
  std::set<std::string> shown_;
  std::vector<std::pair<std::string, std::string>> sections_;  ///< headings, and what is below them
};

}  // namespace

std::string folder_report(const fs::path& folder, const std::string& version, const std::string& command) {
  FolderReport report(folder);
  constexpr std::size_t most_rows = 400, least_rows = 10;
  Limits limits{most_rows, {}};
  for (;;) {
    std::string page = report.page(version, command, limits);
    if (page.size() < report_bytes) return page;
    if (limits.rows > least_rows) {
      limits.rows /= 4;
      continue;
    }
    const std::string largest = report.largest_drawing(limits);
    if (largest.empty())
      throw InputError(fmt::format("'{}' holds too much for a page of {} bytes: report a part of it", folder.string(),
                                   report_bytes));
    limits.no_svg.insert(largest);
  }
}

}  // namespace hbvm::core
