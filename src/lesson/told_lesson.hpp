#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hbvm/lesson.hpp"
#include "lesson/inequality.hpp"
#include "lesson/measure.hpp"

namespace hbvm::core {

/// How an exercise is judged: all of `holds` must hold of what is measured and of the numbers that were answered.
struct Judge {
  std::vector<Measure> measures;
  std::vector<Inequality> holds;
};

/// A lesson and how its question and its exercises are judged, these in the lesson's order.
struct ToldLesson {
  Lesson lesson;
  Judge of_question;
  std::vector<Judge> of_exercises;
};

/// From the text of a lesson.toml. \param name of its folder, which begins with its number
/// \throws InputError with the line and what is wrong
ToldLesson read_lesson(const std::string& text, const std::string& name);

/// Names and texts of the lessons that are compiled in, by number.
const std::vector<std::pair<std::string, std::string>>& lesson_texts();

/// Of answers: a table for each exercise of the lesson, with texts or numbers for its blanks.
/// \return for each exercise that is answered what it is answered \throws InputError with the line
std::map<std::string, Answers> read_answers(const Lesson& lesson, const std::string& text, const std::string& file);

}  // namespace hbvm::core
