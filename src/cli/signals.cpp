#include "signals.hpp"

#include <csignal>

#include "interruption.hpp"

namespace hbvm {

void end_runs_on_signals() {
  struct sigaction action {};
  action.sa_handler = [](int signal) { interruption = signal; };
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace hbvm
