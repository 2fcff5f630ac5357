#include "door/trajectory_lines.hpp"

#include <string_view>

#include "csv_line.hpp"

namespace hbvm::core {

std::streamsize TrajectoryLines::xsputn(const char* text, std::streamsize count) {
  std::string_view rest(text, static_cast<std::size_t>(count));
  for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
    line_ += rest.substr(0, end);
    end_line();
    rest.remove_prefix(end + 1);
  }
  line_ += rest;
  return count;
}

TrajectoryLines::int_type TrajectoryLines::overflow(int_type letter) {
  if (traits_type::eq_int_type(letter, traits_type::eof())) return traits_type::not_eof(letter);
  const char c = traits_type::to_char_type(letter);
  if (c == '\n')
    end_line();
  else
    line_ += c;
  return letter;
}

void TrajectoryLines::end_line() {
  if (trajectory_.columns.empty())
    trajectory_.columns = split_csv_line(line_);
  else
    trajectory_.rows.push_back(split_csv_line(line_));
  line_.clear();
}

}  // namespace hbvm::core
