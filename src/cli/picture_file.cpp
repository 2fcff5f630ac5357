#include "picture_file.hpp"

#include <filesystem>
#include <fstream>

#include "hbvm/error.hpp"
#include "output_files.hpp"
#include "processes/draw.hpp"
#include "run/run_figure.hpp"
#include "run/run_page.hpp"
#include "write_file.hpp"

namespace hbvm::core {
namespace {

bool is_animation(const std::string& file) { return file.ends_with(".gif"); }

}  // namespace

PictureFile::PictureFile(std::string file) : file_(std::move(file)) {
  refuse_dash("--plot", file_);
  try {
    if (!is_page(file_) && !is_animation(file_)) gnuplot_script(Figure{}, file_);
  } catch (const InputError& error) {
    throw InputError(std::string("--plot: ") + error.what() + "; one that moves is .html or .gif");
  }
  std::error_code ignored;
  const bool was_there = std::filesystem::exists(file_, ignored);
  if (!std::ofstream(file_, std::ios::app)) throw InputError("--plot: cannot write '" + file_ + "'");
  if (!was_there) std::filesystem::remove(file_, ignored);
}

void PictureFile::write(const std::function<Figure()>& figure, const std::function<std::string()>& page,
                        const std::function<std::vector<Figure>()>& frames) const {
  if (is_animation(file_) && !frames)
    throw InputError("--plot: no frames are made here; use .svg, .pdf, .png or .html");
  if (is_page(file_) && !page) throw InputError("--plot: nothing moves here; use .svg, .pdf or .png");
  if (is_page(file_))
    write_file(file_, page());
  else if (is_animation(file_))
    draw_frames(frames(), frames_a_second, file_);
  else
    draw(figure(), file_);
  say_written(file_);
}

}  // namespace hbvm::core
