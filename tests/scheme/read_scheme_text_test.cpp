#include <gtest/gtest.h>

#include "scheme/tables.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

SchemeText text_of(const std::string& text, const std::string& kind) {
  const Folder folder;
  return read_scheme_text(folder.write("mine." + kind, text));
}

TEST(SchemeTexts, AreTomlOrJson) {
  const SchemeText toml = text_of("name = 'Heun'\norder = 2\nA = [[0, 0.0], [1, 0]]\nb = ['1/2', 0.50]\n", "toml"),
                   json = text_of(R"({"name": "Heun", "order": 2, "A": [[0, "0.0"], [1, 0]], "b": ["1/2", "0.50"]})",
                                  "json");
  EXPECT_EQ(toml.arrays, json.arrays);
  EXPECT_EQ(toml.arrays.at("b").at(0).at(1), "0.50");
  EXPECT_EQ(toml.stated, json.stated);
  EXPECT_EQ(toml.name, "Heun");
  EXPECT_EQ(text_of("A = [[0]]\nb = [1]\n", "toml").name, "mine");
}

TEST(SchemeTexts, MayBePrintedTableaux) {
  const SchemeText::Rows A{{"0", "0", "0"}, {"1/2", "0", "0"}, {"-1", "2", "0"}}, c{{"0", "1/2", "1"}},
      b{{"1/6", "2/3", "1/6"}};
  for (const char* const text :
       {"0 | 0 0 0\n1/2 | 1/2 0 0\n1 | -1 2 0\n---+------\n | 1/6 2/3 1/6\n", "0\n1/2 1/2\n1 -1 2\n\n1/6 2/3 1/6\n",
        "# Kutta\n0,0,0,0\n1/2,1/2,0,0\n1,-1,2,0\n1,1/6,2/3,1/6\n"}) {
    const SchemeText read = text_of(text, "txt");
    EXPECT_EQ(read.arrays.at("A"), A) << text;
    EXPECT_EQ(read.arrays.at("b"), b) << text;
    EXPECT_EQ(read.arrays.at("c"), c) << text;
  }
  const SchemeText pair = text_of("0\n1 1\n1/2 1/2\n1 0\n", "csv");
  EXPECT_EQ(pair.arrays.at("b_hat"), (SchemeText::Rows{{"1", "0"}}));
  EXPECT_EQ(pair.arrays.at("A"), (SchemeText::Rows{{"0", "0"}, {"1", "0"}}));
}

TEST(SchemeTexts, SayWhatIsWrong) {
  const auto refusal = [](const std::string& text, const std::string& kind) {
    return message_of([&] { text_of(text, kind); });
  };
  expect_words(refusal("A = 3\n", "toml"), {"mine.toml", "A must be an array"});
  expect_words(refusal("order = 'four'\n", "toml"), {"'order'"});
  expect_words(refusal("{", "json"), {"mine.json"});
  expect_words(refusal("{\"A\": [[true]]}", "json"), {"mine.json", "true"});
  expect_words(refusal("{\"order\": 2.5}", "json"), {"'order' must be a whole number"});
  expect_words(refusal("[1]", "json"), {"a scheme is an object"});
  expect_words(refusal("1 2 3\n", "txt"), {"mine.txt", "row of weights"});
  expect_words(refusal("1 2 3 4 5\n1 2\n3\n", "txt"), {"mine.txt", "no tableau"});
  EXPECT_THROW(read_scheme_text("/nowhere.toml"), InputError);
  expect_words(refusal(std::string(10'000'001, '#'), "txt"), {"mine.txt", "too large"});
}

}  // namespace
}  // namespace hbvm::core
