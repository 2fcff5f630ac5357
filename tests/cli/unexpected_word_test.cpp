#include "cli/program.hpp"

namespace hbvm::core {
namespace {

TEST(Words, AMisspeltCommandNamesTheOneThatWasMeant) {
  expect_refused({"runn", "kepler"}, {"unknown command 'runn'", "did you mean 'run'?"});
  expect_refused({"scene", "chekc", "kepler"}, {"'chekc'", "did you mean 'check'?"});
  expect_refused({"zzzzzzzzzzz"}, {"unknown command 'zzzzzzzzzzz' (see hbvm --help)"});
  expect_refused({"--versoin"}, {"'--versoin'", "did you mean '--version'?"});
}

/// Its value is left over, too, and --method is missing: what was misspelt is said all the same.
TEST(Words, AMisspeltOptionNamesTheOneThatWasMeant) {
  const Arguments run{"run", "kepler", "--step", "1/4", "--until", "1"};
  expect_refused(run + Arguments{"--methd", "hbvm:4,2"},
                 {"unknown option '--methd': did you mean '--method'? (see hbvm run --help)"});
  expect_refused(run + Arguments{"--methd=hbvm:4,2"}, {"'--methd': did you mean '--method'?"});
  expect_refused(run + Arguments{"--method", "hbvm:4,2", "--qqqqqqqqqqqq"},
                 {"unknown option '--qqqqqqqqqqqq' (see hbvm run --help)"});
  expect_refused({"scene", "check", "kepler", "--precison", "quad"}, {"'--precision'", "hbvm scene check --help"});
}

TEST(Words, OneWordTooManyIsNamed) {
  expect_refused({"scene", "check", "kepler", "more"}, {"unexpected 'more' (see hbvm scene check --help)"});
}

TEST(Words, WhatIsMissingIsStillSaid) { expect_refused({"run", "kepler", "--step", "1/4"}, {"--until", "required"}); }

}  // namespace
}  // namespace hbvm::core
