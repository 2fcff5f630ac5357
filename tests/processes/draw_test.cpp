#include "processes/draw.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "folder.hpp"
#include "hbvm/error.hpp"
#include "hbvm/figure.hpp"
#include "read_file.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    const char* const before = std::getenv(name);
    had_ = before != nullptr;
    before_ = had_ ? before : "";
    setenv(name, value, 1);
  }
  ~Environment() { had_ ? setenv(name_, before_.c_str(), 1) : unsetenv(name_); }

 private:
  const char* name_;
  bool had_;
  std::string before_;
};

class FigureTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Panel panel;
    panel.title = "it's 90° of λ";
    panel.curves = {{"one", {{0, 0}, {1, 2}}}, {"two", {{0, 1}, {1, 1}}}};
    panel.lines = {{{{0, 0}, {1, 1}}}};
    figure_.panels = {panel, panel, panel, panel};
    figure_.caption = "a caption";
    figure_.footnote = "what_made_it";
  }

  Folder folder_;
  Figure figure_;
};

/// In a locale without UTF-8, as it is where nothing is set, gnuplot would warn of a degree sign.
TEST_F(FigureTest, IsDrawnInSilenceInEveryFormatWhateverTheLocale) {
  const Environment locale("LC_ALL", "C");
  for (const auto& [ending, begins] :
       {std::pair(".svg", "<?xml"), std::pair(".pdf", "%PDF"), std::pair(".png", "\x89PNG")}) {
    const std::string file = folder_ / "it's a figure" + ending;
    testing::internal::CaptureStderr();
    draw(figure_, file);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << ending;
    EXPECT_TRUE(read_file(file).starts_with(begins)) << ending;
    EXPECT_GT(std::filesystem::file_size(file), 1'000u);
  }
  const std::string svg = read_file(folder_ / "it's a figure.svg");
  expect_words(svg, {"a caption", "what_made_it", "it's 90° of λ", "two"});
}

/// As many pictures as there are frames: each has a control extension.
TEST_F(FigureTest, MovesInAGif) {
  const std::string file = folder_ / "a.gif";
  testing::internal::CaptureStderr();
  draw_frames({figure_, figure_, figure_}, 20, file);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  const std::string gif = read_file(file), control = {0x21, '\xF9', 0x04};
  EXPECT_TRUE(gif.starts_with("GIF89a"));
  int frames = 0;
  for (std::size_t at = gif.find(control); at != std::string::npos; at = gif.find(control, at + 1)) ++frames;
  EXPECT_EQ(frames, 3);
  EXPECT_THROW(draw_frames({figure_}, 20, folder_ / "a.svg"), InputError);
}

TEST_F(FigureTest, NamesThePackageThatIsMissing) {
  const Environment path("PATH", folder_.path().c_str());
  expect_words(message_of<Error>([&] { draw(figure_, folder_ / "figure.svg"); }), {"apt install gnuplot-nox"});
}

TEST_F(FigureTest, RefusesAFolderThatIsNotThere) {
  testing::internal::CaptureStderr();
  EXPECT_THROW(draw(figure_, folder_ / "none/figure.svg"), Error);
  testing::internal::GetCapturedStderr();
}

}  // namespace
}  // namespace hbvm::core
