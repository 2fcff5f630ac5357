#include "toml/toml_table.hpp"

#include "printing.hpp"
#include "scalar/literal.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// A text and the table that it is.
class Read {
 public:
  explicit Read(const std::string& text)
      : source_(text, "file.toml"), parsed_(source_.parse()), table(source_, parsed_, "table 't'") {}

 private:
  TomlSource source_;
  toml::table parsed_;

 public:
  TomlTable table;
};

TEST(TomlTables, GiveNumbersAsTheyStand) {
  Read read("\"\xC3\xA4\" = 1\na = 0.1000000000000000000000000000000001\nb = -1_000.5e-3\nc = \"sqrt(2)/2\"\nd = 7\n");
  EXPECT_EQ(read.table.number("a").text(), "0.1000000000000000000000000000000001");
  EXPECT_EQ(evaluate<Quad>(read.table.number("b"), {}), Quad(-10005) / 10000);
  EXPECT_EQ(read.table.number("c").text(), "sqrt(2)/2");
  EXPECT_EQ(read.table.number("d").text(), "7");
  EXPECT_EQ(read.table.integer("d"), 7);
  EXPECT_FALSE(read.table.optional_number("e"));
  EXPECT_EQ(read.table.optional_number("d")->text(), "7");
}

TEST(TomlTables, TellWhereAStringBegins) {
  const TomlSource source("a = 1\nb = \"x + y\"\nc = '''\nx +\n y'''\nd = \"\\u0078 + 1\"\ne = \"\"\n", "file.toml");
  const toml::table top = source.parse();
  const auto begin = [&](const char* key) {
    const toml::node& node = *top.get(key);
    const auto at = source.begin_of(*node.value_exact<std::string>(), node.source());
    return std::to_string(at.line) + ":" + std::to_string(at.column);
  };
  EXPECT_EQ(begin("b"), "2:6");
  EXPECT_EQ(begin("c"), "4:1");
  EXPECT_EQ(begin("d"), "6:0") << "it is not there as it is";
  EXPECT_EQ(begin("e"), "7:6");
}

/// Columns count characters, the text bytes.
TEST(TomlTables, GiveNumbersBehindCharactersOfSeveralBytes) {
  Read read("a = { \"\xC3\xA4\xE2\x82\xAC\" = \"\xF0\x9F\x98\x80\", x = 12.75 }\n");
  TomlSource source("a = { \"\xC3\xA4\xE2\x82\xAC\" = \"\xF0\x9F\x98\x80\", x = 12.75 }\n", "file.toml");
  const toml::table top = source.parse();
  TomlTable inner(source, *top["a"].as_table(), "a");
  EXPECT_EQ(inner.number("x").text(), "12.75");
  EXPECT_TRUE(read.table.has("a"));
}

TEST(TomlTables, GiveVectorsAndMatrices) {
  Read read("v = [1, \"2/3\", 0.5]\nM = [[1, 2], [3, 4]]\nnames = [\"a\", \"b\"]\n[[t]]\nx = 1\n[[t]]\nx = 2\n");
  const auto v = read.table.vector("v", 3);
  EXPECT_EQ(v[1].text(), "2/3");
  EXPECT_EQ(v[2].text(), "0.5");
  const auto M = read.table.matrix("M", 2);
  EXPECT_EQ(M[0][1].text(), "2");
  EXPECT_EQ(M[1][0].text(), "3");
  EXPECT_EQ(read.table.strings("names"), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(read.table.tables("t").size(), 2u);
  EXPECT_TRUE(read.table.tables("none").empty());
  EXPECT_TRUE(read.table.is_array("v"));
  EXPECT_FALSE(read.table.is_array("none"));
  EXPECT_NO_THROW(read.table.finish());
}

TEST(TomlTables, RefuseWithFileLineAndKey) {
  Read read("a = 1\nb = \"\"\nv = [1, 2]\nM = [[1, 2], [3]]\nn = [1]\nbad = \"1+\"\nt = { x = 1 }\ny = inf\n");
  const auto expect = [](const std::string& message, const char* place, const char* part) {
    EXPECT_TRUE(message.starts_with(std::string("file.toml:") + place + ": table 't': ")) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  TomlTable& t = read.table;
  expect(message_of([&] { t.string("a"); }), "1", "'a' must be a string");
  expect(message_of([&] { t.string("b"); }), "2", "'b' must not be empty");
  expect(message_of([&] { t.integer("b"); }), "2", "'b' must be a whole number");
  expect(message_of([&] { t.vector("v", 3); }), "3", "'v' has 2 entries instead of 3");
  expect(message_of([&] { t.vector("a", 3); }), "1", "'a' must be an array of 3 numbers");
  expect(message_of([&] { t.matrix("M", 2); }), "4", "row 2 of 'M' has 1 entries instead of 2");
  expect(message_of([&] { t.strings("n"); }), "5", "each entry of 'n'");
  expect(message_of([&] { t.number("bad"); }), "6", "'bad'");
  expect(message_of([&] { t.number("v"); }), "3", "must be a number");
  expect(message_of([&] { t.tables("t"); }), "7", "[[t]]");
  expect(message_of([&] { t.number("y"); }), "8", "'y' must be finite");
  expect(message_of([&] { t.number("absent"); }), "1", "the key 'absent' is missing");
  expect(message_of([&] {
           t.missing({"one", "two", "three"});
         }),
         "1", "the key 'one' is missing (or 'two' or 'three')");
}

TEST(TomlTables, GuessWhatAMisspeltKeyWasMeantToBe) {
  Read misspelt("\nstifness = 1\n");
  EXPECT_EQ(message_of([&] { misspelt.table.number("stiffness"); }),
            "file.toml:2: table 't': unknown key 'stifness': did you mean 'stiffness'?");
  Read more("a = 1\nlenght = 2\nzzz = 3\n");
  more.table.take("a");
  more.table.take("zzz");
  EXPECT_NE(message_of([&] { more.table.expect({"length"}); }).find("did you mean 'length'?"), std::string::npos);
  Read odd("qwertz = 1\n");
  EXPECT_EQ(message_of([&] { odd.table.finish(); }), "file.toml:1: table 't': unknown key 'qwertz'");
}

TEST(TomlSources, AreTextOfOneMarkAtMost) {
  const std::string mark = "\xEF\xBB\xBF";
  EXPECT_EQ(TomlSource(mark + "a = 1\n", "f").parse()["a"].value<int>(), 1);
  EXPECT_EQ(message_of([&] { TomlSource("a = 1\nb = '" + mark + "'\n", "f").parse(); }),
            "f:2: a byte order mark (U+FEFF) stands inside the file");
  EXPECT_TRUE(message_of([] { TomlSource("a = 1\nb = \n", "f").parse(); }).starts_with("f:2: "));
  EXPECT_EQ(message_of([] { TomlSource("", "f").fail(0, "two\nlines"); }), "f: two lines");
}

}  // namespace
}  // namespace hbvm::core
