#include <cstdio>

#include "cli/program.hpp"

namespace hbvm::core {
namespace {

/// What bash offers after these words, of which the last has been begun.
std::vector<std::string> offered(const std::vector<std::string>& words) {
  const Folder folder;
  std::string line;
  for (const std::string& word : words) line += " '" + word + "'";
  const std::string script = folder.write("completion.bash", hbvm({"completion"}).out);
  const std::string out = folder / "offered";
  const std::string command =
      "bash -c 'source \"$0\"; COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); _hbvm; printf \"%s\\n\" "
      "\"${COMPREPLY[@]}\"' " +
      script + line + " > " + out;
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  return lines_of(text_of(out));
}

using Words = std::vector<std::string>;

TEST(Completion, OffersCommandsOptionsAndScenes) {
  EXPECT_EQ(offered({"hbvm", "stab"}), Words{"stability"});
  EXPECT_EQ(offered({"hbvm", "scene", "pro"}), Words{"project"});
  EXPECT_EQ(offered({"hbvm", "run", "modi"}), Words{"modified_pendulum"});
  EXPECT_EQ(offered({"hbvm", "run", "kepler", "--meth"}), Words{"--method"});
  EXPECT_EQ(offered({"hbvm", "scene", "show", "four_bar_"}), (Words{"four_bar_linkage", "four_bar_linkage_of_bars"}));
  EXPECT_EQ(offered({"hbvm", "scene", "show", "four_bar_linkage", "--pl"}), Words{"--plot"});
  EXPECT_EQ(offered({"hbvm", "--vers"}), Words{"--version"});
}

/// Then bash offers files.
TEST(Completion, OffersNothingOfItsOwnForAFile) {
  EXPECT_EQ(offered({"hbvm", "run", "./mine"}), Words{""});
  expect_words(hbvm({"completion"}).out, {"complete -o default -F _hbvm hbvm\n"});
}

}  // namespace
}  // namespace hbvm::core
