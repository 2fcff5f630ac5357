#include <filesystem>
#include <iostream>
#include <memory>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "hbvm/error.hpp"
#include "hbvm/lesson.hpp"
#include "output_files.hpp"
#include "read_file.hpp"
#include "signals.hpp"

namespace hbvm::core {
namespace {

void add_lesson_list(CLI::App& lesson) {
  auto json = std::make_shared<bool>(false);
  CLI::App* const command = lesson.add_subcommand("list", "List the lessons");
  command->add_flag("--json", *json, "Print JSON and nothing else");
  command->footer("Example: hbvm lesson list");
  command->callback([json] { std::cout << (*json ? to_json(lessons()) + "\n" : to_text(lessons())) << std::flush; });
}

void add_lesson_show(CLI::App& lesson) {
  auto name = std::make_shared<std::string>();
  CLI::App* const command = lesson.add_subcommand("show", "Print a lesson's question, experiments and exercises");
  command->add_option("LESSON", *name, "Its number, or the name of its folder")->required();
  command->footer("Example: hbvm lesson show 6");
  command->callback([name] { std::cout << to_text(hbvm::lesson(*name)) << std::flush; });
}

struct BeginArguments {
  std::string lesson, folder = ".";
};

void begin_command(const BeginArguments& o) {
  namespace fs = std::filesystem;
  const Lesson begun = hbvm::lesson(o.lesson);
  std::vector<std::pair<std::string, std::string>> files = begun.files;
  files.emplace_back("answers.toml", answers_template(begun));
  for (const auto& [name, text] : files)
    if (fs::exists(fs::path(o.folder) / name))
      throw InputError("'" + (fs::path(o.folder) / name).string() + "' is there already: name another folder by --out");
  fs::create_directories(o.folder);
  for (const auto& [name, text] : files) write_and_say((fs::path(o.folder) / name).string(), text);
}

void add_lesson_begin(CLI::App& lesson) {
  auto o = std::make_shared<BeginArguments>();
  CLI::App* const command =
      lesson.add_subcommand("begin", "Write the files of a lesson's commands, and answers.toml to be filled in");
  command->add_option("LESSON", o->lesson, "Its number, or the name of its folder")->required();
  command->add_option("--out", o->folder, "The folder they go to")->capture_default_str();
  command->footer("Example: hbvm lesson begin 6 --out lesson6");
  command->callback([o] { begin_command(*o); });
}

struct CheckLessonArguments {
  std::string lesson, file;
  bool json = false;
};

void check_lesson_command(const CheckLessonArguments& o) {
  end_runs_on_signals();
  const LessonCheck check = check_lesson(o.lesson, read_file(o.file), o.file);
  std::cout << (o.json ? to_json(check) + "\n" : to_text(check)) << std::flush;
  if (!check.all_right()) throw CLI::RuntimeError(1);
}

void add_lesson_check(CLI::App& lesson) {
  auto o = std::make_shared<CheckLessonArguments>();
  CLI::App* const command =
      lesson.add_subcommand("check", "Judge the answers to a lesson's exercises, by computing them");
  command->add_option("LESSON", o->lesson, "Its number, or the name of its folder")->required();
  command->add_option("ANSWERS", o->file, "A TOML file, as `hbvm lesson begin` writes it")->required();
  command->add_flag("--json", o->json, "Print one JSON object and nothing else");
  command->footer(
      "The exit code is 1 if an answer is missing or not right.\nExample: hbvm lesson check 6 answers.toml");
  command->callback([o] { check_lesson_command(*o); });
}

}  // namespace

void add_lesson_command(CLI::App& app) {
  CLI::App* const lesson = app.add_subcommand("lesson", "Lessons: what they ask, and whether answers are right");
  lesson->require_subcommand(1);
  lesson->footer("Example: hbvm lesson show 6");
  add_lesson_list(*lesson);
  add_lesson_show(*lesson);
  add_lesson_begin(*lesson);
  add_lesson_check(*lesson);
}

}  // namespace hbvm::core
