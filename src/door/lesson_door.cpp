#include <fmt/format.h>

#include <algorithm>

#include "door/door.hpp"
#include "door/measured_values.hpp"
#include "hbvm/error.hpp"
#include "lesson/told_lesson.hpp"
#include "long_work/json.hpp"
#include "nearest.hpp"

namespace hbvm {
namespace {

const std::vector<core::ToldLesson>& told_lessons() {
  static const std::vector<core::ToldLesson> told = [] {
    std::vector<core::ToldLesson> lessons;
    for (const auto& [name, text] : core::lesson_texts()) lessons.push_back(core::read_lesson(text, name));
    return lessons;
  }();
  return told;
}

/// \throws InputError with the lessons there are
const core::ToldLesson& told_lesson(const std::string& wanted) {
  std::vector<std::string> names;
  const std::string number = wanted.substr(std::min(wanted.find_first_not_of('0'), wanted.size()));
  for (const core::ToldLesson& told : told_lessons()) {
    if (told.lesson.name == wanted || std::to_string(told.lesson.number) == number) return told;
    names.push_back(told.lesson.name);
  }
  throw InputError("there is no lesson '" + wanted + "'" + core::did_you_mean_or_list(wanted, names));
}

/// What keeps an answer from being judged; empty if it can be.
std::string flaw(const Exercise& exercise, const Answers& answers) {
  for (const Blank& blank : exercise.blanks) {
    const auto answer = answers.find(blank.name);
    if (answer == answers.end()) return "'" + blank.name + "' is not answered: " + blank.asks;
    const auto& choices = blank.choices;
    if (!choices.empty() && std::find(choices.begin(), choices.end(), answer->second) == choices.end())
      return "'" + blank.name + "' is '" + answer->second +
             "'; choose one of: " + fmt::format("{}", fmt::join(choices, ", "));
  }
  return {};
}

/// Numbers among the answers, and what is measured with them. \throws InputError, IntegrationError, Interrupted
core::Constants numbers(const core::Judge& judge, const Answers& answers, const std::stop_token& stop) {
  core::Constants numbers;
  for (const auto& [blank, answer] : answers) {
    try {
      numbers.insert_or_assign(blank, core::Expression::parse(answer));
    } catch (const core::ExpressionError&) {
      // A word; if it should be a number, the inequality that has its name says so.
    }
  }
  for (const core::Measure& measure : judge.measures)
    for (const auto& [name, value] : core::measured_values(core::filled(measure, answers), stop))
      numbers.insert_or_assign(name, core::Expression::parse(value));
  return numbers;
}

Judgement judged(const Exercise& exercise, const core::Judge& judge, const Answers& answers,
                 const std::stop_token& stop) {
  Judgement result{exercise.name, false, false, flaw(exercise, answers)};
  if (!result.says.empty()) return result;
  result.answered = true;
  try {
    const core::Constants known = numbers(judge, answers, stop);
    result.right = std::all_of(judge.holds.begin(), judge.holds.end(),
                               [&](const core::Inequality& inequality) { return inequality.holds(known); });
  } catch (const Interrupted&) {
    throw;
  } catch (const Error& error) {
    result.says = std::string("the engine cannot judge this answer: ") + error.what();
    return result;
  }
  if (!result.right) result.says = exercise.hint;
  return result;
}

std::string text_of(const Exercise& exercise) {
  std::string text = exercise.asks + "\n";
  for (const Blank& blank : exercise.blanks) {
    text += "    " + blank.name + ": " + blank.asks;
    if (!blank.like.empty()) text += ", such as " + blank.like;
    if (!blank.choices.empty()) text += fmt::format(" ({})", fmt::join(blank.choices, ", "));
    text += "\n";
  }
  return text;
}

core::OrderedJson json_of(const Exercise& exercise) {
  core::OrderedJson blanks = core::OrderedJson::array();
  for (const Blank& blank : exercise.blanks)
    blanks.push_back({{"name", blank.name}, {"asks", blank.asks}, {"choices", blank.choices}, {"like", blank.like}});
  return {{"name", exercise.name}, {"asks", exercise.asks},         {"hint", exercise.hint},
          {"blanks", blanks},      {"solution", exercise.solution}, {"wrong", exercise.wrong}};
}

}  // namespace

std::vector<Lesson> lessons() {
  std::vector<Lesson> lessons;
  for (const core::ToldLesson& told : told_lessons()) lessons.push_back(told.lesson);
  return lessons;
}

Lesson lesson(const std::string& number_or_name) { return told_lesson(number_or_name).lesson; }

bool LessonCheck::all_right() const {
  return std::all_of(exercises.begin(), exercises.end(), [](const Judgement& judgement) { return judgement.right; });
}

LessonCheck check_lesson(const std::string& wanted, const std::string& text, const std::string& file,
                         std::stop_token stop) {
  const core::Admitted admitted(stop);
  const core::ToldLesson& told = told_lesson(wanted);
  const std::map<std::string, Answers> answers = core::read_answers(told.lesson, text, file);
  LessonCheck check{told.lesson.number, {}};
  const auto judge = [&](const Exercise& exercise, const core::Judge& how) {
    const auto answer = answers.find(exercise.name);
    check.exercises.push_back(judged(exercise, how, answer == answers.end() ? Answers() : answer->second, stop));
  };
  if (answers.contains(told.lesson.question.name)) judge(told.lesson.question, told.of_question);
  for (std::size_t i = 0; i < told.lesson.exercises.size(); ++i) judge(told.lesson.exercises[i], told.of_exercises[i]);
  return check;
}

std::string to_text(const std::vector<Lesson>& lessons) {
  std::string text;
  for (const Lesson& lesson : lessons)
    text += fmt::format("{:2}  {}\n    {}\n", lesson.number, lesson.title, lesson.summary);
  return text;
}

std::string to_text(const Lesson& lesson) {
  std::string text = fmt::format("Lesson {}: {} ({} minutes)\n\nThe question\n\n{}", lesson.number, lesson.title,
                                 lesson.minutes, text_of(lesson.question));
  for (const Experiment& experiment : lesson.experiments) {
    std::string command = experiment.command;
    for (const auto& [name, choices] : experiment.choices)
      if (const std::size_t at = command.find("{" + name + "}"); at != std::string::npos)
        command.replace(at, name.size() + 2, choices.front());
    text += fmt::format("\nExperiment: {}\n\n    {}\n", experiment.asks, command);
  }
  for (const Exercise& exercise : lesson.exercises)
    text += "\nExercise '" + exercise.name + "'\n\n" + text_of(exercise);
  return text;
}

std::string answers_template(const Lesson& lesson) {
  std::string text =
      fmt::format("# Lesson {}. Fill in, then: hbvm lesson check {} answers.toml\n", lesson.number, lesson.number);
  for (const Exercise& exercise : lesson.exercises) {
    text += "\n[" + exercise.name + "]\n";
    for (const Blank& blank : exercise.blanks) text += blank.name + " = \"\"  # " + blank.asks + "\n";
  }
  return text;
}

std::string to_text(const LessonCheck& check) {
  std::string text;
  for (const Judgement& judgement : check.exercises)
    text += fmt::format("{}: {}\n", judgement.exercise,
                        judgement.right ? "right" : (judgement.answered ? "not right. " : "") + judgement.says);
  return text;
}

std::string to_json(const std::vector<Lesson>& lessons) {
  core::OrderedJson list = core::OrderedJson::array();
  for (const Lesson& lesson : lessons) {
    core::OrderedJson exercises = core::OrderedJson::array();
    for (const Exercise& exercise : lesson.exercises) exercises.push_back(json_of(exercise));
    list.push_back({{"number", lesson.number},
                    {"name", lesson.name},
                    {"title", lesson.title},
                    {"summary", lesson.summary},
                    {"minutes", lesson.minutes},
                    {"question", json_of(lesson.question)},
                    {"exercises", exercises}});
  }
  return core::dumped(list, 2);
}

std::string to_json(const LessonCheck& check) {
  core::OrderedJson exercises = core::OrderedJson::array();
  for (const Judgement& judgement : check.exercises)
    exercises.push_back({{"name", judgement.exercise},
                         {"answered", judgement.answered},
                         {"right", judgement.right},
                         {"says", judgement.says}});
  return core::dumped({{"lesson", check.lesson}, {"exercises", exercises}}, 2);
}

}  // namespace hbvm
