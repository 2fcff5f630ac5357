#pragma once

namespace hbvm::core {

/// Called in the main thread, before others are started. From now on SIGINT, SIGTERM and SIGHUP end a run after a step
/// or a part of one (Interrupted). A second signal of a kind ends the program itself at once. Signals that were ignored
/// stay so. A file that has grown too large fails to be written as on a full disk, without a signal.
void end_runs_on_signals();

/// What such a signal does; 0 takes it back.
void end_runs(int signal);

}  // namespace hbvm::core
