#include <algorithm>
#include <charconv>

#include "lesson/told_lesson.hpp"

namespace hbvm::core {
namespace {

/// Keys and texts of a table, in the order of the file.
std::vector<std::pair<std::string, const toml::node*>> entries(const toml::table& table) {
  std::vector<std::pair<std::string, const toml::node*>> result;
  for (const auto& [key, node] : table) result.emplace_back(key.str(), &node);
  std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) {
    const toml::source_position& x = a.second->source().begin;
    const toml::source_position& y = b.second->source().begin;
    return x.line != y.line ? x.line < y.line : x.column < y.column;
  });
  return result;
}

const toml::table& table_at(TomlTable& table, std::string_view key) {
  const toml::node& node = table.require(key);
  if (!node.is_table()) table.fail(node, std::string(key) + " must be a table");
  return *node.as_table();
}

class LessonReader {
 public:
  LessonReader(const TomlSource& source, ToldLesson& told) : source_(source), told_(told) {}

  void read(const toml::table& document) {
    TomlTable top(source_, document, "lesson");
    Lesson& lesson = told_.lesson;
    lesson.title = top.string("title");
    lesson.summary = top.string("summary");
    lesson.minutes = static_cast<int>(top.integer("minutes"));
    lesson.files = named_texts(top, "files");
    told_.of_question = exercise(table_at(top, "question"), "question", lesson.question);
    for (const toml::table* table : top.tables("experiment")) experiment(*table);
    for (const toml::table* table : top.tables("exercise")) {
      lesson.exercises.emplace_back();
      told_.of_exercises.push_back(exercise(*table, "exercise", lesson.exercises.back()));
    }
    top.finish();
  }

 private:
  Answers answers(TomlTable& table, std::string_view key, const Exercise& exercise) {
    Answers result;
    for (const auto& [blank, node] : entries(table_at(table, key))) result[blank] = table.to_string(*node, blank);
    for (const auto& answer : result)
      if (std::none_of(exercise.blanks.begin(), exercise.blanks.end(),
                       [&](const Blank& blank) { return blank.name == answer.first; }))
        table.fail(std::string(key) + " answers '" + answer.first + "', which is no blank");
    return result;
  }

  Blank blank(const std::string& name, const toml::table& table, const std::string& what) {
    TomlTable blank(source_, table, what + ", blank '" + name + "'");
    Blank result{name, blank.string("asks"), {}, blank.optional_string("like")};
    if (blank.has("choices")) result.choices = blank.strings("choices");
    blank.finish();
    return result;
  }

  Judge exercise(const toml::table& table, const std::string& kind, Exercise& exercise) {
    TomlTable read(source_, table, kind);
    exercise.name = read.string("name");
    read.rename(kind + " '" + exercise.name + "'");
    exercise.asks = read.string("asks");
    // What is said after a question is no hint, but holds for whoever answers it.
    exercise.hint = read.string(kind == "question" ? "says" : "hint");
    for (const auto& [name, node] : entries(table_at(read, "blanks"))) {
      if (!node->is_table()) read.fail(*node, "blanks must be tables");
      exercise.blanks.push_back(blank(name, *node->as_table(), read.what()));
    }
    exercise.solution = answers(read, "solution", exercise);
    exercise.wrong = answers(read, "wrong", exercise);
    Judge judge;
    for (const toml::table* measure : read.tables("measure"))
      judge.measures.push_back(with_files(read_measure(source_, *measure, read.what() + ", measure")));
    for (const std::string& inequality : read.strings("holds")) {
      try {
        judge.holds.push_back(Inequality::parse(inequality));
      } catch (const ExpressionError& error) {
        read.fail(error.what());
      }
    }
    read.finish();
    return judge;
  }

  /// With the texts of files in place of their names.
  Measure with_files(Measure measure) {
    measure.files = told_.lesson.files;
    for (const auto& [name, text] : measure.files)
      for (std::string* const named : {&measure.scene, &measure.tableau})
        if (*named == name) *named = text;
    return measure;
  }

  void experiment(const toml::table& table) {
    TomlTable read(source_, table, "experiment");
    Experiment& experiment = told_.lesson.experiments.emplace_back();
    experiment.name = read.string("name");
    read.rename("experiment '" + experiment.name + "'");
    experiment.asks = read.string("asks");
    experiment.command = read.string("command");
    read.expect({"name", "asks", "command", "draw", "choices"});
    const std::string draw = read.string("draw");  // the pages' affair
    if (draw != "page" && draw != "text" && draw != "chart") read.fail("draw must be page, text or chart");
    if (read.has("choices"))
      for (const auto& [name, node] : entries(table_at(read, "choices"))) {
        const toml::array* const array = node->as_array();
        if (!array || array->empty()) read.fail(*node, name + " must be an array of texts");
        experiment.choices.emplace_back(name, std::vector<std::string>());
        for (const toml::node& choice : *array)
          experiment.choices.back().second.push_back(read.to_string(choice, name));
      }
    read.finish();
  }

  const TomlSource& source_;
  ToldLesson& told_;
};

}  // namespace

ToldLesson read_lesson(const std::string& text, const std::string& name) {
  const TomlSource source(text, name);
  ToldLesson told;
  told.lesson.name = name;
  std::from_chars(name.data(), name.data() + name.size(), told.lesson.number);
  LessonReader(source, told).read(source.parse());
  return told;
}

std::map<std::string, Answers> read_answers(const Lesson& lesson, const std::string& text, const std::string& file) {
  const TomlSource source(text, file);
  const toml::table document = source.parse();
  TomlTable top(source, document, "lesson " + std::to_string(lesson.number));
  std::map<std::string, Answers> result;
  const auto take = [&](const Exercise& exercise) {
    const toml::node* const node = top.take(exercise.name);
    if (!node) return;
    if (!node->is_table()) top.fail(*node, exercise.name + " must be a table, [" + exercise.name + "]");
    TomlTable answered(source, *node->as_table(), "exercise '" + exercise.name + "'");
    Answers answers;
    for (const Blank& blank : exercise.blanks)
      if (const toml::node* const answer = answered.take(blank.name))
        answers[blank.name] = answer->is_string() ? answered.to_string(*answer, blank.name)
                                                  : answered.to_number(*answer, blank.name).text();
    answered.finish();
    std::erase_if(answers, [](const auto& entry) { return entry.second.empty(); });
    if (!answers.empty()) result[exercise.name] = answers;
  };
  take(lesson.question);
  for (const Exercise& exercise : lesson.exercises) take(exercise);
  top.finish();
  return result;
}

}  // namespace hbvm::core
