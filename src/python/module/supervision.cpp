#include "supervision.hpp"

#include <chrono>
#include <csignal>

namespace py = pybind11;

namespace hbvm::python {
namespace {

std::atomic<int> interrupts{0};
static_assert(std::atomic<int>::is_always_lock_free, "else a signal handler may not change it");
struct sigaction of_python {};
int installed = 0;  ///< under Python's lock

/// Notes the signal, and lets Python note it.
void on_interrupt(int signal) {
  interrupts.fetch_add(1, std::memory_order_relaxed);
  of_python.sa_handler(signal);
}

bool is_main_thread() {
  const py::module_ threading = py::module_::import("threading");
  return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

/// Unless Ctrl-C does nothing here, or ends the process.
bool install() {
  if (installed == 0) {
    sigaction(SIGINT, nullptr, &of_python);
    const bool handled =
        (of_python.sa_flags & SA_SIGINFO) == 0 && of_python.sa_handler != SIG_DFL && of_python.sa_handler != SIG_IGN;
    if (!handled) return false;
    struct sigaction ours = of_python;
    ours.sa_handler = on_interrupt;
    sigaction(SIGINT, &ours, nullptr);
  }
  ++installed;
  return true;
}

void take_back() {
  if (--installed == 0) sigaction(SIGINT, &of_python, nullptr);
}

}  // namespace

Supervision::Supervision(py::object progress) : progress_(std::move(progress)) {
  sees_signals_ = is_main_thread() && install();
  interrupts_before_ = interrupts;
  if (sees_signals_ || !progress_.is_none()) watcher_ = std::thread([this] { watch(); });
}

Supervision::~Supervision() {
  if (watcher_.joinable()) {
    {
      const std::lock_guard lock(guards_end_);
      end_ = true;
    }
    ended_.notify_one();
    watcher_.join();
  }
  if (sees_signals_) take_back();
}

void Supervision::watch() {
  constexpr std::chrono::milliseconds pause{20};
  std::unique_lock lock(guards_end_);
  while (!ended_.wait_for(lock, pause, [this] { return end_; })) {
    due_ = true;
    if (sees_signals_ && interrupts != interrupts_before_) stop_.request_stop();
  }
}

std::function<void(long, long)> Supervision::steps() {
  return [this](long done, long of) { report(static_cast<double>(done), static_cast<double>(of)); };
}

std::function<void(double)> Supervision::parts() {
  return [this](double part) { report(part, 1); };
}

void Supervision::report(double done, double of) {
  if (!due_.load(std::memory_order_relaxed) && done < of) return;
  if (progress_.is_none() && !(sees_signals_ && std::this_thread::get_id() == caller_)) return;
  if (stop_.stop_requested()) return;
  due_ = false;
  const py::gil_scoped_acquire locked;
  try {
    if (!progress_.is_none()) progress_(done, of);
    look_for_signals();
  } catch (const py::error_already_set&) {
    keep_error();
  }
}

/// Others than Ctrl-C, too, have handlers in Python.
void Supervision::look_for_signals() {
  if (std::this_thread::get_id() == caller_ && PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void Supervision::keep_error() {
  const std::lock_guard lock(guards_error_);
  if (!error_) error_ = std::current_exception();
  stop_.request_stop();
}

void Supervision::raise_cause() {
  if (error_) std::rethrow_exception(error_);
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace hbvm::python
