#include "lesson/told_lesson.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

const std::string text = R"(title = "Drift"
summary = "What drifts."
minutes = 45
files."a.toml" = "A = [[{a}]]"
[question]
name = "guess"
asks = "What grows?"
says = "The rod."
holds = ["1 < choice"]
solution = { choice = "2" }
wrong = { choice = "1" }
blanks.choice = { asks = "Which?", choices = ["1", "2"] }
[[experiment]]
name = "run"
asks = "See."
command = "hbvm run simple_pendulum --step {step} --until 4"
draw = "page"
choices.step = ["1/4", "1/8"]
[[exercise]]
name = "order"
asks = "Its order?"
hint = "Halve the step."
solution = { p = "4" }
wrong = { p = "2" }
holds = ["rate - 1/5 < p", "p < rate + 1/5"]
blanks.p = { asks = "a number", like = "3" }
[[exercise.measure]]
convergence = { scene = "kepler", methods = ["rk4"], steps = "1/8:1/128", until = "1" }
values = { rate = "/methods/0/orders/q/rate" }
)";

std::string with(const std::string& what, const std::string& instead) {
  std::string changed = text;
  return changed.replace(changed.find(what), what.size(), instead);
}

TEST(ToldLessons, AreReadWithTheirJudges) {
  const ToldLesson told = read_lesson(text, "07_drift");
  EXPECT_EQ(told.lesson.number, 7);
  EXPECT_EQ(told.lesson.name, "07_drift");
  EXPECT_EQ(told.lesson.minutes, 45);
  EXPECT_EQ(told.lesson.question.blanks.at(0).choices, (std::vector<std::string>{"1", "2"}));
  EXPECT_EQ(told.lesson.question.hint, "The rod.");
  EXPECT_EQ(told.of_question.holds.size(), 1u);
  EXPECT_EQ(told.lesson.experiments.at(0).choices.at(0).second, (std::vector<std::string>{"1/4", "1/8"}));
  EXPECT_EQ(told.lesson.exercises.at(0).blanks.at(0).like, "3");
  EXPECT_EQ(told.of_exercises.at(0).measures.at(0).kind, "convergence");
  EXPECT_EQ(told.of_exercises.at(0).holds.size(), 2u);
  const ToldLesson of_file = read_lesson(with("\"kepler\"", "\"a.toml\""), "07_drift");
  EXPECT_EQ(of_file.of_exercises.at(0).measures.at(0).scene, "A = [[{a}]]");
  EXPECT_EQ(of_file.of_exercises.at(0).measures.at(0).files, of_file.lesson.files);
}

TEST(ToldLessons, SayTheLineOfWhatIsWrong) {
  const auto refusal = [](const std::string& changed) { return message_of([&] { read_lesson(changed, "07_drift"); }); };
  expect_words(refusal(with("p < rate + 1/5", "p = rate")), {"07_drift", "'order'", "'p = rate'"});
  expect_words(refusal(with("solution = { p", "solution = { q")), {"'order'", "solution answers 'q'"});
  expect_words(refusal(with("draw = \"page\"", "draw = \"film\"")),
               {"07_drift:13:", "draw must be page, text or chart"});
  expect_words(refusal(with("hint", "hints")), {"'order'", "hint"});
  expect_words(refusal(with("blanks.p = {", "blanks.p = 3 #")), {"'order'", "blanks must be tables"});
  expect_words(refusal(with("choices.step = [\"1/4\", \"1/8\"]", "choices.step = []")), {"'run'", "step must be"});
  expect_words(refusal("title = 3"), {"07_drift:1:", "'title'"});
}

TEST(Answers, AreTextsOrNumbersByExercise) {
  const Lesson lesson = read_lesson(text, "07_drift").lesson;
  const auto answers = read_answers(lesson, "[order]\np = 4.0\n[guess]\nchoice = 'g'\n", "mine.toml");
  EXPECT_EQ(answers, (std::map<std::string, Answers>{{"order", {{"p", "4.0"}}}, {"guess", {{"choice", "g"}}}}));
  EXPECT_TRUE(read_answers(lesson, "", "mine.toml").empty());
  EXPECT_TRUE(read_answers(lesson, "[order]\np = ''\n", "mine.toml").empty());
  const auto refusal = [&](const std::string& answer) {
    return message_of([&] { read_answers(lesson, answer, "mine.toml"); });
  };
  expect_words(refusal("[ordre]\np = 4\n"), {"mine.toml:1:", "'ordre'", "order"});
  expect_words(refusal("[order]\nq = 4\n"), {"mine.toml:2:", "'q'", "p"});
  expect_words(refusal("order = 4\n"), {"order must be a table"});
  expect_words(refusal("[order]\np = [4]\n"), {"p"});
  expect_words(refusal("[order\n"), {"mine.toml:1:"});
}

/// The lessons that are compiled in are read, by number.
TEST(ToldLessons, AreTen) {
  ASSERT_EQ(lesson_texts().size(), 10u);
  int number = 0;
  for (const auto& [name, toml] : lesson_texts()) {
    const ToldLesson told = read_lesson(toml, name);
    EXPECT_EQ(told.lesson.number, ++number);
    EXPECT_EQ(told.lesson.exercises.size(), 2u) << name;
    EXPECT_FALSE(told.lesson.experiments.empty()) << name;
    EXPECT_EQ(told.lesson.question.blanks.size(), 1u) << name;
  }
}

}  // namespace
}  // namespace hbvm::core
