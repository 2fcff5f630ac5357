#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "hbvm/figure.hpp"
#include "hbvm/horizon.hpp"
#include "hbvm/method.hpp"
#include "hbvm/scene.hpp"

namespace hbvm {

/// The mesh points of a run. Every number is decimal text that reads back exactly.
struct Trajectory {
  /// "t"; "bob.x" ... of q; "bob.px" ... of p; "lambda1" ...; the same of the output state, as "output.bob.px";
  /// "delta_H", "g" and "hidden"; and what the scene observes.
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  /// \throws InputError, with the columns there are, for another name
  std::vector<std::string> text(const std::string& column) const;
  /// The same as doubles. \throws InputError likewise
  std::vector<double> values(const std::string& column) const;
};

/// A run as it is asked for. What method, precision, solver and on_failure may be, methods() and the program's help
/// say.
struct RunRequest {
  Scene scene;
  std::string method = usual_method;  ///< or any other that methods() lists
  /// The last is shortened if until is no multiple. Without, one that suits the scene's time scale.
  std::optional<Number> step = {};
  Number until;
  std::string precision = "double";  ///< or "quad", or "mpfr:50" for 50 decimal digits
  std::string solver = "auto";       ///< of the stage equations
  std::string on_failure = "stop";   ///< or "halve": a step that cannot be made is divided
  bool reverse = false;              ///< back in time
  bool account = false;              ///< tell where the time goes
  bool shadow = false;               ///< tell how many digits survived rounding
  bool horizon = false;              ///< tell how many digits of the start are lost by each time
  bool error = false;                ///< tell how many digits are right
  bool prove = false;                ///< prove, of HBVM(k,s), what its steps without rounding are
  std::string start = {};            ///< JSON with q and p, as to_json() of a run gives it; messages call it start.json
  bool picture = false;              ///< also make a figure and a page that moves
  bool frames = false;               ///< also make pictures one after another
  /// Pairs of what may be observed, as {"a.x", "a.px"}: the figure draws one against the other.
  std::vector<std::pair<std::string, std::string>> portraits = {};
  bool linear_energy = false;  ///< figure and page also show H - H_0 on a linear axis
  long every = 1;              ///< steps between two rows of the trajectory; 0: no trajectory is kept
  Numbers at = {};             ///< times from 0 to the end at which the state is told, too; they need be no mesh points
  std::optional<Number> every_time = {};  ///< and the multiples of this
  /// End the run at an event of the scene by its name, "turn", or at its third, "turn,3". Until is the latest end.
  std::optional<std::string> until_event = {};
  std::function<void(long done, long of)> progress = {};  ///< called now and then, with steps
  std::stop_token stop = {};                              ///< ends the run between two steps
  /// Called before the error is thrown that ends a run on its way: with the mesh points until then.
  std::function<void(Trajectory so_far)> cut_short = {};
};

/// A finding that a user should know of: "energy_lost", and what was seen, when, and what to do.
struct Warning {
  std::string name, text;
};

/// What a run is worth, as decimal text.
struct Health {
  std::string condition;     ///< of the Gram matrix of the normalised gradients, where these came closest to dependence
  std::string worst_e_H;     ///< |H_n - H_0| over the greatest term of H
  std::string worst_hidden;  ///< the greatest cosine of an angle between a velocity and the gradient of a constraint
  std::vector<Warning> warnings;
  std::optional<DigitsLost> horizon = {};  ///< if it was asked for
};

/// A quantity the exact motion conserves: its value at the start and its greatest change over the mesh.
struct Observed {
  std::string name, initial, drift;
};

/// The work that one effect, constraint or moving point has done over a run.
struct Work {
  std::string name;  ///< "effect 2 (drag)", "point 'pivot'"
  std::string value;
};

/// A time at which the value of an event crosses 0, and the output state there, of order 2s of HBVM.
struct Event {
  std::string name, t;
  bool rises = false;   ///< the value is negative before
  bool grazes = false;  ///< the value comes to 0, as near as rounding tells, and turns back
  std::vector<std::string> q, p, lambda;
  std::vector<std::string> observed;  ///< what the scene observes, there
};

/// Times between crossings of an event in one direction: the period, of a motion that has one.
struct EventPeriod {
  std::string name;
  bool rises = false;
  long crossings = 0;           ///< three or more
  std::string least, greatest;  ///< time from one to the next
};

/// The output state at a time that was asked for: q, the tangential p and lambda there, each of order 2s of HBVM.
struct StateAt {
  std::string t;
  std::vector<std::string> q, p, lambda;
  std::string delta_H;  ///< H less that at the start, as at mesh points
};

/// What became of the k that hbvm:auto chose.
struct NodesReport {
  struct Raise {
    std::string t;
    int k, r;  ///< r is 0 if that of the constraints was not raised
  };
  int k = 0, r = 0;           ///< that were chosen; r is 0 if all constraints are quadratic
  std::string because;        ///< why
  std::vector<Raise> raised;  ///< where it had to be raised
  bool verified = false;      ///< the energy is conserved to round-off over the run, and k was enough in all of it
  std::string verdict;        ///< the same for people, with what to do
};

/// What was done to steps that failed.
struct HalvingReport {
  long steps = 0, substeps = 0;
  int depth = 0;         ///< the smallest substep is the step over 2^depth
  std::string smallest;  ///< the same as a time
  std::string first_t;   ///< where the first of them began; empty if there was none
};

/// How many digits of a run survived rounding: -log10 |x - x_shadow| / max |x| over the path, component by component.
/// The shadow is the same run with 16 more digits, from the exact scene or the state it was started from. At least 0;
/// all digits of the precision where there is no difference. It says nothing of the error of the method, which both
/// runs have.
struct Shadow {
  std::string precision;     ///< of the shadow: mpfr:32 for double, mpfr:50 for quad, mpfr:N+16 for mpfr:N
  std::vector<double> q, p;  ///< digits at the end
  struct Worst {
    std::string component, t;
    double digits = 0;
  } worst;              ///< the component with the fewest digits along the path
  long every = 1;       ///< steps between two mesh points compared along the path
  std::string failure;  ///< why the shadow did not reach the end, if it did not; nothing else is known then
  /// When q or p was first off by its size: no digit of it was left.
  std::optional<double> gone_t = {};
};

/// How far the end of a run is from the exact motion. It is compared with a stored reference of this scene and time, if
/// there is one with enough digits. Else it is compared with the motion by its Taylor series with 16 more digits, which
/// chooses its own steps and looks between their points. The end of a Taylor series is compared with HBVM. Where a
/// force is not smooth, or the start leaves the hidden constraints, there is no series. Then a run is made with another
/// step, more stages and 16 more digits. Positions, and the momenta and multipliers of the output state.
struct ErrorEstimate {
  std::string reference;                                  ///< "stored reference, 50 digits" or "computed now"
  std::string method, precision;                          ///< of what was made beside; empty if there is none
  std::string q, p, lambda;                               ///< the greatest differences; empty without constraints
  std::vector<double> q_digits, p_digits, lambda_digits;  ///< that are right, of each; at most those of the precision
  std::string failure;  ///< why the run beside did not reach the end, if it did not; nothing else is known
};

/// What is proved of the steps of HBVM(k,s) without any rounding, from the exact start of the scene. Krawczyk's test
/// shows, in balls, that the equations of each step have one solution in a box. All that is said holds for it.
struct ProvedSteps {
  long steps = 0;
  int digits = 0;          ///< of q, p and lambda at all mesh points, to half a unit of the last digit of the greatest
  int working_digits = 0;  ///< that took
  double growth = 0;       ///< the bounds of the state grew by 10^growth
  /// No other solution of a step's equations is as near, in units of its momenta and of multipliers that would change
  /// them so much.
  std::string only_within;
  std::vector<std::string> q, p, lambda;          ///< at the end, so many digits; lambda by (57)
  std::vector<std::string> lambda_names;          ///< of the constraints that do not follow from others
  std::string q_radius, p_radius, lambda_radius;  ///< the greatest bounds of what they are off by, at all mesh points
  std::string e_H, e_g;                           ///< |H(y_n) - H_0| and |g(q_n)| are at most that at all mesh points
  std::string e_H_least, e_g_least;               ///< at one point at least that; empty if both may be 0 at all
  std::string off_q, off_p;                       ///< by which the end of the run itself is off at most: its rounding
  double cpu_seconds = 0;
};

/// "multiply": how many of them; all there are, in one order.
using OperationList = std::vector<std::pair<std::string, std::uint64_t>>;

/// One line of the account of a run: what effects and parts of the solver did and took.
struct AccountEntry {
  std::string name;
  bool effect = false;     ///< one that the scene names
  bool in_double = false;  ///< done in double by a solver in more digits
  std::uint64_t calls = 0, evaluations = 0;
  OperationList operations;   ///< in all
  OperationList done_before;  ///< those that another effect had done already
  double seconds = 0;         ///< of the processor
};

/// What came out. Every number of the working precision is decimal text that reads back exactly.
struct Run {
  std::string scene, title, scene_toml;
  std::string method;  ///< with k as chosen
  std::string solver, precision;
  std::string step, until, t;
  std::string last_step;  ///< if it was shortened, as until is no multiple of the step; else empty
  bool reverse = false;
  std::string start;          ///< the file or text it started from, if not the scene's own start
  std::string start_settled;  ///< how the start was moved to where the constraints hold; empty if it was not
  long steps = 0;
  std::vector<std::string> q_names, p_names;         ///< "a.x", "a.px"
  std::vector<std::string> lambda_names;             ///< the constraint of each multiplier
  std::vector<std::string> q, p, lambda;             ///< at the end; lambda by (57)
  std::vector<std::string> q_carry, p_carry;         ///< what rounding took from q and p
  std::vector<std::string> output_p, output_lambda;  ///< p projected to the tangent space, and the multiplier there
  std::string output_delta_H;                        ///< H(q, output_p) - H_0
  std::string e_H, e_g, e_hid;  ///< greatest errors at mesh points, of H, of g and of the hidden constraints
  /// The greatest error of H - W, the work W done until the end, and whose it is. They are empty unless forces without
  /// a potential act, or t stands in the scene.
  std::string e_B, work;
  std::vector<Work> works;
  double iterations_per_step = 0, cpu_seconds = 0;
  Health health;
  std::optional<NodesReport> nodes;      ///< if k was chosen
  std::optional<HalvingReport> halving;  ///< if steps might be divided
  std::optional<Shadow> shadow;
  std::optional<ErrorEstimate> error;
  std::optional<ProvedSteps> proved;
  bool observes = false;                  ///< whether the scene names quantities to be observed
  std::vector<Observed> observables;      ///< those of them that the motion conserves
  std::vector<Observation> observations;  ///< of the output state at the end
  std::vector<AccountEntry> account;
  std::vector<Event> events;  ///< of the scene's events, in the order of time
  std::vector<EventPeriod> periods;
  std::vector<StateAt> at;  ///< at the times that were asked for, in their order
  Trajectory trajectory;
  std::optional<Figure> figure;  ///< motion, multipliers and errors, if a picture was asked for
  std::string page;              ///< HTML of its own, in which the motion moves; likewise
  std::vector<Figure> frames;    ///< the motion as pictures one after another, 20 a second, if they were asked for
  std::string command;           ///< of the program, which makes the same motion
};

/// \throws InputError, IntegrationError with the time where the run could not go on, Interrupted
Run run(const RunRequest& request);

/// The step of a run that asks for none, an exact number. It is at most an eighth of the radius of convergence of the
/// motion's Taylor series. \throws InputError where there is no series
std::string usual_step(const Scene& scene, const Number& until);

/// Lines for people, as `hbvm run` prints them: a verdict, errors, warnings, and the output state. Its numbers have the
/// digits that were found right, or six if none were looked for.
/// \param state all digits instead, of the propagated state and of that of output
std::string to_text(const Run& run, bool state = false);

/// One JSON object, as `hbvm run --json` prints it. Every number of the working precision is decimal text that reads
/// back exactly. What is about a run, as its time and its digits, is a JSON number.
/// \param states also the mesh points of the trajectory
std::string to_json(const Run& run, bool states = false);

}  // namespace hbvm
