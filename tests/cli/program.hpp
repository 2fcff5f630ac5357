#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "folder.hpp"
#include "words.hpp"

namespace hbvm::core {

using Arguments = std::vector<std::string>;

/// What the program left behind.
struct Outcome {
  int code = -1;  ///< exit code; -signal if a signal ended it
  std::string out, err;
};

/// Runs `hbvm` with these arguments, without a terminal and with an empty standard input. `limit` is called in the new
/// process before the program is; `meanwhile` is told which process it is.
inline Outcome run_program(const Arguments& arguments, const std::function<void()>& limit,
                           const std::function<void(pid_t)>& meanwhile = {}) {
  const Folder folder;
  const std::string out = folder / "out", err = folder / "err";
  std::string program = HBVM_PROGRAM;
  Arguments words = arguments;
  std::vector<char*> argv{program.data()};
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child == 0) {
    const auto redirect = [](const char* path, int flags, int to) {
      const int file = open(path, flags, 0600);
      if (file < 0 || dup2(file, to) < 0) _exit(126);
    };
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(out.c_str(), O_WRONLY | O_CREAT, STDOUT_FILENO);
    redirect(err.c_str(), O_WRONLY | O_CREAT, STDERR_FILENO);
    limit();
    execv(program.c_str(), argv.data());
    _exit(127);
  }
  if (meanwhile) meanwhile(child);
  int status = 0;
  if (waitpid(child, &status, 0) != child) throw std::runtime_error("the program is lost");
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), text_of(out), text_of(err)};
}

/// Sanitizers make a program so many times slower.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr unsigned slowness = 20;
#else
constexpr unsigned slowness = 1;
#endif

/// Ends the program after `cpu_limit` seconds of processor time, which is far more than it takes: no test hangs.
inline Outcome hbvm(const Arguments& arguments, unsigned cpu_limit = 60,
                    const std::function<void(pid_t)>& meanwhile = {}) {
  return run_program(
      arguments,
      [cpu_limit] {
        const rlimit limit{slowness * cpu_limit, slowness * cpu_limit};
        setrlimit(RLIMIT_CPU, &limit);
      },
      meanwhile);
}

/// The program, which ends with this exit code.
inline Outcome ended_with(int code, const Arguments& arguments, unsigned cpu_limit = 60) {
  const Outcome outcome = hbvm(arguments, cpu_limit);
  EXPECT_EQ(outcome.code, code) << ::testing::PrintToString(arguments) << '\n' << outcome.err << outcome.out;
  return outcome;
}

/// Kills the program, by SIGPROF, once it has used so many microseconds of processor time. Where that is in its work
/// does not depend on what else the machine does.
inline Outcome hbvm_killed_after(long microseconds, const Arguments& arguments) {
  return run_program(arguments, [microseconds] {
    const itimerval timer{{0, 0}, {microseconds / 1'000'000, microseconds % 1'000'000}};
    setitimer(ITIMER_PROF, &timer, nullptr);
  });
}

inline Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// What it takes to run a scene.
inline Arguments run_of(const std::string& scene, const std::string& method, const std::string& step,
                        const std::string& until) {
  return {"run", scene, "--method", method, "--step", step, "--until", until};
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// What standard error says of these files.
inline std::string written(const Arguments& files) {
  std::string lines;
  for (const std::string& file : files) lines += "written to " + file + "\n";
  return lines;
}

/// A trajectory and what describes it.
inline Arguments with_metadata(const std::string& csv) { return {csv, csv + "-metadata.json"}; }

/// Exit code 2, nothing on standard output, one line on standard error that holds these words.
inline void expect_refused(const Arguments& arguments, const std::vector<std::string>& words) {
  SCOPED_TRACE(::testing::PrintToString(arguments));
  const Outcome outcome = ended_with(2, arguments);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(lines_of(outcome.err).size(), 1u) << outcome.err;
  EXPECT_TRUE(outcome.err.ends_with('\n'));
  for (const std::string& word : words) expect_words(outcome.err, {word});
}

/// A pendulum of this velocity at its lowest point.
inline std::string pendulum(const std::string& velocity) {
  return "title = \"Pendulum\"\ndimension = 2\n\n[[point]]\nname = \"O\"\nposition = [0, 0]\n\n"
         "[[body]]\nname = \"bob\"\nmass = 1\nposition = [0, -1]\nvelocity = [" +
         velocity +
         ", 0]\n\n"
         "[[constraint]]\nkind = \"rod\"\nbetween = [\"O\", \"bob\"]\nlength = 1\n\n"
         "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [0, -1]\n";
}

/// A stone that falls into an attracting centre, which it would reach at t = pi/sqrt(8) = 1.11.
inline std::string fall() {
  return "dimension = 2\n[[point]]\nname = \"sun\"\nposition = [0, 0]\n[[body]]\nname = \"stone\"\nmass = 1\n"
         "position = [1, 0]\nvelocity = [0, 0]\n[[effect]]\nkind = \"central_gravity\"\ncenter = \"sun\"\nstrength = "
         "1\n";
}

}  // namespace hbvm::core
