#include "processes/child_process.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <exception>
#include <utility>

#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

enum Exit { done = 0, threw = 1, unwritten = 2 };

bool write_all(int file, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = write(file, text.data() + at, text.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    at += static_cast<std::size_t>(written);
  }
  return true;
}

/// In the new process: nothing of the old one is flushed or destroyed a second time.
[[noreturn]] void work_and_end(const std::function<std::string()>& work, int file, double seconds) {
  const auto limit = static_cast<rlim_t>(std::ceil(seconds));
  const rlimit processor{limit, limit + 1}, no_core{0, 0};
  setrlimit(RLIMIT_CPU, &processor);
  setrlimit(RLIMIT_CORE, &no_core);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::string text;
  Exit code = done;
  try {
    text = work();
  } catch (const std::exception& error) {
    text = error.what();
    code = threw;
  } catch (...) {
    code = threw;
  }
  if (!write_all(file, text)) code = unwritten;
  _exit(code);
}

}  // namespace

ChildProcess::ChildProcess(const std::function<std::string()>& work, double seconds) : seconds_(seconds) {
  int ends[2];
  if (pipe(ends) != 0) throw Error(std::string("cannot open a pipe: ") + std::strerror(errno));
  process_ = fork();
  if (process_ == 0) {
    close(ends[0]);
    work_and_end(work, ends[1], seconds);
  }
  close(ends[1]);
  file_ = ends[0];
  if (process_ < 0) {
    close(file_);
    throw Error(std::string("cannot start a process: ") + std::strerror(errno));
  }
}

ChildProcess::~ChildProcess() {
  if (file_ >= 0) close(file_);
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
}

bool ChildProcess::take() {
  char buffer[4096];
  const ssize_t count = read(file_, buffer, sizeof buffer);
  if (count > 0) {
    text_.append(buffer, static_cast<std::size_t>(count));
    return false;
  }
  if (count < 0 && errno == EINTR) return false;
  int status = 0;
  rusage usage{};
  while (wait4(process_, &status, 0, &usage) < 0 && errno == EINTR) continue;
  process_ = -1;
  for (const timeval& t : {usage.ru_utime, usage.ru_stime})
    cpu_seconds_ += static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) / 1'000'000;
  if (WIFEXITED(status) && WEXITSTATUS(status) == done) return true;
  const std::string text = std::exchange(text_, "");
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
    failure_ = fmt::format("no end within {} s of processor time", std::ceil(seconds_));
  else if (WIFSIGNALED(status))
    failure_ = std::string("a crash: ") + strsignal(WTERMSIG(status));
  else
    failure_ = WEXITSTATUS(status) == threw ? "an exception: " + text : "its result is lost";
  return true;
}

}  // namespace hbvm::core
