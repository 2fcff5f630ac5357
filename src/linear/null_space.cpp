#include "linear/null_space.hpp"

#include <optional>

namespace hbvm::core {
namespace {

using Rows = std::vector<UncertainRow>;

struct Columns {
  std::size_t first, end;
};

struct Place {
  std::size_t row, column;
};

/// The column of the largest entry; none if all are 0.
std::optional<std::size_t> largest(const UncertainRow& row, Columns columns) {
  std::optional<std::size_t> at;
  for (std::size_t j = columns.first; j < columns.end; ++j)
    if (row[j].value != 0 && (!at || magnitude(row[j].value) > magnitude(row[*at].value))) at = j;
  return at;
}

Mpfr relative_error(const Uncertain& x) { return x.error / magnitude(x.value); }

/// A pivot that is the largest of its row in these columns. The row is the one with the smallest entries in the columns
/// still to come. So others keep theirs when it is subtracted from them. Among equals it is the one known best.
std::optional<Place> pivot(const Rows& a, std::size_t first_row, Columns columns, Columns to_come) {
  std::optional<Place> best;
  Mpfr least_rest = 0, least_error = 0;
  for (std::size_t i = first_row; i < a.size(); ++i) {
    const auto j = largest(a[i], columns);
    if (!j) continue;
    const auto other = largest(a[i], to_come);
    const Mpfr rest = other ? Mpfr(magnitude(a[i][*other].value) / magnitude(a[i][*j].value)) : Mpfr(0);
    const Mpfr error = relative_error(a[i][*j]);
    if (best && (rest > least_rest || (rest == least_rest && error >= least_error))) continue;
    best = Place{i, *j};
    least_rest = rest;
    least_error = error;
  }
  return best;
}

/// row -= (row[column] / pivot[column]) pivot.
void clear(UncertainRow& row, const UncertainRow& by, std::size_t column) {
  if (row[column].value == 0) return;
  const Uncertain factor = row[column] / by[column];
  for (std::size_t j = 0; j < row.size(); ++j) {
    if (by[j].value == 0) continue;
    row[j] = j == column ? Uncertain(0) : row[j] - factor * by[j];
    if (row[j].holds_zero()) row[j] = 0;
  }
}

void clear_all(Rows& a, const Place& at) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (i != at.row) clear(a[i], a[at.row], at.column);
}

/// The reduced echelon form of independent rows.
void reduce(Rows& a, std::size_t columns) {
  std::size_t done = 0;
  for (std::size_t column = 0; column < columns && done < a.size(); ++column) {
    const auto at = pivot(a, done, {column, column + 1}, {column, column});
    if (!at) continue;
    std::swap(a[at->row], a[done]);
    const Uncertain lead = a[done][column];
    for (Uncertain& x : a[done])
      if (x.value != 0) x = x / lead;
    a[done][column] = 1;
    clear_all(a, {done, column});
    ++done;
  }
}

}  // namespace

std::vector<UncertainRow> null_space(Rows a, std::size_t columns, std::size_t first_of_second) {
  for (UncertainRow& row : a)
    for (Uncertain& x : row)
      if (x.holds_zero()) x = 0;
  // What the second columns say comes first; what is left of a row then has the first ones alone.
  const Columns first{0, first_of_second}, second{first_of_second, columns};
  std::vector<std::optional<std::size_t>> row_of(columns);  // where the column is eliminated
  std::size_t rank = 0;
  for (const auto& [now, to_come] : {std::pair(second, first), std::pair(first, Columns{0, 0})})
    while (const auto at = pivot(a, rank, now, to_come)) {
      std::swap(a[at->row], a[rank]);
      clear_all(a, {rank, at->column});
      row_of[at->column] = rank++;
    }
  Rows result;
  for (std::size_t free = 0; free < columns; ++free) {
    if (row_of[free]) continue;
    UncertainRow x(columns);
    x[free] = 1;
    for (std::size_t j = 0; j < columns; ++j)
      if (row_of[j] && a[*row_of[j]][free].value != 0) x[j] = -a[*row_of[j]][free] / a[*row_of[j]][j];
    result.push_back(std::move(x));
  }
  reduce(result, columns);
  return result;
}

}  // namespace hbvm::core
