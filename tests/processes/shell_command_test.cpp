#include "processes/shell_command.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <csignal>

#include "folder.hpp"
#include "hbvm/error.hpp"
#include "interruption.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

std::string message_of(const std::string& command, double seconds) {
  const Folder folder;
  try {
    run_shell_command(command, seconds, folder / "printed");
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(ShellCommand, TellsHowItEnded) {
  EXPECT_EQ(message_of("exit 0", 0), "");
  expect_words(message_of("echo one; echo two >&2; exit 3", 0), {"'echo one", "ended with code 3", "one\ntwo"});
  expect_words(message_of("kill -9 $$", 0), {"ended by SIGKILL"});
  // Nothing can be read.
  EXPECT_EQ(message_of("test -z \"$(cat)\"", 0), "");
}

TEST(ShellCommand, EndsWithAllThatItStarted) {
  const Folder folder;
  const std::string late = folder / "late";
  expect_words(message_of("(sleep 1; touch " + shell_quoted(late) + ") & sleep 60", 0.2), {"took more than 0 seconds"});
  EXPECT_EQ(message_of("sleep 2; test ! -e " + shell_quoted(late), 0), "");
}

TEST(ShellCommand, EndsWhenAsked) {
  std::atomic<int> signal{SIGINT};
  const StopRequest request{.signal = &signal};
  const StopScope scope(&request);
  const Folder folder;
  EXPECT_THROW(run_shell_command("sleep 60", 0, folder / "printed"), Interrupted);
}

TEST(ShellCommand, QuotesAnArgument) {
  EXPECT_EQ(message_of("test " + shell_quoted("it's $HOME \\ \"x\"") + " = \"it's \\$HOME \\\\ \\\"x\\\"\"", 0), "");
}

}  // namespace
}  // namespace hbvm::core
