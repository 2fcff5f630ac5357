#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "hbvm/cost.hpp"
#include "hbvm/figure.hpp"
#include "hbvm/scene.hpp"

namespace hbvm {

/// A file of results of any program: names of columns, then a line a time.
struct ResultsFile {
  std::string name, csv;
  /// The step it was made with, an expression. If it is empty, what the file stores of it is taken.
  std::string step = {};
  std::string description = {};  ///< JSON that stands beside the file, as `hbvm run` writes it; it may tell the step
};

/// How many digits of what another program computed are right?
struct ResultsRequest {
  Scene scene;
  std::vector<ResultsFile> files;
  /// What theirs is, an expression in the names of their columns, and which of ours that is. Ours are "t", "bob.x",
  /// "bob.px", "bob.vx" and what the scene observes. Angles may differ by full turns. Columns of these names need not
  /// be mapped, nor "time", "q_3", "p_3" and "v_3". Of "bob.px" and "output.bob.px" of a trajectory of hbvm run the
  /// second, which is tangential, is taken.
  std::vector<std::pair<std::string, std::string>> map = {};
  /// Also plan the cheapest run with as many digits at the last time as the best file has. It may take minutes.
  bool cost = false;
  std::function<void(double part)> progress = {};  ///< called now and then, from any thread
  std::stop_token stop = {};
};

/// One component of one file: right digits at each time. If a vector is exactly 0, they are counted by the greatest one
/// of its kind, q, p or v, at any of the times. Where all are 0 there are none to count: NaN.
struct ComponentDigits {
  std::string name;
  std::vector<double> digits;
  double off_zero = 0;  ///< the greatest error where there are no digits to count
};

/// A component of a file's row at t = 0 that is not what the scene starts with.
struct StartDifference {
  std::string name, theirs, ours;
  double digits = 0;      ///< that are right
  bool opposite = false;  ///< only the sign is another
};

/// What most of an error is.
enum class LostBy {
  growth,  ///< the first error that was seen, magnified by the motion itself
  g,       ///< positions leave the constraints
  hidden,  ///< momenta leave the tangent space
  energy,  ///< H is another
  motion,  ///< none of these: another motion that keeps to all of them, such as one that runs late
};

/// "leaving the constraints g", what follows "the error is mostly".
std::string name_of(LostBy part);

struct FileComparison {
  std::string name;
  std::vector<std::string> times;   ///< those that were compared
  std::vector<std::string> unused;  ///< "2 times before the start", one a reason
  bool stored = false;              ///< the reference was found in the store, and not computed
  std::vector<ComponentDigits> components;
  /// log10 of what each state is off by. H is compared with that of the exact state. H and the constraints g are over
  /// the size of their terms. Hidden is what p is off the tangent space, over |p|. Empty unless the state is complete.
  std::vector<double> H_drift, g_drift, hidden_drift;
  /// Digits that the growth of the first error alone would leave at each time. They are those of the exact motion from
  /// the first state, moved to the constraints. Where states are not complete, an estimate by two other changes of the
  /// start.
  std::vector<double> by_growth;
  std::optional<LostBy> mostly = {};   ///< what the error at the last time is, if the states are complete
  bool has_start = false;              ///< a row at t = 0
  std::vector<StartDifference> start;  ///< what is another there, to more than the digits of the file explain
  double step = 0;                     ///< as the file has it, or between its first two times; NaN if there is one time
  std::string step_text;               ///< the same as a text; empty if it is from the times
  double error = 0;  ///< log10 of the greatest error of a component at the last time, over its vector's size
};

/// The order between two files, as log of the errors' ratio over that of the steps. NaN where the steps are equal or
/// unknown, or the last times are not the same.
struct OrderBetween {
  std::size_t coarse = 0, fine = 0;
  double order = 0;
};

/// An order of convergence lies within value +- uncertainty.
struct MeasuredOrder {
  double value = 0, uncertainty = 0;
};

struct Comparison {
  int digits = 0;  ///< of the reference
  std::vector<FileComparison> files;
  /// The order between each file and that of the next smaller step, whatever their names.
  std::vector<OrderBetween> orders;
  /// The order of all files. Of five steps or more it is judged as `hbvm audit` does. Of fewer it is that of the two
  /// smallest steps, and as uncertain as the one before differs from it. There is none of fewer than three.
  std::optional<MeasuredOrder> measured_order = {};
  std::optional<Plan> plan = {};  ///< if it was asked for

  /// The least right digits of all files, components and times that were compared. A component without digits to count
  /// has the place of its error after the point.
  double least_digits() const;
  /// The order of the two smallest steps; NaN if there is none.
  double order() const { return orders.empty() ? std::numeric_limits<double>::quiet_NaN() : orders.back().order; }
};

/// Right digits of results beside the reference, which is found in the store or computed at their times. At most 50 of
/// a file are compared, evenly spaced, its last among them. \throws InputError for files, columns and maps that cannot
/// be read, naming line and column; IntegrationError, Interrupted
Comparison compare_results(const ResultsRequest& request);

/// Digits against time: a panel a file, a curve a component, and what the growth of errors alone would leave.
/// \param scene its name
Figure figure_of(const Comparison& against, const std::string& scene);
/// For people, as `hbvm reference --against` prints it.
std::string to_text(const Comparison& against);
/// One JSON object, as `hbvm reference --against --json` prints it.
std::string to_json(const Comparison& against);

}  // namespace hbvm
