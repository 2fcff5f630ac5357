#include "reference/literals.hpp"

#include <gtest/gtest.h>

#include "hbvm/error.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

Reference two_states() {
  Reference r;
  r.scene = "scene";
  r.title = "A scene";
  r.digits = 20;
  r.q_names = {"a.x"};
  r.p_names = {"a.px"};
  r.observed_names = {"an angle, say"};
  ReferenceState state;
  state.t = "0.5";
  state.q = {"0.12345678901234567890"};
  state.p = {"-1.0e-5"};
  state.lambda = {"3"};
  state.H = "2.5";
  state.observed = {"7"};
  r.times = {state, state};
  r.times[1].t = "1";
  return r;
}

/// Every digit as it is, a line a time.
TEST(Literals, AreCsv) {
  EXPECT_EQ(to_literals(two_states(), Language::csv),
            "t,a.x,a.px,lambda_1,H,\"an angle, say\"\n"
            "0.5,0.12345678901234567890,-1.0e-5,3,2.5,7\n"
            "1,0.12345678901234567890,-1.0e-5,3,2.5,7\n");
}

TEST(Literals, AreReadFromTextsWhereNumbersHaveAnyDigits) {
  expect_words(to_literals(two_states(), Language::julia),
               {"setprecision(BigFloat, 84)", "BigFloat(\"0.12345678901234567890\")", "BigFloat(\"-1.0e-5\")"});
  expect_words(to_literals(two_states(), Language::python),
               {"mp.dps = 25", "mpf(\"0.12345678901234567890\")", "names = [\"a.x\", \"a.px\", \"lambda_1\", \"H\""});
}

/// A whole number gets a point: else it would be an integer with a kind, or with a suffix that no integer has.
TEST(Literals, HaveTheTypeOfTheirLanguage) {
  expect_words(to_literals(two_states(), Language::fortran),
               {"real(16), parameter :: times(2)", "0.12345678901234567890_16", "-1.0e-5_16", "3.0_16",
                "; name = \"an angle, say\""});
  expect_words(to_literals(two_states(), Language::c),
               {"reference_states[2][5]", "HBVM_NUMBER(0.12345678901234567890)", "HBVM_NUMBER(3.0)"});
}

/// A time that was asked for as an expression is a decimal elsewhere. Quotes in a name are written as each language
/// does.
TEST(Literals, HoldDecimalsAndQuotedNamesOnly) {
  Reference r = two_states();
  r.times[1].t = "2*pi";
  r.observed_names = {"an \"angle\""};
  for (const Language language : {Language::csv, Language::julia, Language::python, Language::fortran, Language::c}) {
    const std::string text = to_literals(r, language);
    expect_words(text, {"6.283185307179586476925"});
    EXPECT_EQ(text.find("2*pi"), std::string::npos);
    const bool twice = language == Language::csv || language == Language::fortran;
    expect_words(text, {twice ? "an \"\"angle\"\"" : "an \\\"angle\\\""});
  }
}

TEST(Literals, AreNamedByLanguageAndByFile) {
  EXPECT_EQ(parse_language("julia"), Language::julia);
  EXPECT_THROW(parse_language("cobol"), InputError);
  EXPECT_EQ(language_of_file("folder.x/y.f90"), Language::fortran);
  EXPECT_FALSE(language_of_file("reference.toml").has_value());
}

}  // namespace
}  // namespace hbvm::core
