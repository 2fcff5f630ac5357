#include "processes/shell_command.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <string_view>
#include <thread>

#include "hbvm/error.hpp"
#include "interruption.hpp"
#include "read_file.hpp"

namespace hbvm::core {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// A shell in a process group of its own. What is left of the group ends with this.
class Shell {
 public:
  Shell(const std::string& command, const std::string& prints_to) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    constexpr mode_t mode = S_IRUSR | S_IWUSR;
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, prints_to.c_str(), O_WRONLY | O_CREAT | O_TRUNC, mode);
    posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    std::string shell = "sh", option = "-c", text = command;
    char* const arguments[]{shell.data(), option.data(), text.data(), nullptr};
    const int failure = posix_spawn(&process_, "/bin/sh", &files, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (failure != 0) throw Error(std::string("cannot start a shell: ") + std::strerror(failure));
  }
  ~Shell() {
    kill(-process_, SIGKILL);
    if (!ended_) waitpid(process_, nullptr, 0);
  }
  Shell(const Shell&) = delete;

  bool has_ended() {
    const pid_t which = waitpid(process_, &status_, WNOHANG);
    ended_ = which == process_ || (which < 0 && errno != EINTR);
    return ended_;
  }
  /// Empty if all went well.
  std::string failure() const {
    if (WIFSIGNALED(status_)) return "ended by " + name_of_signal(WTERMSIG(status_));
    return WEXITSTATUS(status_) == 0 ? std::string() : fmt::format("ended with code {}", WEXITSTATUS(status_));
  }

 private:
  pid_t process_ = -1;
  int status_ = 0;
  bool ended_ = false;
};

/// Of a long text the end.
std::string last_lines(std::string text) {
  constexpr std::size_t most = 400;
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text.size() <= most ? text : "..." + text.substr(text.size() - most);
}

}  // namespace

std::string shell_quoted(const std::string& argument) {
  std::string result = "'";
  for (const char c : argument) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

void run_shell_command(const std::string& command, double seconds, const std::filesystem::path& prints_to) {
  Shell shell(command, prints_to.string());
  const auto start = SteadyClock::now();
  const auto fail = [&](const std::string& how) {
    const std::string printed = last_lines(read_file(prints_to.string()));
    throw Error(fmt::format("'{}' {}{}", command, how, printed.empty() ? "" : ", having printed: " + printed));
  };
  constexpr std::chrono::milliseconds pause(2);
  while (!shell.has_ended()) {
    end_if_asked("running a command");
    if (seconds > 0 && std::chrono::duration<double>(SteadyClock::now() - start).count() > seconds)
      fail(fmt::format("took more than {:.0f} seconds", seconds));
    std::this_thread::sleep_for(pause);
  }
  if (const std::string how = shell.failure(); !how.empty()) fail(how);
}

}  // namespace hbvm::core
