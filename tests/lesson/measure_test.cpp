#include "lesson/measure.hpp"

#include "words.hpp"

namespace hbvm::core {
namespace {

Measure measure_of(const std::string& text) {
  const TomlSource source(text, "lesson.toml");
  const toml::table table = source.parse();
  return read_measure(source, table, "measure");
}

TEST(Measures, AreOneRequestAndAPlaceInItsResult) {
  Measure run = measure_of(
      "values = { drift = '/e_g' }\nrun = { scene = 'kepler', method = 'tableau:a.toml', until = '4', error = true, "
      "set = { 'planet.mass' = '{m}' } }\n");
  EXPECT_EQ(run.kind, "run");
  EXPECT_EQ(run.methods, std::vector<std::string>{"tableau:a.toml"});
  EXPECT_TRUE(run.error && !run.reverse);
  run.files = {{"a.toml", "A = [[{a}]]"}};
  const Measure answered = filled(run, {{"m", "3"}, {"a", "1/{m}"}});
  EXPECT_EQ(answered.set, (NamedTexts{{"planet.mass", "3"}}));
  EXPECT_EQ(answered.files, (NamedTexts{{"a.toml", "A = [[1/{m}]]"}}));
  const Measure orders = measure_of(
      "values = { p = '/methods/0/orders/q/rate' }\nconvergence = { scene = 'kepler', methods = ['rk4', '{m}'], "
      "steps = '1/8:1/128', until = '1' }\n");
  EXPECT_EQ(filled(orders, {{"m", "euler"}}).methods, (std::vector<std::string>{"rk4", "euler"}));
  EXPECT_EQ(measure_of("values = { x = '/y' }\naudit = { tableau = 'A' }\n").tableau, "A");
  EXPECT_EQ(measure_of("values = { x = '/y' }\nreference = { scene = 'kepler', until = '1', digits = '9' }\n").digits,
            "9");
}

TEST(Measures, OfARunMayGoBack) {
  const std::string run = "values = { x = '/q/0' }\nrun = { scene = 'kepler', method = 'rk4', until = '4', ";
  EXPECT_TRUE(measure_of(run + "reverse = true }\n").reverse);
  EXPECT_FALSE(measure_of(run + "reverse = true }\n").back);
  EXPECT_TRUE(measure_of(run + "back = true }\n").back);
}

/// What is answered with a blank's own name in braces is put in once.
TEST(Measures, AreFilledInOnce) {
  Measure measure;
  measure.until = "{t}{t}";
  EXPECT_EQ(filled(measure, {{"t", "{t}1"}}).until, "{t}1{t}1");
}

TEST(Measures, RefuseWhatTheyDoNotKnow) {
  expect_words(message_of([] { measure_of("values = { x = '/y' }\n"); }), {"lesson.toml", "'x'", "run"});
  expect_words(message_of([] { measure_of("values = { x = '/y' }\nrun = 3\n"); }), {":2:", "run must be a table"});
  expect_words(message_of([] {
                 measure_of("values = { x = '/y' }\nrun = { scene = 'a', method = 'b', until = '1', steps = '2' }\n");
               }),
               {"'steps'"});
  expect_words(message_of([] {
                 measure_of("values = { x = '/y' }\nrun = { scene = 'a', method = 'b', until = '1', error = 1 }\n");
               }),
               {"error must be true or false"});
}

}  // namespace
}  // namespace hbvm::core
