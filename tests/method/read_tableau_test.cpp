#include "method/read_tableau.hpp"

#include <gtest/gtest.h>

#include <random>

#include "folder.hpp"
#include "hbvm/error.hpp"
#include "method/order_conditions.hpp"
#include "scalar/literal.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

const std::string two_stages = R"(name = "Gauss, two stages"
order = 4
A = [["1/4", "1/4-sqrt(3)/6"],
     ["1/4+sqrt(3)/6", 0.25]]
b = [0.5, "1/2"]
c = ["1/2-sqrt(3)/6", "1/2+sqrt(3)/6"]
)";

class ReadTableau : public ::testing::Test {
 protected:
  const Folder folder;

  Tableau read(const std::string& text) const { return read_tableau(folder.write("method.toml", text)); }
  /// What the text is refused with, after the path.
  std::string refusal(const std::string& text) const {
    const std::string message = message_of([&] { read(text); }), path = folder / "method.toml";
    EXPECT_TRUE(message.starts_with(path + ":")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message.substr(std::min(message.size(), path.size() + 1));
  }
  static std::string changed(const std::string& from, const std::string& to) {
    std::string text = two_stages;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }
  void expect_refusal(const std::string& text, const std::string& line,
                      std::initializer_list<std::string> words) const {
    const std::string message = refusal(text);
    EXPECT_TRUE(message.starts_with(line + ": ")) << message;
    expect_words(message, words);
  }
};

TEST_F(ReadTableau, TakesAllKeys) {
  const Tableau tableau = read(two_stages);
  EXPECT_EQ(tableau.name, "Gauss, two stages");
  EXPECT_EQ(tableau.order, 4);
  EXPECT_EQ(tableau.b.size(), 2u);
  EXPECT_EQ(tableau.A[0][1].text(), "1/4-sqrt(3)/6");
  const PrecisionScope digits(60);
  const auto method = make_runge_kutta<Mpfr>(tableau);
  EXPECT_EQ(method.A(1, 0), literal<Mpfr>("1/4+sqrt(3)/6"));
  EXPECT_EQ(order(method, literal<Mpfr>("1e-58")), 4);
}

TEST_F(ReadTableau, NameOrderAndNodesMayBeAbsent) {
  const Tableau tableau = read("A = [[0, 0, 0], [\"1/3\", 0, 0.0], [-0.1, +0.3, 0]]\nb = [1, 0, 0]\n");
  EXPECT_EQ(tableau.name, "method");
  EXPECT_FALSE(tableau.order.has_value());
  ASSERT_EQ(tableau.c.size(), 3u);
  EXPECT_EQ(literal<double>(tableau.c[0].text()), 0);
  const PrecisionScope digits(60);
  const auto method = make_runge_kutta<Mpfr>(tableau);
  EXPECT_EQ(method.c[1], literal<Mpfr>("1/3"));
  EXPECT_EQ(method.c[2], literal<Mpfr>("0.2"));  // not of the binary fractions next to 0.1 and 0.3
}

TEST_F(ReadTableau, DecimalsAreReadToTheLastDigit) {
  const Tableau tableau = read("A = [[0.1234567890123456789012345678901234567890]]\nb = [1e0]\n");
  const PrecisionScope digits(60);
  EXPECT_EQ(make_runge_kutta<Mpfr>(tableau).A(0, 0), literal<Mpfr>("0.1234567890123456789012345678901234567890"));
}

TEST_F(ReadTableau, ValuesBeyondDoubleAreValues) {
  EXPECT_EQ(read("A = [[\"10^-400\"]]\nb = [1]\n").A[0][0].text(), "10^-400");
}

TEST_F(ReadTableau, RefusesKeys) {
  expect_refusal(changed("b = [0.5, \"1/2\"]\n", ""), "1", {"tableau", "'b' is missing"});
  expect_refusal("b = [1]\n", "1", {"'A' is missing"});
  expect_refusal("", "1", {"'A' is missing"});
  expect_refusal(changed("order", "ordre"), "2", {"unknown key 'ordre'", "did you mean 'order'"});
  expect_refusal(two_stages + "d = 1\n", "7", {"unknown key 'd'"});
  expect_refusal(two_stages + "b = [1, 2]\n", "7", {});
  expect_refusal(two_stages + "[more]\nx = 1\n", "7", {"unknown key 'more'"});
}

TEST_F(ReadTableau, RefusesNamesAndOrders) {
  expect_refusal(changed("\"Gauss, two stages\"", "5"), "1", {"'name'"});
  expect_refusal(changed("\"Gauss, two stages\"", "\"\""), "1", {"'name'"});
  for (const char* const wrong : {"0", "-3", "4.0", "\"4\"", "201", "9223372036854775807", "[4]"})
    expect_refusal(changed("order = 4", std::string("order = ") + wrong), "2", {"'order'"});
}

TEST_F(ReadTableau, RefusesShapes) {
  expect_refusal(changed("0.25]]", "0.25, 0]]"), "4", {"A[2] has 3 entries", "2 rows"});
  expect_refusal(changed("0.25]]", "0.25], [0, 0]]"), "3", {"A[1] has 2 entries", "3 rows"});
  expect_refusal(changed("[\"1/4\", \"1/4-sqrt(3)/6\"]", "1"), "3", {"A[1] must be an array"});
  expect_refusal(changed("[0.5, \"1/2\"]", "[1]"), "5", {"b has 1 entries", "2 rows"});
  expect_refusal(changed("[0.5, \"1/2\"]", "1"), "5", {"b must be an array"});
  expect_refusal(changed("c = [", "c = [0, "), "6", {"c has 3 entries"});
  expect_refusal("A = []\nb = []\n", "1", {"0 rows"});
  expect_refusal("A = 1\nb = [1]\n", "1", {"A must be an array"});
  expect_refusal("A = \"x\"\nb = [1]\n", "1", {"A must be an array"});
  expect_refusal("A = {x = 1}\nb = [1]\n", "1", {"A must be an array"});
  expect_refusal("b = [1]\n[[A]]\nx = 1\n", "2", {"A[1] must be an array"});
}

std::string square(int stages, const std::string& number) {
  std::string row = number;
  for (int i = 1; i < stages; ++i) row += ", " + number;
  std::string text = "b = [" + row + "]\nA = [[" + row + "]";
  for (int i = 1; i < stages; ++i) text += ",\n[" + row + "]";
  return text + "]\n";
}

TEST_F(ReadTableau, RefusesMoreStagesThanItTakes) {
  EXPECT_EQ(read(square(100, "\"1/3\"")).b.size(), 100u);
  expect_refusal(square(101, "0"), "2", {"101 rows", "100 stages"});
}

TEST_F(ReadTableau, RefusesEntries) {
  expect_refusal(changed("0.25]]", "\"1/0\"]]"), "4", {"A[2][2] has no value", "1/0"});
  expect_refusal(changed("0.25]]", "\"1/\"]]"), "4", {"A[2][2]"});
  expect_refusal(changed("0.25]]", "\"\"]]"), "4", {"A[2][2]"});
  expect_refusal(changed("0.25]]", "nan]]"), "4", {"A[2][2]", "finite"});
  expect_refusal(changed("0.25]]", "-inf]]"), "4", {"A[2][2]", "finite"});
  expect_refusal(changed("0.25]]", "true]]"), "4", {"A[2][2]", "number"});
  expect_refusal(changed("0.25]]", "[0.25]]]"), "4", {"A[2][2]", "number"});
  expect_refusal(changed("0.25]]", "1979-05-27]]"), "4", {"A[2][2]", "number"});
  expect_refusal(changed("0.25]]", "{a = 1}]]"), "4", {"A[2][2]", "number"});
  expect_refusal(changed("[0.5,", "[\"sqrt(-1)\","), "5", {"b[1] has no value"});
  expect_refusal(changed("[0.5,", "[\"x\","), "5", {"b[1] has no value", "x"});
  expect_refusal(changed("[0.5,", "[\"exp(exp(100))\","), "5", {"b[1] has no value"});
  expect_refusal(changed("\"1/2+sqrt(3)/6\"", "\"log(0)\""), "6", {"c[2] has no value"});
}

TEST_F(ReadTableau, AsksForNodesWhereRowsAreTooLongToBeSummed) {
  std::string entry = "\"1/2";
  for (int i = 0; i < 300; ++i) entry += "+1";
  entry += "\"";
  expect_refusal(square(4, entry), "2", {"A[1]", "state c"});
}

TEST_F(ReadTableau, RefusesWhatIsNoToml) {
  expect_refusal(changed("0.25]]", "0.25]"), "5", {});
  expect_refusal(changed("two stages\"", "two stages"), "1", {});
  expect_refusal(changed("0.25]]", "0x]]"), "4", {});
  expect_refusal(std::string("A = [[1]]\nb = [\0]\n", 18), "2", {});
  refusal("A = " + std::string(100'000, '['));
  refusal("\xFF\xFE");
}

TEST_F(ReadTableau, ReadsOrRefusesAnyChangedCharacters) {
  std::mt19937 random(1);
  const std::string characters = "\"'[]{}=#.,-+*/^()_0189eEnaxL\n\t\r \\\xEF\xBB\xBF\xC3\x01\x7F";
  const auto read_or_refuse = [&](const std::string& text) {
    try {
      make_runge_kutta<double>(read(text));
    } catch (const InputError&) {
    }
  };
  for (std::size_t length = 0; length < two_stages.size(); ++length) read_or_refuse(two_stages.substr(0, length));
  for (int trial = 0; trial < 1'000; ++trial) {
    std::string text = two_stages;
    for (unsigned changes = 1 + random() % 3; changes > 0; --changes)
      text[random() % text.size()] = characters[random() % characters.size()];
    read_or_refuse(text);
  }
}

TEST_F(ReadTableau, RefusesWhatIsNoFile) {
  EXPECT_THROW(read_tableau(folder / "none.toml"), InputError);
  EXPECT_THROW(read_tableau(folder.path().string()), InputError);
  EXPECT_THROW(read_tableau(""), InputError);
}

}  // namespace
}  // namespace hbvm::core
