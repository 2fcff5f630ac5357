#include "cli/program.hpp"

namespace hbvm::core {
namespace {

TEST(HelpCommand, SaysWhatTheOptionSays) {
  for (const Arguments& command : {Arguments{}, {"run"}, {"audit"}, {"scene"}, {"scene", "check"}})
    EXPECT_EQ(ended_with(0, Arguments{"help"} + command).out, hbvm(command + Arguments{"--help"}).out);
}

TEST(HelpCommand, RefusesWhatIsNoCommand) {
  expect_refused({"help", "runn"}, {"'runn'", "did you mean 'run'?"});
  expect_refused({"help", "scene", "draw"}, {"'draw'"});
}

}  // namespace
}  // namespace hbvm::core
