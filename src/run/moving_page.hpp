#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hbvm/figure.hpp"
#include "scene/sketch.hpp"

namespace hbvm::core {

/// A page is smaller than this, however long its motion and large its scene.
constexpr std::size_t moving_page_bytes = 1'000'000;

/// A curve of a chart: its value at each time of the page.
struct PageCurve {
  std::string name;
  std::vector<double> values;
  std::size_t number = 0;  ///< of the constraint whose multiplier it is, from 1
  bool is_error = false;   ///< the greatest error since the time before, of which none may be left out
  std::string label = {};  ///< what it is called in the chart, if that is not its whole name
};

struct PageChart {
  std::string title, symbol;
  AxisScale scale;
  std::vector<PageCurve> curves;
  std::optional<double> round_off = {};  ///< as a Panel has it
};

/// A page of HTML that needs nothing besides itself: a scene moves beside charts on one clock.
struct MovingPage {
  std::string title, name, method, precision, step, until;  ///< as they are said above
  std::string scene, command;                               ///< as they are said below
  Sketch sketch;
  std::vector<int> colours = {};  ///< of the places, -1 for none; if empty each body has its own
  std::vector<double> t = {};     ///< the times that are shown
  std::vector<std::vector<double>> q =
      {};  ///< the sketch's coordinates at each; not finite where nothing is to be seen
  std::vector<std::vector<double>> v = {};  ///< their velocities, which bend the paths; none if they are not known
  std::vector<PageChart> charts = {};
  long every = 1;                 ///< steps between two times
  long steps = 0, last_step = 0;  ///< of the run, and those that were made
};

/// Its numbers are doubles, in decimals that read back exactly. Where all times would be too many for
/// moving_page_bytes, it has every k-th and the last. Errors are then the greatest since the time before.
/// \throws Error if not even the first and the last state have room
/// \throws InputError if the library was built without dygraphs
std::string moving_page(const MovingPage& page);

}  // namespace hbvm::core
