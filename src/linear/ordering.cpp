#include "linear/ordering.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/cuthill_mckee_ordering.hpp>
#include <numeric>

namespace hbvm::core {
namespace {

Index half_bandwidth(const std::vector<Index>& position, const std::vector<std::pair<Index, Index>>& entries) {
  Index width = 0;
  for (const auto& [a, b] : entries)
    width = std::max(width, std::abs(position[static_cast<std::size_t>(a)] - position[static_cast<std::size_t>(b)]));
  return width;
}

}  // namespace

Ordering order_for_band(Index n, const std::vector<std::pair<Index, Index>>& entries) {
  using Graph = boost::adjacency_list<
      boost::setS, boost::vecS, boost::undirectedS,
      boost::property<boost::vertex_color_t, boost::default_color_type, boost::property<boost::vertex_degree_t, int>>>;
  std::vector<Index> position(static_cast<std::size_t>(n));
  std::iota(position.begin(), position.end(), Index{0});
  const Ordering natural{position, half_bandwidth(position, entries)};
  Graph graph(static_cast<std::size_t>(n));
  for (const auto& [a, b] : entries)
    if (a != b) boost::add_edge(static_cast<std::size_t>(a), static_cast<std::size_t>(b), graph);
  std::vector<Graph::vertex_descriptor> order(static_cast<std::size_t>(n));
  boost::cuthill_mckee_ordering(graph, order.rbegin(), get(boost::vertex_color, graph), boost::make_degree_map(graph));
  for (std::size_t i = 0; i < order.size(); ++i) position[order[i]] = static_cast<Index>(i);
  const Index width = half_bandwidth(position, entries);
  return width < natural.half_bandwidth ? Ordering{position, width} : natural;
}

}  // namespace hbvm::core
