#include "report/csvw.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "folder.hpp"
#include "hbvm/error.hpp"
#include "read_file.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(Csvw, DescribesAFileAndItsColumns) {
  EXPECT_EQ(csvw_file("a/b.csv"), "a/b.csv-metadata.json");
  EXPECT_EQ(to_csvw({"A title",
                     "body = []\n",
                     {{"version", "1.2"}, {"command", "hbvm run"}},
                     {{"t", CsvType::binary64, "time"}, {"k", CsvType::integer, ""}, {"word", CsvType::text, ""}}},
                    "folder/my file.csv"),
            nlohmann::ordered_json::parse(R"({"@context": "http://www.w3.org/ns/csvw", "url": "my%20file.csv",
                "dc:title": "A title", "hbvm:version": "1.2", "hbvm:command": "hbvm run", "dc:source": "body = []\n",
                "tableSchema": {"columns": [
                    {"name": "t", "titles": "t", "datatype": "double", "dc:description": "time"},
                    {"name": "k", "titles": "k", "datatype": "integer"},
                    {"name": "word", "titles": "word", "datatype": "string"}]}})")
                    .dump(2) +
                "\n");
}

/// What double cannot hold is text of the form of a number, which a reader does not round.
TEST(Csvw, KeepsManyDigits) {
  const std::string text = to_csvw({"", "", {}, {{"t", CsvType::decimal, ""}}}, "t.csv");
  expect_words(text, {"\"base\": \"string\"", R"("format": "-?[0-9]+(\\.[0-9]+)?(e[-+]?[0-9]+)?")"});
  EXPECT_EQ(text.find("dc:"), std::string::npos) << text;
}

TEST(Csvw, StandsBesideATable) {
  const Folder folder;
  const std::string file = folder / "csvw_test.csv";
  write_csv(file,
            {"A caption", {"hbvm 1.2.3", "command hbvm audit"}, {"k"}, {"i", "e_y"}, {{"", {"3"}, {{"0", "1e-1"}}}}});
  EXPECT_EQ(read_file(file), "k,i,e_y\n3,0,1e-1\n");
  expect_words(read_file(csvw_file(file)),
               {"\"url\": \"csvw_test.csv\"", "\"dc:title\": \"A caption\"", "\"hbvm:provenance1\": \"hbvm 1.2.3\"",
                "\"hbvm:provenance2\": \"command hbvm audit\"", "\"titles\": \"e_y\""});
  EXPECT_THROW(write_csv("/nonexistent/a.csv", {}), InputError);
}

/// A name is a variable of URI templates; the titles are what the file has.
TEST(Csvw, EncodesNames) {
  for (const auto& [name, encoded] :
       {std::pair("upper.px", "upper.px"), std::pair("my bob.x", "my%20bob.x"), std::pair("a,b.x", "a%2Cb.x"),
        std::pair("_a..b.", "%5Fa%2E.b%2E"), std::pair("ä.x", "%C3%A4.x"), std::pair(".x", "%2Ex")})
    expect_words(to_csvw({"", "", {}, {{name, CsvType::text, ""}}}, "t.csv"),
                 {"\"name\": \"" + std::string(encoded) + "\"", "\"titles\": \"" + std::string(name) + "\""});
}

}  // namespace
}  // namespace hbvm::core
