#include "reference/proof_file.hpp"

#include "printing.hpp"
#include "reference/kept_proof.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(ProofFile, IsReadBackAsItWas) {
  const std::string text = to_text(proof_of("double_pendulum"));
  const ProofFile back = read_proof(text, "x.proof");
  EXPECT_EQ(to_text(back), text);
  EXPECT_GT(back.proof.steps.size(), 2u);
  EXPECT_EQ(back.claim.reference.proved, 12);
  EXPECT_EQ(back.proof.steps[0].series.q().size(), 4u);
  EXPECT_EQ(back.proof.steps[0].series.lambda().size(), 2u);
}

/// No byte of it can be another.
TEST(ProofFile, IsRefusedIfAByteWasChanged) {
  const std::string text = to_text(proof_of("simple_pendulum"));
  for (std::size_t at = 0; at < text.size(); at += text.size() / 97 + 1) {
    std::string changed = text;
    changed[at] = changed[at] == '1' ? '2' : '1';
    EXPECT_THROW(read_proof(changed, "x.proof"), InputError) << at;
  }
  EXPECT_THROW(read_proof(text.substr(0, text.size() / 2), "x.proof"), InputError);
  EXPECT_THROW(read_proof("", "x.proof"), InputError);
  EXPECT_THROW(read_proof("format = \"hbvm proof, format 1\"\n", "x.proof"), InputError);
}

/// What has a checksum, and is no proof, is refused with its step.
TEST(ProofFile, SaysWhatIsWrong) {
  const std::string text = to_text(proof_of("simple_pendulum"));
  const auto expect = [&](const std::string& from, const std::string& to, std::initializer_list<std::string> words) {
    try {
      read_proof(with_checksum(replaced(text, from, to)), "x.proof");
      ADD_FAILURE() << to;
    } catch (const InputError& error) {
      expect_words(error.what(), words);
    }
  };
  expect("unit = \"", "unit = \"-", {"step 1", "'unit' and 'end' are positive"});
  expect("end = \"", "end = \"x", {"step 1", "no number of a proof"});
  expect("\norder = ", "\norder = -", {"'order'"});
  expect("\norder = ", "\norder = 1 #", {"more coefficients"});
  expect("\nends = [", "\nends = [] #", {"as many"});
  expect("digits = ", "digits = -", {"'digits'"});
  expect("\ntube = [", "\ntube = [\"1p0\", ", {"'tube' is not a length and a rate"});
}

}  // namespace
}  // namespace hbvm::core
