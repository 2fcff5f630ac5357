#include "progress_bar.hpp"

#include <unistd.h>

#include <cstdio>

namespace hbvm {

using Clock = std::chrono::steady_clock;

ProgressBar::ProgressBar(std::string what)
    : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) != 0), start_(Clock::now()), last_(start_) {}

ProgressBar::~ProgressBar() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::update(long done, long total) {
  if (!terminal_) return;
  const auto now = Clock::now();
  if (now - start_ < std::chrono::seconds(1) || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  shown_ = true;
  constexpr long width = 40;
  const long filled = total > 0 ? width * (done / 1000) / (total / 1000 + 1) : 0;
  std::string bar(static_cast<std::size_t>(filled), '#');
  bar.resize(width, '.');
  const auto elapsed = std::chrono::duration_cast<std::chrono::seconds>(now - start_).count();
  std::fprintf(stderr, "\r\033[K%s [%s] %ld of %ld, %lld s", what_.c_str(), bar.c_str(), done, total,
               static_cast<long long>(elapsed));
  std::fflush(stderr);
}

}  // namespace hbvm
