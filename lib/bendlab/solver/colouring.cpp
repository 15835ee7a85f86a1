#include "bendlab/solver/colouring.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>

namespace bendlab {
namespace {

// The colours that each vertex has used, as bits. All vertices have room for the same number of colours.
class UsedColours {
 public:
  UsedColours(int vertex_count, int colours)
      : words_(static_cast<std::size_t>(colours / 64 + 1)),
        bits_(static_cast<std::size_t>(vertex_count) * words_, 0) {}

  // The first colour that none of the vertices has used; from now on all of them use it. -1: there is no room
  // for it.
  int take_first_free(std::span<const int> vertices) {
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

  // Makes room for twice as many colours.
  void make_room() {
    std::vector<std::uint64_t> wider(2 * bits_.size(), 0);
    for (std::size_t row = 0; row * words_ < bits_.size(); ++row)
      std::copy_n(&bits_[row * words_], words_, &wider[2 * row * words_]);
    bits_ = std::move(wider);
    words_ *= 2;
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

constexpr auto width = static_cast<std::size_t>(max_lanes);

// Springs that follow one another at one centre. Longer stars save more memory traffic (a fifth of the time
// at 30) but converge worse, because a centre that moves thirty times in a row leaves its neighbours behind:
// at m = 4 the sheet's mean strain after as many iterations is 3 to 4 times larger. With four, convergence is
// as good as with single springs.
constexpr std::size_t star_length = 4;

std::size_t padded(std::size_t count) {
  return (count + width - 1) / width * width;
}

// Colours with one group per stack: lanes [0, 16), [16, 32), …
void give_each_group_a_stack(BatchOrder& order, const std::vector<std::size_t>& first_lane_of_colour) {
  for (std::size_t lane = 0; lane <= order.constraint_of_lane.size(); lane += width)
    order.stacks.push_back(lane);
  for (const std::size_t lane : first_lane_of_colour) order.colours.push_back(lane / width);
}

// Up to star_length pairs with the same first vertex: members[begin .. end) of Stars.
struct Star {
  int centre;
  std::size_t begin, end;
  std::size_t length() const { return end - begin; }
};

struct Stars {
  std::vector<int> members;  // pair indices, grouped by first vertex, each group in reverse list order
  std::vector<Star> stars;   // the first of every centre, then the second of every centre, …
};

Stars stars_of(const PairList& pairs, int vertex_count) {
  std::vector<std::size_t> begin(static_cast<std::size_t>(vertex_count) + 1, 0);
  for (const auto& pair : pairs) ++begin[static_cast<std::size_t>(pair[0]) + 1];
  const std::size_t most = *std::max_element(begin.begin(), begin.end());
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  Stars all;
  all.members.resize(pairs.size());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t p = pairs.size(); p-- > 0;)
    all.members[next[static_cast<std::size_t>(pairs[p][0])]++] = static_cast<int>(p);
  for (std::size_t done = 0; done < most; done += star_length)
    for (int centre = 0; centre < vertex_count; ++centre) {
      const std::size_t first = begin[static_cast<std::size_t>(centre)] + done;
      const std::size_t end = begin[static_cast<std::size_t>(centre) + 1];
      if (first < end) all.stars.push_back({centre, first, std::min(end, first + star_length)});
    }
  return all;
}

// Stars of each colour.
std::vector<std::vector<Star>> coloured(const Stars& all, const PairList& pairs,
                                        int vertex_count) {
  std::vector<std::vector<Star>> colours;
  UsedColours used(vertex_count, 64);
  std::vector<int> vertices;
  for (const Star& star : all.stars) {
    vertices.assign(1, star.centre);
    for (std::size_t at = star.begin; at < star.end; ++at)
      vertices.push_back(pairs[static_cast<std::size_t>(all.members[at])][1]);
    int colour = used.take_first_free(vertices);
    while (colour < 0) {
      used.make_room();
      colour = used.take_first_free(vertices);
    }
    if (static_cast<std::size_t>(colour) >= colours.size())
      colours.resize(static_cast<std::size_t>(colour) + 1);
    colours[static_cast<std::size_t>(colour)].push_back(star);
  }
  return colours;
}

// Stars of one length share a stack without padding, but only within a neighbourhood: a stack that spans
// the mesh could not be tiled.
void sort_by_length_where_they_are(std::vector<Star>& stars) {
  constexpr std::size_t neighbourhood = 64 * width;  // a partly filled stack wastes 1 in 128 of its lanes
  std::sort(stars.begin(), stars.end(), [](const Star& l, const Star& r) {
    return std::tuple(l.centre, l.begin) < std::tuple(r.centre, r.begin);
  });
  for (std::size_t first = 0; first < stars.size(); first += neighbourhood) {
    const auto begin = stars.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = begin + static_cast<std::ptrdiff_t>(std::min(neighbourhood, stars.size() - first));
    std::stable_sort(begin, end, [](const Star& l, const Star& r) { return l.length() > r.length(); });
  }
}

}  // namespace

template <std::size_t arity>
BatchOrder colour_order(const std::vector<std::array<int, arity>>& vertices, int vertex_count) {
  // When a constraint's colour is chosen, its corners together have used at most arity · (degree - 1)
  // colours.
  UsedColours used(vertex_count, static_cast<int>(arity) * largest_degree(vertices, vertex_count));
  std::vector<int> colour(vertices.size());
  std::vector<std::size_t> sizes;
  for (std::size_t c = 0; c < vertices.size(); ++c) {
    colour[c] = used.take_first_free(vertices[c]);
    if (static_cast<std::size_t>(colour[c]) >= sizes.size())
      sizes.resize(static_cast<std::size_t>(colour[c]) + 1, 0);
    ++sizes[static_cast<std::size_t>(colour[c])];
  }
  std::vector<std::size_t> first_lane(1, 0);
  for (const std::size_t size : sizes) first_lane.push_back(first_lane.back() + padded(size));
  BatchOrder order;
  order.constraint_of_lane.assign(first_lane.back(), -1);
  give_each_group_a_stack(order, first_lane);
  for (std::size_t c = 0; c < vertices.size(); ++c)
    order.constraint_of_lane[first_lane[static_cast<std::size_t>(colour[c])]++] = static_cast<int>(c);
  return order;
}

BatchOrder star_order(const PairList& pairs, int vertex_count) {
  const Stars all = stars_of(pairs, vertex_count);
  BatchOrder order;
  order.constraint_of_lane.reserve(pairs.size() + pairs.size() / 16);
  for (std::vector<Star>& stars : coloured(all, pairs, vertex_count)) {
    sort_by_length_where_they_are(stars);
    order.colours.push_back(order.stacks.size());
    for (std::size_t first = 0; first < stars.size(); first += width) {
      const std::size_t begin = order.constraint_of_lane.size();
      order.stacks.push_back(begin);
      order.constraint_of_lane.resize(begin + stars[first].length() * width, -1);
      for (std::size_t lane = 0; lane < width && first + lane < stars.size(); ++lane)
        for (std::size_t step = 0; step < stars[first + lane].length(); ++step)
          order.constraint_of_lane[begin + step * width + lane] =
              all.members[stars[first + lane].begin + step];
    }
  }
  order.colours.push_back(order.stacks.size());
  order.stacks.push_back(order.constraint_of_lane.size());
  return order;
}

BatchOrder list_order(std::size_t constraint_count) {
  BatchOrder order;
  order.constraint_of_lane.resize(constraint_count);
  std::iota(order.constraint_of_lane.begin(), order.constraint_of_lane.end(), 0);
  order.constraint_of_lane.resize(padded(constraint_count), -1);
  give_each_group_a_stack(order, {0, order.constraint_of_lane.size()});
  order.conflict_free = false;
  return order;
}

template BatchOrder colour_order(const std::vector<std::array<int, 2>>&, int);
template BatchOrder colour_order(const std::vector<std::array<int, 3>>&, int);
template BatchOrder colour_order(const std::vector<std::array<int, 4>>&, int);

}  // namespace bendlab
