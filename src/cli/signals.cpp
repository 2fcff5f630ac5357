#include "signals.hpp"

#include <atomic>
#include <csignal>

#include "interruption.hpp"

namespace hbvm::core {

namespace {

std::atomic<int> signal_number{0};
const StopRequest by_signal{{}, &signal_number};

}  // namespace

void end_runs(int signal) { signal_number = signal; }

void end_runs_on_signals() {
  stop_request = &by_signal;
  struct sigaction action {};
  action.sa_handler = end_runs;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace hbvm::core
