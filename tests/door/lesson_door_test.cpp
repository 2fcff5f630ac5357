#include <nlohmann/json.hpp>

#include "hbvm/lesson.hpp"
#include "words.hpp"

namespace hbvm {
namespace {

std::string table_of(const Exercise& exercise, const Answers& answers) {
  std::string text = "[" + exercise.name + "]\n";
  for (const auto& [blank, answer] : answers) text += blank + " = " + nlohmann::json(answer).dump() + "\n";
  return text;
}

/// Each question and exercise takes its solution, and refuses the answer that is said to be wrong.
TEST(DoorLessons, JudgeWhatTheyAsk) {
  for (const Lesson& lesson : lessons()) {
    std::vector<Exercise> all = lesson.exercises;
    all.push_back(lesson.question);
    for (const bool right : {true, false}) {
      std::string text;
      for (const Exercise& exercise : all) text += table_of(exercise, right ? exercise.solution : exercise.wrong);
      const LessonCheck check = check_lesson(lesson.name, text);
      ASSERT_EQ(check.exercises.size(), all.size());
      for (const Judgement& judgement : check.exercises) {
        EXPECT_TRUE(judgement.answered) << lesson.name << " " << judgement.exercise;
        EXPECT_EQ(judgement.right, right) << lesson.name << " " << judgement.exercise << ": " << judgement.says;
        EXPECT_EQ(judgement.says.empty(), right) << lesson.name << " " << judgement.exercise;
        EXPECT_EQ(judgement.says.find("cannot judge"), std::string::npos) << lesson.name << ": " << judgement.says;
      }
      EXPECT_EQ(check.all_right(), right);
    }
  }
}

TEST(DoorLessons, SayWhatIsMissing) {
  const Lesson first = lesson("1");
  const LessonCheck nothing = check_lesson("01", answers_template(first));
  EXPECT_FALSE(nothing.all_right());
  ASSERT_EQ(nothing.exercises.size(), 2u);
  for (const Judgement& judgement : nothing.exercises) {
    EXPECT_FALSE(judgement.answered || judgement.right);
    core::expect_words(judgement.says, {"is not answered"});
  }
  core::expect_words(to_text(nothing), {first.exercises[0].name + ": '"});
}

TEST(DoorLessons, TellWhyAnAnswerCannotBeJudged) {
  const auto says = [](const std::string& answers) { return check_lesson("1", answers).exercises; };
  const std::vector<Judgement> broken = says("[baumgarte]\nA = '100'\n[hidden]\nfactor = 'four'\n");
  core::expect_words(broken.at(0).says, {"the engine cannot judge this answer", "t = "});
  core::expect_words(broken.at(1).says, {"the engine cannot judge this answer", "unknown name 'four'"});
  const std::vector<Judgement> choice = says("[prediction]\nfactor = '3'\n");
  core::expect_words(choice.at(0).says, {"'factor' is '3'", "1, 2, 4, 16"});
}

TEST(DoorLessons, AreFoundByNumberAndName) {
  EXPECT_EQ(lesson("1").name, lesson("01").name);
  EXPECT_EQ(lesson(lesson("1").name).number, 1);
  core::expect_words(core::message_of([] { lesson("11"); }), {"no lesson '11'"});
  EXPECT_THROW(lesson(""), InputError);
  EXPECT_THROW(lesson("0"), InputError);
  EXPECT_THROW(check_lesson("1", "[other]\nx = 1\n"), InputError);
}

TEST(DoorLessons, AreTold) {
  const Lesson first = lesson("1");
  core::expect_words(to_text(lessons()), {first.title, first.summary});
  core::expect_words(to_text(first), {first.question.asks, "hbvm run simple_pendulum", "rk4+baumgarte", "such as"});
  core::expect_words(answers_template(first), {"hbvm lesson check 1 answers.toml", "[hidden]\nfactor = \"\""});
  const auto list = nlohmann::json::parse(to_json(lessons()));
  EXPECT_EQ(list.at(0).at("title"), first.title);
  EXPECT_EQ(list.at(0).at("exercises").at(1).at("solution").at("factor"), "4");
  const auto check = nlohmann::json::parse(to_json(check_lesson("1", "[hidden]\nfactor = 4\n")));
  EXPECT_EQ(check.at("lesson"), 1);
  EXPECT_EQ(check.at("exercises").at(0).at("answered"), false);
  EXPECT_EQ(check.at("exercises").at(1).at("right"), true);
}

TEST(DoorLessons, EndWhenTheyAreAskedTo) {
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(check_lesson("1", "[hidden]\nfactor = 4\n", "answers.toml", source.get_token()), Interrupted);
}

}  // namespace
}  // namespace hbvm
