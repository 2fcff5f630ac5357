#include "processes/child_process.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

namespace hbvm::core {
namespace {

/// The end of work in a process of its own.
struct End {
  std::string text, failure;
  double cpu_seconds;
};
End end_of(const std::function<std::string()>& work, double seconds = 10) {
  ChildProcess apart(work, seconds);
  while (!apart.take()) continue;
  return {apart.text(), apart.failure(), apart.cpu_seconds()};
}

TEST(WorkApart, SendsItsWholeText) {
  std::string text(300'000, '\0');
  for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>(i * 31);
  const End end = end_of([&] { return text; });
  EXPECT_TRUE(end.text == text);
  EXPECT_EQ(end.failure, "");
}

TEST(WorkApart, IsOfAnotherProcess) {
  int here = 0;
  const End end = end_of([&] {
    here = 1;
    return std::to_string(getpid());
  });
  EXPECT_EQ(here, 0);
  EXPECT_NE(end.text, std::to_string(getpid()));
}

TEST(WorkApart, FailsWithWhatWasThrown) {
  EXPECT_EQ(end_of([]() -> std::string { throw std::runtime_error("odd"); }).failure, "an exception: odd");
  EXPECT_EQ(end_of([]() -> std::string { throw 3; }).failure, "an exception: ");
}

TEST(WorkApart, CrashesAlone) {
  const End end = end_of([]() -> std::string {
    std::signal(SIGFPE, SIG_DFL);
    std::raise(SIGFPE);
    return "not reached";
  });
  EXPECT_EQ(end.text, "");
  EXPECT_TRUE(end.failure.starts_with("a crash: ")) << end.failure;
}

TEST(WorkApart, IsEndedAfterItsProcessorTime) {
  const End end = end_of(
      []() -> std::string {
        volatile bool waiting = true;
        while (waiting) {
        }
        return "";
      },
      1 / double{2});
  EXPECT_EQ(end.failure, "no end within 1 s of processor time");
  EXPECT_GT(end.cpu_seconds, 1 / double{2});
}

/// The process of work that nobody waits for any more ends with it: the pipe has no writer left.
TEST(WorkApart, EndsWithItsOwner) {
  int end = -1;
  {
    const ChildProcess waits([]() -> std::string { return pause() == 0 ? "" : "woken"; }, 10);
    end = dup(waits.file());
  }
  char byte = 0;
  EXPECT_EQ(read(end, &byte, 1), 0);
  close(end);
}

}  // namespace
}  // namespace hbvm::core
