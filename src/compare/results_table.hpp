#pragma once

#include <string>
#include <vector>

#include "compare/comparison.hpp"
#include "scalar/expression.hpp"
#include "scalar/scalar.hpp"

namespace hbvm::core {

/// The lines of a file of results, cell by cell: names, then numbers; those that begin with # are comments.
struct ResultsTable {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> cells;
  std::vector<std::size_t> lines;

  /// \throws InputError, with the line, for one without numbers, with names that stand twice, or lines of other lengths
  explicit ResultsTable(const ResultsFile& file);

  /// Significant digits of the longest number.
  int digits() const;
};

/// What the quantities of a scene are in a table: columns of their names, or expressions of the map.
class ResultsColumns {
 public:
  /// "t", or a name of q, p or velocity, or of what the scene observes.
  struct Reading {
    std::string ours;
    Expression expression;  ///< c0, c1, ... are the columns
  };

  /// Both must outlive this. \throws InputError for a map that cannot be read, without a time, or with nothing else
  ResultsColumns(const ComparisonRequest& request, const ResultsFile& file, const ResultsTable& rows);

  const std::vector<Reading>& readings() const { return readings_; }
  const std::vector<std::string>& positions() const { return positions_; }
  const std::vector<std::string>& momenta() const { return momenta_; }
  const std::vector<std::string>& velocities() const { return velocities_; }
  const std::vector<std::string>& observed() const { return observed_; }
  const Reading* find(const std::string& ours) const;
  /// Columns that are nothing of the scene.
  const std::vector<std::string>& unread() const { return unread_; }
  /// \throws InputError for a cell of a column that is read, in any line, that is no number, with line and column
  void check_numbers() const;

  /// In the digits of the scope. \throws InputError with line and column
  Mpfr value(const Reading& reading, std::size_t row) const;
  /// What a cell says, if the quantity is one column; else its value as a text.
  std::string text(const Reading& reading, std::size_t row) const;

 private:
  void read_map(const ComparisonRequest& request);
  Expression number(std::size_t row, std::size_t column) const;
  std::string own_name(const std::string& theirs) const;
  /// Whether it is "t" or a name of the scene's.
  bool is_ours(const std::string& name) const;

  const ResultsFile& file_;
  const ResultsTable& rows_;
  std::vector<std::string> positions_, momenta_, velocities_, observed_;
  std::vector<Reading> readings_;
  std::vector<std::string> unread_;
};

}  // namespace hbvm::core
