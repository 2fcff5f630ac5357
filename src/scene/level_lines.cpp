#include "scene/level_lines.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace hbvm::core {
namespace {

/// The plane where one coordinate has a value, with a grid over the other two.
class LevelPlane {
 public:
  LevelPlane(const LevelFunction& g, const SpaceBox& box, std::size_t across, double at)
      : g_(g), box_(box), across_(across), at_(at) {
    Matrix<double> points(static_cast<Index>(nodes * nodes), 3);
    for (std::size_t n = 0; n < nodes * nodes; ++n) set_row(points, n, node(n));
    values_ = g(points);
  }

  void add_lines(std::vector<PointLine>& lines) {
    for (std::size_t j = 0; j < level_cells; ++j)
      for (std::size_t i = 0; i < level_cells; ++i) cut(i, j);
    find_zeros();
    while (!next_.empty()) lines.push_back(chain());
  }

 private:
  static constexpr std::size_t nodes = level_cells + 1;
  using Edge = std::array<std::size_t, 2>;  // of nodes, the lesser number first

  static void set_row(Matrix<double>& points, std::size_t n, const std::array<double, 3>& x) {
    for (std::size_t j = 0; j < 3; ++j) points(static_cast<Index>(n), static_cast<Index>(j)) = x[j];
  }
  double value(std::size_t node) const { return values_[static_cast<Index>(node)]; }

  std::array<double, 3> node(std::size_t n) const {
    const std::size_t right = (across_ + 1) % 3, up = (across_ + 2) % 3;
    const auto share = [](std::size_t i) { return static_cast<double>(i) / static_cast<double>(level_cells); };
    std::array<double, 3> x{};
    x[across_] = at_;
    x[right] = box_.low[right] + share(n % nodes) * box_.length(right);
    x[up] = box_.low[up] + share(n / nodes) * box_.length(up);
    return x;
  }

  /// A cell's edges that g changes its sign on are joined by a line, or two of them.
  void cut(std::size_t i, std::size_t j) {
    const std::size_t a = j * nodes + i;
    const std::array<std::size_t, 4> corners{a, a + 1, a + nodes + 1, a + nodes};
    double sum = 0;
    for (const std::size_t corner : corners) sum += value(corner);
    if (!std::isfinite(sum)) return;
    std::vector<Edge> cuts;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t from = corners[k], to = corners[(k + 1) % 4];
      if ((value(from) < 0) != (value(to) < 0)) cuts.push_back({std::min(from, to), std::max(from, to)});
    }
    // Of four, the mean in the middle tells which corners are apart from the others.
    if (cuts.size() == 4 && (sum < 0) != (value(corners[0]) < 0))
      std::rotate(cuts.begin(), cuts.begin() + 1, cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); k += 2) {
      next_[cuts[k]].push_back(cuts[k + 1]);
      next_[cuts[k + 1]].push_back(cuts[k]);
    }
  }

  /// Part of an edge on which g changes its sign, and g at its ends.
  struct Bracket {
    std::array<double, 3> from, to;
    double g_from, g_to;
  };

  static std::array<double, 3> between(const std::array<double, 3>& from, const std::array<double, 3>& to,
                                       double share) {
    std::array<double, 3> x{};
    for (std::size_t j = 0; j < 3; ++j) x[j] = from[j] + share * (to[j] - from[j]);
    return x;
  }

  /// Halves each edge some times. Where g changes its sign by way of infinity it has grown at one of the ends: there is
  /// no zero, and no line.
  void find_zeros() {
    std::vector<Edge> edges;
    std::vector<Bracket> brackets;
    for (const auto& [edge, others] : next_) {
      edges.push_back(edge);
      brackets.push_back({node(edge[0]), node(edge[1]), value(edge[0]), value(edge[1])});
    }
    Matrix<double> middles(static_cast<Index>(edges.size()), 3);
    for (int halving = 0; halving < level_halvings; ++halving) {
      for (std::size_t n = 0; n < edges.size(); ++n)
        set_row(middles, n, between(brackets[n].from, brackets[n].to, 1 / double{2}));
      const Vector<double> there = g_(middles);
      for (std::size_t n = 0; n < edges.size(); ++n) {
        Bracket& bracket = brackets[n];
        const double g = there[static_cast<Index>(n)];
        const bool lower = (g < 0) == (bracket.g_from < 0);
        (lower ? bracket.from : bracket.to) = between(bracket.from, bracket.to, 1 / double{2});
        (lower ? bracket.g_from : bracket.g_to) = g;
      }
    }
    for (std::size_t n = 0; n < edges.size(); ++n) {
      const auto& [from, to, g_from, g_to] = brackets[n];
      if (std::abs(g_from) <= 2 * std::abs(value(edges[n][0])) && std::abs(g_to) <= 2 * std::abs(value(edges[n][1]))) {
        zeros_[edges[n]] = between(from, to, g_from / (g_from - g_to));
        continue;
      }
      for (const Edge& other : next_[edges[n]]) std::erase(next_[other], edges[n]);
      next_.erase(edges[n]);
    }
  }

  /// One line, taken out of what is left: from an end if there is one, else around.
  PointLine chain() {
    const auto end =
        std::find_if(next_.begin(), next_.end(), [](const auto& entry) { return entry.second.size() < 2; });
    Edge edge = (end != next_.end() ? end : next_.begin())->first;
    PointLine line{zeros_[edge]};
    for (;;) {
      std::vector<Edge>& others = next_[edge];
      if (others.empty()) break;
      const Edge other = others.front();
      others.erase(others.begin());
      std::vector<Edge>& back = next_[other];
      back.erase(std::find(back.begin(), back.end(), edge));
      if (others.empty()) next_.erase(edge);
      edge = other;
      line.push_back(zeros_[edge]);
    }
    next_.erase(edge);
    return line;
  }

  const LevelFunction& g_;
  const SpaceBox& box_;
  std::size_t across_;
  double at_;
  Vector<double> values_;
  std::map<Edge, std::vector<Edge>> next_;  ///< the edges that lines lead to
  std::map<Edge, std::array<double, 3>> zeros_;
};

}  // namespace

std::vector<PointLine> level_lines(const LevelFunction& g, const SpaceBox& box) {
  std::vector<PointLine> lines;
  for (std::size_t across = 0; across < 3; ++across)
    for (std::size_t n = 1; n < level_planes; ++n) {
      const double share = static_cast<double>(n) / static_cast<double>(level_planes);
      LevelPlane(g, box, across, box.low[across] + share * box.length(across)).add_lines(lines);
    }
  std::erase_if(lines, [](const PointLine& line) { return line.size() < 2; });
  return lines;
}

}  // namespace hbvm::core
