#include "scheme/scheme.hpp"

#include "scheme/tables.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(Schemes, NameTheirEntries) {
  const SchemePtr scheme = scheme_of("A = [[0, 0], ['?', 0]]\nb = ['1/2', '1/2']\n");
  ASSERT_EQ(scheme->entries().size(), 6u);
  EXPECT_EQ(scheme->entries()[2].name, "A[2][1]");
  EXPECT_FALSE(scheme->entries()[2].written.has_value());
  EXPECT_EQ(scheme->entries()[5].name, "b[2]");
  EXPECT_EQ(scheme->written_values<double>(), (std::vector<double>{0, 0, 0, 0, 0.5, 0.5}));
}

TEST(Schemes, RefuseShapesAndNumbers) {
  const auto refusal = [](const std::string& text) { return message_of([&] { scheme_of(text); }); };
  expect_words(refusal("A = [[0, 0]]\nb = [1, 0]\n"), {"scheme.toml", "A has 1 rows and not 2"});
  expect_words(refusal("A = [[0], [0, 0]]\nb = [1, 0]\n"), {"A has 1 numbers in a row and not 2"});
  expect_words(refusal("A = [[0, 'x'], [0, 0]]\nb = [1, 0]\n"), {"A[1][2]", "'x'"});
  expect_words(refusal("A = [[0, '1/0'], [0, 0]]\nb = [1, 0]\n"), {"A[1][2]"});
  expect_words(refusal("A = [[0]]\nb = []\n"), {"'b' is missing"});
  expect_words(refusal("A = [[0]]\nb = [1]\norder = 3\n"), {"'order' is 3", "to 2"});
}

}  // namespace
}  // namespace hbvm::core
