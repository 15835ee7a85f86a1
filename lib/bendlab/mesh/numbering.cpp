#include "bendlab/mesh/numbering.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/cuthill_mckee_ordering.hpp>
#include <cmath>

namespace bendlab {

double mean_edge_span(const Edges& edges, const std::vector<int>& permutation) {
  if (edges.rows() == 0) return 0;
  const auto number = [&](int vertex) {
    return permutation.empty() ? vertex : permutation[static_cast<std::size_t>(vertex)];
  };
  double span = 0;
  for (Eigen::Index e = 0; e < edges.rows(); ++e) span += std::abs(number(edges(e, 0)) - number(edges(e, 1)));
  return span / static_cast<double>(edges.rows());
}

std::vector<int> local_numbering(const RestMesh& rest) {
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS,
                                      boost::property<boost::vertex_color_t, boost::default_color_type>>;
  Graph graph(static_cast<std::size_t>(rest.vertex_count()));
  for (Eigen::Index e = 0; e < rest.edges().rows(); ++e)
    boost::add_edge(static_cast<std::size_t>(rest.edges()(e, 0)),
                    static_cast<std::size_t>(rest.edges()(e, 1)), graph);
  std::vector<Graph::vertex_descriptor> order;
  order.reserve(static_cast<std::size_t>(rest.vertex_count()));
  boost::cuthill_mckee_ordering(graph, std::back_inserter(order), boost::get(boost::vertex_color, graph),
                                boost::make_out_degree_map(graph));
  std::vector<int> permutation(order.size());
  for (std::size_t at = 0; at < order.size(); ++at)
    permutation[order[order.size() - 1 - at]] = static_cast<int>(at);
  if (2 * mean_edge_span(rest.edges(), permutation) > mean_edge_span(rest.edges())) return {};
  return permutation;
}

}  // namespace bendlab
