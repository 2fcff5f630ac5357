#include <memory>
#include <optional>

#include "commands.hpp"
#include "folder_report/folder_report.hpp"
#include "hbvm/version.hpp"
#include "output_files.hpp"
#include "write_file.hpp"

namespace hbvm::core {

void add_report_command(CLI::App& app) {
  struct Arguments {
    std::string folder;
    std::optional<std::string> out;
  };
  auto o = std::make_shared<Arguments>();
  CLI::App* const command = app.add_subcommand(
      "report", "One HTML page of the tables, drawings and texts that are in a folder, to be read without a network");
  command->add_option("FOLDER", o->folder, "Folder of a study, or that --out named")->required();
  command->add_option("--out", o->out, "The page (default: report.html in the folder)");
  command->footer("Example: hbvm cost double_pendulum --digits-range 2:30 --out cost && hbvm report cost");
  command->callback([o] {
    const std::string file = o->out.value_or((std::filesystem::path(o->folder) / "report.html").string());
    std::string made = "hbvm report " + o->folder;
    if (o->out) made += " --out " + *o->out;
    write_file(file, folder_report(o->folder, version(), made));
    say_written(file);
  });
}

}  // namespace hbvm::core
