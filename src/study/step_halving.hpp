#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scalar/precision.hpp"
#include "scene/scene.hpp"
#include "step/method.hpp"

namespace hbvm::core {

/// How many digits a table shows.
enum class Digits {
  printed,  ///< three, of rates one after the point
  all
};

/// One row of the paper's tables: runs i and i + 1 compared. Absent where there is no number.
struct HalvingRow {
  int i = 0;
  std::string e_y;              ///< |y_i(T) - y_{i+1}(T)|_max with y = (q, p), at the end point only
  std::string e_lambda;         ///< the same for the multiplier (57)
  std::string e_hid, e_g, e_H;  ///< maxima over the mesh of the finer run, i + 1
  /// log2 of the quotient of the row above and this one; "***" if this row's error is round-off.
  std::optional<std::string> rate_y, rate_lambda, rate_hid, rate_H;
  long steps = 0;  ///< of the finer run
  /// Each error over epsilon times the size of what it is an error of.
  double ulps_lambda = 0, ulps_hid = 0, ulps_g = 0, ulps_H = 0;

  /// The cell of the column of this name, "---" if there is none.
  std::string cell(const std::string& column) const;
  /// Whether the error of this column, e_lambda, e_hid, e_g or e_H, is no more than what roundings add up to. A step
  /// leaves a few in g and H, and more in the hidden constraint, which has those of the multipliers at all nodes. They
  /// have random signs, so that over the steps they grow like the square root of their number. A multiplier is a
  /// momentum over a step, and so are its roundings, the last step's alone.
  bool is_round_off(const std::string& column) const;
};

/// A ladder of steps h_i, i = first .. last + 1, on one interval.
struct HalvingRequest {
  const Scene* scene = nullptr;
  MethodPtr method;
  SolverKind solver = SolverKind::automatic;
  Expression step;  ///< in terms of i and the scene's constants
  Expression until;
  int first = 0, last = 0;
};

/// What a run of the ladder leaves, every number as decimal text that reads back exactly.
struct HalvingRun {
  long steps = 0;
  std::vector<std::string> q, p, lambda;  ///< at the end; lambda: (57)
  std::string H0, e_H, e_g, e_hid;
};

/// The run with the step h_i. \throws InputError, IntegrationError
HalvingRun halving_run(const HalvingRequest& request, int i, const Precision& precision);

/// A run as JSON, and back. \throws InputError if it is none
std::string to_result(const HalvingRun& run);
HalvingRun read_halving_run(const std::string& text);

/// The rows first .. last from the runs first .. last + 1.
std::vector<HalvingRow> halving_rows(const HalvingRequest& request, const std::vector<HalvingRun>& runs,
                                     const Precision& precision, Digits digits = Digits::printed);

}  // namespace hbvm::core
