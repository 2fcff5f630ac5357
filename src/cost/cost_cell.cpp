#include "cost/cost_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <future>
#include <numeric>
#include <optional>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "clock.hpp"
#include "cost/calibration.hpp"
#include "integrate/integrate.hpp"
#include "integrate/output_state.hpp"
#include "interruption.hpp"
#include "run/run_stepper.hpp"
#include "scalar/with_scalar.hpp"
#include "thread_caches.hpp"

namespace hbvm::core {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n == 0 ? 0 : (values[(n - 1) / 2] + values[n / 2]) / 2;
}

#ifdef __GLIBC__
long bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<long>(info.uordblks + info.hblkhd);
}

/// f() in a thread with a heap of its own that nothing was taken from before. One that was used has gaps, which differ
/// from process to process, and pieces that fill them are larger here and there. A new thread goes on with the heap of
/// one that has ended, if there is any. So such a heap is kept busy by the thread that has it while the next one looks.
/// (There may be so many threads that heaps are shared: then the last one has to do.)
template <class F>
long in_new_heap(const F& f, int most = 16) {
  return std::async(std::launch::async,
                    [&, asker = stop_request] {
                      const StopScope scope(asker);
                      const ThreadCaches freed;
                      const std::size_t before = mallinfo2().arena;
                      const auto first = std::make_unique<char>();
                      const bool is_new = mallinfo2().arena != before;
                      return is_new || most == 0 ? f() : in_new_heap(f, most - 1);
                    })
      .get();
}
#else
/// Other libraries do not tell how much they have given: 0.
long bytes_in_use() { return 0; }

template <class F>
long in_new_heap(const F& f) {
  return f();
}
#endif

void add_counts_of(CostMeasurement& m, const Account& account) {
  for (const AccountLine& line : account.lines) {
    std::uint64_t& sum = line.kind == AccountLine::Kind::in_double ? m.operations_in_double : m.operations;
    sum += (line.operations - line.done_before).total();
    m.evaluations += line.evaluations;
  }
}

/// A cell in one precision.
template <Scalar S>
class CostRun {
 public:
  CostRun(const Scene& scene, const Expression& until, const CostCell& cell)
      : cell_(cell),
        assembled_(assemble<S>(scene)),
        grid_(Expression::parse(step_text(until, cell.steps)), until, scene.constants) {}

  /// The first chooses k, if that is left open; those after it have the same.
  std::unique_ptr<Stepper<S>> stepper() {
    if (!chosen_) {
      auto made = std::make_unique<RunStepper<S>>(assembled_, cell_.method, grid_.step(), SolverKind::automatic,
                                                  OnFailure::stop);
      method_ = made->method();
      chosen_ = made->chosen();
      return made;
    }
    if (chosen_->exact) return method_->make_stepper(assembled_.problem, SolverKind::automatic);
    const HbvmName name{chosen_->k, method_->stages(), chosen_->r};
    return std::make_unique<RaisingStepper<S>>(assembled_.problem, name, SolverKind::automatic, log_, OnShortage::keep,
                                               chosen_->raises);
  }

  /// The first run, which says what came out.
  CostMeasurement first(const CostJudge& judge) {
    CostMeasurement m;
    m.method = cell_.method->text();
    const double before = thread_seconds();
    try {
      const auto made = stepper();
      m.setup_seconds = thread_seconds() - before;
      m.method = method_->text();
      State<S> state(assembled_.q0, assembled_.p0);
      const Integration<S> run = integrate<S>(*made, state, grid_, {});
      m.seconds = run.cpu_seconds;
      m.sweeps = run.sweeps;
      add_counts_of(m, account_of(assembled_.problem, made->counts()));
      StateEvaluator<S> point(assembled_.problem);
      const OutputState<S> output = output_state(point, run.end.q, run.end.p);
      m.errors = judge.errors<S>(run.end.q, output.p, output.lambda);
      m.raw = judge.errors<S>(run.end.q, run.end.p, run.end.lambda);
      const CostErrors& least = judge.resolution();
      m.at_reference = m.errors.q <= least.q || m.errors.p <= least.p || m.errors.lambda <= least.lambda;
      if (!std::isfinite(m.errors.of(CostQuantity::all))) m.failure = "the state at the end is not finite";
    } catch (const InputError&) {
      throw;
    } catch (const Interrupted&) {
      throw;
    } catch (const Error& error) {
      m.failure = error.what();
    }
    return m;
  }

  /// What the heap holds of coefficients and stepper after the first steps. Once a run was made, what is kept for all
  /// runs is there already.
  long held_bytes() {
    const auto held = [&]<Scalar>() {
      const long before = bytes_in_use();
      const auto made = stepper();
      State<S> state(assembled_.q0, assembled_.p0);
      for (long n = 0; n < std::min(2L, cell_.steps); ++n) made->step(state, grid_.step());
      return bytes_in_use() - before;
    };
    return in_new_heap([&] { return with_scalar(cell_.precision, held); });
  }

  double seconds_again() {
    const auto made = stepper();
    State<S> state(assembled_.q0, assembled_.p0);
    return integrate<S>(*made, state, grid_, {}).cpu_seconds;
  }

  /// The first steps, with the time of each part.
  void account(CostMeasurement& m, long steps) {
    const auto made = stepper();
    const MeasuredParts measured;
    State<S> state(assembled_.q0, assembled_.p0);
    const double before = thread_seconds(), elapsed_before = elapsed_seconds();
    for (long n = 0; n < steps; ++n) made->step(state, grid_.step());
    const double cpu = thread_seconds() - before, elapsed = elapsed_seconds() - elapsed_before;
    Account account = account_of(assembled_.problem, made->counts());
    balance(account, cpu, elapsed);
    m.account_steps = steps;
    m.account = std::move(account.lines);
  }

  CostSample sample(long most, double enough) {
    CostSample result;
    try {
      const auto made = stepper();
      State<S> state(assembled_.q0, assembled_.p0);
      // The first have no earlier ones to begin from.
      const long first = std::min(2L, cell_.steps / 4);
      for (long n = 0; n < first; ++n) made->step(state, grid_.step());
      CostMeasurement earlier, all;
      add_counts_of(earlier, account_of(assembled_.problem, made->counts()));
      const double before = thread_seconds();
      double seconds = 0;
      while (result.steps < std::min(most, cell_.steps - first) && (result.steps == 0 || seconds < enough)) {
        made->step(state, grid_.step());
        ++result.steps;
        seconds = thread_seconds() - before;
      }
      add_counts_of(all, account_of(assembled_.problem, made->counts()));
      const auto steps = static_cast<double>(result.steps);
      result.seconds = seconds / steps;
      result.operations = static_cast<double>(all.operations - earlier.operations) / steps;
      result.operations_in_double =
          static_cast<double>(all.operations_in_double - earlier.operations_in_double) / steps;
    } catch (const Interrupted&) {
      throw;
    } catch (const Error& error) {
      result.failure = error.what();
    }
    return result;
  }

 private:
  const CostCell& cell_;
  Assembled<S> assembled_;
  TimeGrid<S> grid_;
  MethodPtr method_;
  std::optional<ChosenK> chosen_;
  NodeLog log_;
};

/// A repetition beside which the calibration is slower than this, of the quickest, does not count.
constexpr double most_disturbed = double{11} / 10;

/// Repetitions of a run, each between two calibrations.
class Repetitions {
 public:
  Repetitions(const std::function<double()>& calibrate, const CostRepetitions& wanted)
      : calibrate_(calibrate), wanted_(wanted) {}

  /// A run that was made already, with the calibration before it.
  void add(double time, double before) {
    times_.push_back({time, (before + calibrate_()) / 2});
    spent_ += time;
  }

  void run(const std::function<double()>& seconds) {
    const double start = thread_seconds() - spent_;
    double before = calibrate_();
    // Twice as many as are wanted, if some do not count; but a long run is its own mean over what disturbs it.
    const double patience = 10 * wanted_.seconds;
    const auto made = [&] { return static_cast<int>(times_.size()); };
    while (made() < wanted_.most) {
      const double spent = thread_seconds() - start;
      const int tries = spent < patience ? 2 * wanted_.least : wanted_.least;
      if (spent >= wanted_.seconds && (made() >= tries || counting() >= wanted_.least)) break;
      const double time = seconds(), after = calibrate_();
      times_.push_back({time, (before + after) / 2});
      before = after;
    }
  }

  void report(CostMeasurement& m) const {
    const double quickest = this->quickest();
    const bool any = counting() > 0;
    std::vector<double> seconds, calibrations;
    for (const auto& [time, beside] : times_) {
      const bool counts = beside <= most_disturbed * quickest;
      if (!counts) ++m.disturbed;
      if (any && !counts) continue;
      seconds.push_back(time);
      calibrations.push_back(beside);
    }
    m.seconds = median(seconds);
    const auto [least, most] = std::minmax_element(seconds.begin(), seconds.end());
    m.spread = m.seconds > 0 ? (*most - *least) / (2 * m.seconds) : 0;
    m.calibration = median(calibrations);
    m.repetitions = static_cast<int>(seconds.size());
  }

 private:
  struct Timed {
    double seconds, calibration;
  };
  double quickest() const {
    double least = times_.front().calibration;
    for (const Timed& t : times_) least = std::min(least, t.calibration);
    return least;
  }
  int counting() const {
    if (times_.empty()) return 0;
    const double limit = most_disturbed * quickest();
    return static_cast<int>(
        std::count_if(times_.begin(), times_.end(), [&](const Timed& t) { return t.calibration <= limit; }));
  }

  const std::function<double()>& calibrate_;
  const CostRepetitions& wanted_;
  std::vector<Timed> times_;
  double spent_ = 0;
};

}  // namespace

std::string step_text(const Expression& until, long steps) {
  const std::string& text = until.text();
  long whole = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), whole);
  if (read.ec == std::errc() && read.ptr == text.data() + text.size() && whole > 0) {
    const long common = std::gcd(whole, steps);
    return steps == common ? std::to_string(whole / common) : fmt::format("{}/{}", whole / common, steps / common);
  }
  return fmt::format("({})/{}", text, steps);
}

CostMeasurement measure_cost(const Scene& scene, const Expression& until, const CostCell& cell, const CostJudge& judge,
                             const CostRepetitions& wanted) {
  return with_scalar(cell.precision, [&]<Scalar S>() {
    CostRun<S> run(scene, until, cell);
    const Calibration<S> calibration(cell.precision);
    const std::function<double()> calibrate = [&] { return calibration.seconds(); };
    const double before = calibrate();
    CostMeasurement m = run.first(judge);
    if (!m.failure.empty()) return m;
    const double once = m.seconds;
    // Clocks and caches need some milliseconds to show the time of a run; but coefficients are made for each.
    constexpr double long_for_clock = double{2} / 1'000, long_for_setup = double{2} / 100;
    const double most_at_once = long_for_setup / (once + m.setup_seconds + 1 / double{1'000'000});
    const long at_once = std::max(1L, std::lround(std::min(std::ceil(long_for_clock / once), most_at_once)));
    Repetitions repetitions(calibrate, wanted);
    // Caches make no difference to it.
    if (once >= wanted.seconds) repetitions.add(once, before);
    repetitions.run([&] {
      double sum = 0;
      for (long n = 0; n < at_once; ++n) sum += run.seconds_again();
      return sum / static_cast<double>(at_once);
    });
    repetitions.report(m);
    if (wanted.account) {
      constexpr long few = 8;
      constexpr double long_enough = double{1} / 4;
      const double possible = once > 0 ? static_cast<double>(cell.steps) * long_enough / once : few;
      run.account(m, std::min(cell.steps, std::max(few, static_cast<long>(possible))));
    }
    // Last, as a second thread makes every allocation after it cost more.
    m.bytes = run.held_bytes();
    return m;
  });
}

CostSample sample_cost(const Scene& scene, const Expression& until, const CostCell& cell, long most, double seconds) {
  return with_scalar(cell.precision, [&]<Scalar S>() { return CostRun<S>(scene, until, cell).sample(most, seconds); });
}

}  // namespace hbvm::core
