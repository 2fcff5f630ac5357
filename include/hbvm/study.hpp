#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "hbvm/figure.hpp"
#include "hbvm/order.hpp"
#include "hbvm/run.hpp"
#include "hbvm/scene.hpp"

namespace hbvm {

/// A folder with a study.toml: its runs, its tables, and what they are compared with.
struct StudyRequest {
  std::string folder, precision = "double";
  bool check = true;     ///< compare with the folder's expected.csv
  std::string out = {};  ///< where files go; results/PRECISION in the folder if empty
  /// Draws a picture into a file, by gnuplot_script() for example; without it there are none, and a warning for each.
  std::function<void(const Figure& figure, const std::string& file)> draw = {};
  int jobs = 1;                                           ///< threads
  std::function<void(long done, long of)> progress = {};  ///< called now and then, from any thread
  std::stop_token stop = {};
};

struct Study {
  std::string title, table;             ///< in Markdown
  long agreed = 0, stated = 0;          ///< figures of expected.csv that were met, and in all
  std::vector<std::string> files;       ///< tables and pictures written
  std::vector<std::string> complaints;  ///< one line for each figure that was not met
  std::vector<std::string> warnings;    ///< pictures that could not be drawn, and why
};

/// \throws InputError with file and line for a study.toml that is wrong; IntegrationError, Interrupted
Study study(const StudyRequest& request);

std::string to_json(const Study& study);

/// Several methods on one scene, by the same step until the same time.
struct MethodsRequest {
  Scene scene;
  std::vector<std::string> methods;  ///< as methods() lists them
  std::optional<Number> step = {};   ///< of which until is a multiple; without, one that suits the scene's time scale
  Number until;
  std::string precision = "double";
  bool reference = false;                                 ///< tell how many digits are right at the end
  bool picture = false;                                   ///< also make a figure and a page that moves
  std::function<void(long done, long of)> progress = {};  ///< called now and then, with steps of all methods
  std::stop_token stop = {};
};

/// What became of one of them. Numbers are decimal text.
struct MethodRun {
  std::string method;            ///< as it was asked for
  std::string resolved;          ///< what that is: "rattle" for "verlet", and with k as chosen
  std::string e_H, e_g, e_hid;   ///< greatest errors at mesh points, of H, of g and of the hidden constraints
  std::optional<double> digits;  ///< right ones of the positions at the end, of their greatest coordinate
  double cpu_seconds = 0;
  std::vector<Warning> warnings;  ///< as run() tells them
  std::string failure;  ///< why it did not come to the end, with the time; all else but the method is then empty
};

struct MethodComparison {
  std::string scene, title, step, until, precision;
  std::vector<MethodRun> runs;
  std::string no_digits;         ///< why there are none, if they were asked for
  std::optional<Figure> figure;  ///< motions over one another and errors, if a picture was asked for
  std::string page;              ///< HTML of its own, in which all move on one clock; likewise
  std::string command;           ///< of the program, which makes the same
};

/// A run that fails on the way is told as such, and ends no other.
/// \throws InputError, Interrupted
MethodComparison compare_methods(const MethodsRequest& request);

/// A table of names and errors, and the warnings of each run.
std::string to_text(const MethodComparison& comparison);
std::string to_json(const MethodComparison& comparison);

/// Errors against the step, of several methods on one scene, and the rates that they tend to.
struct ConvergenceRequest {
  Scene scene;
  std::vector<std::string> methods;
  std::string steps;                 ///< "1/8:1/256", each half of the one before
  std::optional<Number> until = {};  ///< a multiple of the steps; without, sixteen of the longest
  std::vector<std::string> precisions = {"double"};
  bool propagated = false;  ///< p and lambda as they are carried on, instead of those of the output state
  bool picture = false;
  std::function<void(long done, long of)> progress = {};  ///< called now and then, with steps of all runs
  std::stop_token stop = {};
};

/// One method in one precision. Parts are q, p and lambda; without constraints there is no lambda.
struct MethodOrders {
  struct Point {
    std::string step, q, p, lambda;  ///< greatest errors at the end, as decimal text
  };
  std::string method;    ///< as it was asked for
  std::string resolved;  ///< what that is, with k as chosen at the finest step
  std::string precision;
  std::optional<MeasuredRate> q, p, lambda;  ///< none where too few errors are above round-off
  std::vector<Point> points;                 ///< from coarse to fine
  std::string failure;                       ///< of the first step that could not be made
};

struct ConvergenceStudy {
  std::string scene, title, until;
  bool propagated = false;
  std::vector<MethodOrders> methods;
  std::optional<Figure> figure;  ///< a panel for each of q, p and lambda, with slopes; if a picture was asked for
  std::string command;           ///< of the program, which makes the same
};

/// \throws InputError, also where the exact motion is not known; Interrupted
ConvergenceStudy convergence(const ConvergenceRequest& request);

/// A table of errors against the step for each method, with the rates below; of several methods the rates once more.
std::string to_text(const ConvergenceStudy& convergence);
std::string to_json(const ConvergenceStudy& convergence);

}  // namespace hbvm
