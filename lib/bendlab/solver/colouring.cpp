#include "bendlab/solver/colouring.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>

namespace bendlab {
namespace {

// Which colours a vertex has used, as bits; all vertices have room for the same number of colours.
class UsedColours {
 public:
  UsedColours(int vertex_count, int colours)
      : words_(static_cast<std::size_t>(colours / 64 + 1)),
        bits_(static_cast<std::size_t>(vertex_count) * words_, 0) {}

  template <std::size_t arity>
  int take_first_free(const std::array<int, arity>& vertices) {
    for (std::size_t word = 0; word < words_; ++word) {
      std::uint64_t used = 0;
      for (const int vertex : vertices) used |= at(vertex, word);
      if (~used == 0) continue;
      const int bit = std::countr_one(used);
      for (const int vertex : vertices) at(vertex, word) |= std::uint64_t{1} << bit;
      return static_cast<int>(word) * 64 + bit;
    }
    return -1;
  }

 private:
  std::uint64_t& at(int vertex, std::size_t word) {
    return bits_[static_cast<std::size_t>(vertex) * words_ + word];
  }
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

template <std::size_t arity>
int largest_degree(const std::vector<std::array<int, arity>>& vertices, int vertex_count) {
  std::vector<int> degree(static_cast<std::size_t>(vertex_count), 0);
  for (const auto& constraint : vertices)
    for (const int vertex : constraint) ++degree[static_cast<std::size_t>(vertex)];
  return degree.empty() ? 0 : *std::max_element(degree.begin(), degree.end());
}

std::size_t padded(std::size_t count) {
  constexpr auto width = static_cast<std::size_t>(max_lanes);
  return (count + width - 1) / width * width;
}

}  // namespace

template <std::size_t arity>
BatchOrder colour_order(const std::vector<std::array<int, arity>>& vertices, int vertex_count) {
  // A constraint's corners have together used at most arity · (degree - 1) colours when its own is chosen.
  UsedColours used(vertex_count, static_cast<int>(arity) * largest_degree(vertices, vertex_count));
  std::vector<int> colour(vertices.size());
  std::vector<std::size_t> sizes;
  for (std::size_t c = 0; c < vertices.size(); ++c) {
    colour[c] = used.take_first_free(vertices[c]);
    if (static_cast<std::size_t>(colour[c]) >= sizes.size())
      sizes.resize(static_cast<std::size_t>(colour[c]) + 1, 0);
    ++sizes[static_cast<std::size_t>(colour[c])];
  }
  BatchOrder order;
  order.colours.assign(1, 0);
  for (const std::size_t size : sizes) order.colours.push_back(order.colours.back() + padded(size));
  order.constraint_of_lane.assign(order.colours.back(), -1);
  std::vector<std::size_t> next(order.colours.begin(), order.colours.end() - 1);
  for (std::size_t c = 0; c < vertices.size(); ++c)
    order.constraint_of_lane[next[static_cast<std::size_t>(colour[c])]++] = static_cast<int>(c);
  return order;
}

BatchOrder list_order(std::size_t constraint_count) {
  BatchOrder order;
  order.constraint_of_lane.resize(constraint_count);
  std::iota(order.constraint_of_lane.begin(), order.constraint_of_lane.end(), 0);
  order.constraint_of_lane.resize(padded(constraint_count), -1);
  order.colours = {0, order.constraint_of_lane.size()};
  order.conflict_free = false;
  return order;
}

template BatchOrder colour_order(const std::vector<std::array<int, 2>>&, int);
template BatchOrder colour_order(const std::vector<std::array<int, 3>>&, int);

}  // namespace bendlab
