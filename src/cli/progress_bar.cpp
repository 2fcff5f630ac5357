#include "progress_bar.hpp"

#include <unistd.h>

#include <cstdio>

#include "interruption.hpp"

namespace hbvm::core {

using Clock = std::chrono::steady_clock;

ProgressBar::ProgressBar(std::string what)
    : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) != 0), start_(Clock::now()), last_(start_) {}

ProgressBar::~ProgressBar() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::update(long done, long total) {
  if (!terminal_) return;
  if (first_ < 0) first_ = done;
  const auto now = Clock::now();
  if (now - start_ < std::chrono::seconds(1) || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  shown_ = true;
  constexpr long width = 40;
  const double part = total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 0;
  std::string bar(static_cast<std::size_t>(width * part), '#');
  bar.resize(width, '.');
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  std::fprintf(stderr, "\r\033[K%s [%s] %ld of %ld, %.0f s", what_.c_str(), bar.c_str(), done, total, elapsed);
  // What was there from the start took no time.
  if (done > first_)
    std::fprintf(stderr, ", %.0f s left",
                 elapsed * static_cast<double>(total - done) / static_cast<double>(done - first_));
  std::fflush(stderr);
}

std::function<void(double)> ProgressBar::part_done(std::string unfinished) {
  return [this, unfinished = std::move(unfinished)](double part) {
    constexpr long parts = 10'000;
    update(static_cast<long>(part * parts), parts);
    end_if_asked(unfinished.c_str());
  };
}

}  // namespace hbvm::core
