#pragma once

#include <map>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace hbvm {

/// What an exercise leaves to be filled in: a number, a word, or one of some choices.
struct Blank {
  std::string name, asks;
  std::vector<std::string> choices;  ///< empty: anything may be written
  std::string like;                  ///< an example of what may be
};

using Answers = std::map<std::string, std::string>;  ///< from the name of a blank to what was filled in

/// Something to be found out. It is judged by running methods.
struct Exercise {
  std::string name, asks;  ///< asks is Markdown
  std::string hint;        ///< for who has it wrong
  std::vector<Blank> blanks;
  Answers solution, wrong;  ///< one that is right, and one that is not
};

/// A command that a page runs. {name} in it stands for one of `choices`.
struct Experiment {
  std::string name, asks, command;
  std::vector<std::pair<std::string, std::vector<std::string>>> choices;
};

struct Lesson {
  int number = 0;
  std::string name;  ///< of its folder: "06_chaos_and_the_horizon"
  std::string title, summary;
  int minutes = 0;  ///< in class
  std::vector<std::pair<std::string, std::string>>
      files;          ///< scenes and tableaux that its commands name, and their texts
  Exercise question;  ///< to be answered before the rest is read
  std::vector<Experiment> experiments;
  std::vector<Exercise> exercises;
};

/// All lessons, by number.
std::vector<Lesson> lessons();
/// One of them, by its number or the name of its folder. \throws InputError with the lessons there are
Lesson lesson(const std::string& number_or_name);

/// What became of an answer.
struct Judgement {
  std::string exercise;
  bool answered = false, right = false;
  std::string says;  ///< what is missing, or why it is not right; empty if it is right
};

struct LessonCheck {
  int lesson = 0;
  std::vector<Judgement> exercises;  ///< in the lesson's order; the question is among them if it was answered

  bool all_right() const;
};

/// Judges answers by the engine: the numbers that an exercise measures are computed now, with what was answered.
/// \param answers TOML: a table for each exercise, in it the text or number of each blank
/// \param file what messages call it
/// \throws InputError for a text that is no TOML, and for exercises and blanks that are not there; Interrupted
LessonCheck check_lesson(const std::string& lesson, const std::string& answers,
                         const std::string& file = "answers.toml", std::stop_token stop = {});

std::string to_text(const std::vector<Lesson>& lessons);
/// Its question, experiments and exercises.
std::string to_text(const Lesson& lesson);
/// What is to be filled in: TOML for check_lesson().
std::string answers_template(const Lesson& lesson);
std::string to_text(const LessonCheck& check);
std::string to_json(const std::vector<Lesson>& lessons);
std::string to_json(const LessonCheck& check);

}  // namespace hbvm
