#include "bendlab/solver/colouring.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace bendlab {
namespace {

// The colours of the constraints at each vertex, a bit per colour. All vertices have equally many bits.
class UsedColours {
 public:
  UsedColours(int vertex_count, int colours)
      : words_(static_cast<std::size_t>(colours / 64 + 1)),
        bits_(static_cast<std::size_t>(vertex_count) * words_, 0) {}

  // Returns the first colour that none of the vertices has used, and marks this colour as used at all the
  // vertices. Returns -1 if no bit is left for another colour.
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

  // Doubles the number of bits.
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

int largest_degree(std::span<const int> vertices, int vertex_count) {
  std::vector<int> degree(static_cast<std::size_t>(vertex_count), 0);
  for (const int vertex : vertices) ++degree[static_cast<std::size_t>(vertex)];
  return degree.empty() ? 0 : *std::max_element(degree.begin(), degree.end());
}

// The largest number of springs in a star (springs with a common vertex, the centre). Longer stars move less
// memory: 30 springs save a fifth of the time. But longer stars converge worse, because a centre that moves
// 30 times in a row leaves its neighbours behind. For example, with m = 4 of the adaptive model (springs to
// four rings), 30 springs make the sheet's mean strain after equally many iterations 3 to 4 times larger.
// Stars of four springs converge as well as single springs.
constexpr std::size_t star_length = 4;

std::size_t padded(std::size_t count) {
  return (count + group_size - 1) / group_size * group_size;
}

// Makes each group of 16 lanes a stack: [0, 16), [16, 32), … (batches.hpp explains lanes, groups and stacks.)
void give_each_group_a_stack(BatchOrder& order, const std::vector<std::size_t>& first_lane_of_colour) {
  for (std::size_t lane = 0; lane <= order.first.size(); lane += group_size) order.stacks.push_back(lane);
  for (const std::size_t lane : first_lane_of_colour) order.colours.push_back(lane / group_size);
}

// Pairs grouped into stars: up to star_length pairs with the same first vertex, the centre. The stars of a
// centre have consecutive numbers. The first of these stars has the last of the centre's pairs. The place of
// a pair is its index after sorting by centre.
class Stars {
 public:
  Stars(const PairList& pairs, int vertex_count)
      : pairs_(pairs), vertices_(static_cast<std::size_t>(vertex_count)), begin_(vertices_ + 1, 0) {
    for (const auto& pair : pairs) ++begin_[static_cast<std::size_t>(pair[0]) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    first_star_.reserve(vertices_ + 1);
    first_star_.push_back(0);
    for (std::size_t centre = 0; centre < vertices_; ++centre) {
      const std::size_t stars = (pairs_at(centre) + star_length - 1) / star_length;
      first_star_.push_back(first_star_.back() + stars);
      most_ = std::max(most_, stars);
    }
    if (!pairs.ascends()) group();
  }

  std::size_t size() const { return first_star_.back(); }

  // Calls visit(star, centre, place of its first pair, number of pairs) for every star, centre by centre.
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::size_t centre = 0; centre < vertices_; ++centre)
      for (std::size_t rank = 0; first_star_[centre] + rank < first_star_[centre + 1]; ++rank)
        visit_star(visit, centre, rank);
  }

  // Like for_each(), but visits the first star of every centre, then the second star of every centre, …
  template <class Visit>
  void for_each_by_rank(Visit visit) const {
    for (std::size_t rank = 0; rank < most_; ++rank)
      for (std::size_t centre = 0; centre < vertices_; ++centre)
        if (first_star_[centre] + rank < first_star_[centre + 1]) visit_star(visit, centre, rank);
  }

  // The second vertex of the pair at `place`.
  int far_end(std::size_t place) const {
    return pairs_.second(at_place_.empty() ? place : static_cast<std::size_t>(at_place_[place]));
  }

  // For each place, the pair's index in the list; empty if the list is sorted by centre.
  std::vector<int> take_places() { return std::move(at_place_); }

 private:
  std::size_t pairs_at(std::size_t centre) const { return begin_[centre + 1] - begin_[centre]; }

  template <class Visit>
  void visit_star(Visit& visit, std::size_t centre, std::size_t rank) const {
    const std::size_t done = rank * star_length;
    visit(first_star_[centre] + rank, static_cast<int>(centre), begin_[centre + 1] - 1 - done,
          std::min(star_length, pairs_at(centre) - done));
  }

  // Fills at_place_ with the indices of pairs, sorted by centre. The pairs of a centre keep their list order.
  void group() {
    at_place_.resize(pairs_.size());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      at_place_[next[static_cast<std::size_t>(pairs_.first(p))]++] = static_cast<int>(p);
  }

  const PairList& pairs_;
  std::size_t vertices_;
  std::vector<std::size_t> begin_;       // the first place of each centre
  std::vector<std::size_t> first_star_;  // of each centre, then the number of stars
  std::size_t most_ = 0;                 // the most stars of a centre
  std::vector<int> at_place_;
};

// The colour of each star.
std::vector<int> coloured(const Stars& stars, int vertex_count) {
  std::vector<int> colours(stars.size());
  UsedColours used(vertex_count, 64);
  std::vector<int> vertices;
  stars.for_each_by_rank([&](std::size_t star, int centre, std::size_t first, std::size_t length) {
    vertices.assign(1, centre);
    for (std::size_t group = 0; group < length; ++group) vertices.push_back(stars.far_end(first - group));
    int colour = used.take_first_free(vertices);
    while (colour < 0) {
      used.make_room();
      colour = used.take_first_free(vertices);
    }
    colours[star] = colour;
  });
  return colours;
}

// The first lane of each colour if each colour fills whole groups, then the number of lanes.
std::vector<std::size_t> begin_of_colours(const std::vector<int>& colours) {
  std::vector<std::size_t> sizes;
  for (const int colour : colours) {
    if (static_cast<std::size_t>(colour) >= sizes.size()) sizes.resize(static_cast<std::size_t>(colour) + 1);
    ++sizes[static_cast<std::size_t>(colour)];
  }
  std::vector<std::size_t> first(1, 0);
  for (const std::size_t size : sizes) first.push_back(first.back() + padded(size));
  return first;
}

// Sorts the stars [begin, end) of a colour by length, so that stars of equal length share a stack without
// padding. Sorts only within neighbourhoods, because tiles (tiling.hpp) need stacks whose stars are close
// together. Stars of equal length keep their order. Stars without pairs, which fill the last stack, stay
// last.
void sort_by_length_where_they_are(BatchOrder& order, std::size_t begin, std::size_t end) {
  constexpr std::size_t neighbourhood =
      64 * group_size;  // a partly filled stack wastes 1 in 128 of the lanes
  std::vector<std::pair<int, std::uint8_t>> stars;
  for (std::size_t first = begin; first < end; first += neighbourhood) {
    stars.clear();
    for (std::size_t at = first; at < std::min(end, first + neighbourhood); ++at)
      stars.emplace_back(order.first[at], order.length[at]);
    std::ranges::stable_sort(stars, std::greater{}, &std::pair<int, std::uint8_t>::second);
    for (std::size_t at = 0; at < stars.size(); ++at)
      std::tie(order.first[first + at], order.length[first + at]) = stars[at];
  }
}

}  // namespace

BatchOrder colour_order(std::span<const int> vertices, std::size_t arity, int vertex_count) {
  // The other constraints at the corners of a constraint have at most arity · (degree - 1) colours.
  UsedColours used(vertex_count, static_cast<int>(arity) * largest_degree(vertices, vertex_count));
  std::vector<int> colours(arity == 0 ? 0 : vertices.size() / arity);
  for (std::size_t c = 0; c < colours.size(); ++c)
    colours[c] = used.take_first_free(vertices.subspan(c * arity, arity));
  std::vector<std::size_t> lanes = begin_of_colours(colours);
  BatchOrder order;
  order.first.assign(lanes.back(), -1);
  give_each_group_a_stack(order, lanes);
  for (std::size_t c = 0; c < colours.size(); ++c)
    order.first[lanes[static_cast<std::size_t>(colours[c])]++] = static_cast<int>(c);
  return order;
}

BatchOrder star_order(const PairList& pairs, int vertex_count) {
  Stars stars(pairs, vertex_count);
  const std::vector<int> colours = coloured(stars, vertex_count);
  const std::vector<std::size_t> colour_begin = begin_of_colours(colours);
  BatchOrder order;
  order.first.assign(colour_begin.back(), -1);
  order.length.assign(colour_begin.back(), 0);
  std::vector<std::size_t> next = colour_begin;
  stars.for_each([&](std::size_t star, int, std::size_t first, std::size_t length) {
    const std::size_t at = next[static_cast<std::size_t>(colours[star])]++;
    order.first[at] = static_cast<int>(first), order.length[at] = static_cast<std::uint8_t>(length);
  });
  for (std::size_t colour = 0; colour + 1 < colour_begin.size(); ++colour)
    sort_by_length_where_they_are(order, colour_begin[colour], colour_begin[colour + 1]);
  for (const std::size_t lane : colour_begin) order.colours.push_back(lane / group_size);
  // The first star of a stack is the longest, so its length is the length of the stack.
  order.stacks.reserve(order.first.size() / group_size + 1);
  order.stacks.push_back(0);
  for (std::size_t at = 0; at < order.first.size(); at += group_size)
    order.stacks.push_back(order.stacks.back() + order.length[at] * group_size);
  order.at_place = stars.take_places();
  return order;
}

BatchOrder list_order(std::size_t constraint_count) {
  BatchOrder order;
  order.first.resize(constraint_count);
  std::iota(order.first.begin(), order.first.end(), 0);
  order.first.resize(padded(constraint_count), -1);
  give_each_group_a_stack(order, {0, order.first.size()});
  order.conflict_free = false;
  return order;
}

}  // namespace bendlab
