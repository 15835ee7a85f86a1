#include "bendlab/solver/colouring.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::colouring_test {
namespace {

template <class Vertices>
void check_order(const BatchOrder& order, const Vertices& vertices) {
  REQUIRE(order.stacks.front() == 0);
  REQUIRE(order.stacks.back() == order.constraint_of_lane().size());
  REQUIRE(order.colours.front() == 0);
  REQUIRE(order.colours.back() == order.stack_count());
  std::vector<int> seen(vertices.size(), 0);
  for (std::size_t colour = 0; colour + 1 < order.colours.size(); ++colour) {
    REQUIRE(order.colours[colour + 1] > order.colours[colour]);
    std::set<int> touched_in_colour;
    for (std::size_t stack = order.colours[colour]; stack < order.colours[colour + 1]; ++stack) {
      REQUIRE(order.stacks[stack] % max_lanes == 0);
      for (std::size_t lane = 0; lane < max_lanes; ++lane) {
        std::set<int> touched_in_lane;  // by a star or a single constraint
        int centre = -1;
        bool ended = false;
        for (std::size_t at = order.stacks[stack] + lane; at < order.stacks[stack + 1]; at += max_lanes) {
          const int constraint = order.constraint(stack, at);
          if (constraint < 0) ended = true;
          if (constraint < 0) continue;
          CHECK_FALSE(ended);  // padding only at the end of a lane
          ++seen[static_cast<std::size_t>(constraint)];
          const auto corners = vertices[static_cast<std::size_t>(constraint)];
          if (centre >= 0) CHECK(corners[0] == centre);
          centre = corners[0];
          touched_in_lane.insert(corners.begin(), corners.end());
        }
        for (const int vertex : touched_in_lane) CHECK(touched_in_colour.insert(vertex).second);
      }
    }
  }
  for (const int times : seen) CHECK(times == 1);
}

using Pairs = std::vector<std::array<int, 2>>;

// The pairs of each lane, by a literal implementation of the definition of star_order() in colouring.hpp.
std::vector<int> lanes_by_definition(const Pairs& pairs, int vertex_count) {
  using Star = std::vector<int>;
  std::vector<std::vector<Star>> stars_of(static_cast<std::size_t>(vertex_count));
  for (std::size_t p = pairs.size(); p-- > 0;) {
    std::vector<Star>& stars = stars_of[static_cast<std::size_t>(pairs[p][0])];
    if (stars.empty() || stars.back().size() == 4) stars.emplace_back();
    stars.back().push_back(static_cast<int>(p));
  }
  struct Colour {
    std::set<int> vertices;
    std::map<int, Star> stars;  // by centre
  };
  std::vector<Colour> colours;
  for (std::size_t rank = 0; rank < pairs.size(); ++rank)
    for (int centre = 0; centre < vertex_count; ++centre) {
      const std::vector<Star>& stars = stars_of[static_cast<std::size_t>(centre)];
      if (rank >= stars.size()) continue;
      std::set<int> vertices = {centre};
      for (const int p : stars[rank]) vertices.insert(pairs[static_cast<std::size_t>(p)][1]);
      std::size_t colour = 0;
      const auto is_used = [&](int v) { return colours[colour].vertices.contains(v); };
      while (colour < colours.size() && std::ranges::any_of(vertices, is_used)) ++colour;
      if (colour == colours.size()) colours.emplace_back();
      colours[colour].vertices.insert(vertices.begin(), vertices.end());
      colours[colour].stars[centre] = stars[rank];
    }
  std::vector<int> lanes;
  for (const Colour& colour : colours) {
    std::vector<Star> stars;
    for (const auto& [centre, star] : colour.stars) stars.push_back(star);
    for (std::size_t first = 0; first < stars.size(); first += 1024)  // neighbourhoods of 64 stacks
      std::stable_sort(stars.begin() + static_cast<std::ptrdiff_t>(first),
                       stars.begin() + static_cast<std::ptrdiff_t>(std::min(first + 1024, stars.size())),
                       [](const Star& l, const Star& r) { return l.size() > r.size(); });
    stars.resize((stars.size() + 15) / 16 * 16);
    for (std::size_t stack = 0; stack < stars.size(); stack += 16)
      for (std::size_t group = 0; group < stars[stack].size(); ++group)
        for (std::size_t lane = stack; lane < stack + 16; ++lane)
          lanes.push_back(group < stars[lane].size() ? stars[lane][group] : -1);
  }
  return lanes;
}

}  // namespace

TEST_CASE("constraints of one colour share no vertex", "[solver]") {
  for (const TriangleMesh& mesh : {grid(1, 1, 8, 8), delaunay(1, 1, 8, 3), disc(1, 5)}) {
    const RestMesh rest(mesh);
    const Pins pins = make_pins(rest, {0}, 1);
    for (const BendingKind* model : bending_models()) {
      const SimulationInput input = test::sheet(rest, pins, model->name);
      check_order(colour_order(test::plain(input.distance.vertices), rest.vertex_count()),
                  input.distance.vertices);
      check_order(star_order(input.distance.vertices, rest.vertex_count()), input.distance.vertices);
      check_order(colour_order(input.strain.vertices, rest.vertex_count()), input.strain.vertices);
    }
  }
}

TEST_CASE("greedy colouring needs fewer than twice the degree", "[solver]") {
  // An edge shares a vertex with at most 2 (degree - 1) other edges, so first-fit uses at most 2 degree - 1
  // colours. The degree is 6 in the interior.
  const RestMesh rest(grid(1, 1, 12, 12));
  const SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "crossover");
  CHECK(colour_order(test::plain(input.distance.vertices), rest.vertex_count()).colours.size() - 1 <= 11);
}

TEST_CASE("stars fill their lanes", "[solver]") {
  // A colour has at most 15 padding stars, and all stars of inner vertices are equally long. So few lanes are
  // empty on a mesh with hundreds of stars per colour.
  const RestMesh rest(grid(1, 1, 128, 128));
  const SimulationInput input = test::sheet(rest, make_pins(rest, {0}, 1), "adaptive");
  const BatchOrder order = star_order(input.distance.vertices, rest.vertex_count());
  CHECK(static_cast<double>(order.lane_count()) <= 1.05 * static_cast<double>(input.distance.size()));
  // In a stack of four, every spring except the first finds its centre in a register.
  CHECK(order.stack_count() * max_lanes < input.distance.size() / 3);
}

TEST_CASE("star_order agrees with its definition for any order of the list", "[solver]") {
  const RestMesh rest(grid(1, 1, 40, 40));
  const PairList listed = test::sheet(rest, make_pins(rest, {0}, 1), "adaptive").distance.vertices;
  Pairs shuffled = test::plain(listed);
  std::mt19937_64 random(3);
  std::shuffle(shuffled.begin(), shuffled.end(), random);
  std::vector<std::array<int, 2>> few;  // vertices without pairs, a vertex with many, pairs that occur twice
  for (int p = 0; p < 300; ++p)
    few.push_back({static_cast<int>(random() % 7) * 5, 40 + static_cast<int>(random() % 60)});
  for (const Pairs& pairs : {test::plain(listed), shuffled, few, Pairs{}, Pairs{{3, 4}}})
    CHECK(star_order(PairList(pairs), rest.vertex_count()).constraint_of_lane() ==
          lanes_by_definition(pairs, rest.vertex_count()));
}

TEST_CASE("an order takes five bytes per star if the list is sorted by vertex", "[solver]") {
  const RestMesh rest(grid(1, 1, 64, 64));
  const SimulationInput input = test::sheet(rest, make_pins(rest, {0}, 1), "adaptive");
  const BatchOrder order = star_order(input.distance.vertices, rest.vertex_count());
  CHECK(order.at_place.empty());
  CHECK(order.first.size() == order.stack_count() * max_lanes);
  CHECK(order.length.size() == order.first.size());
}

TEST_CASE("list order keeps the order of the list", "[solver]") {
  const BatchOrder order = list_order(20);
  CHECK_FALSE(order.conflict_free);
  const std::vector<int> constraint_of_lane = order.constraint_of_lane();
  REQUIRE(constraint_of_lane.size() == 32);
  for (int lane = 0; lane < 32; ++lane)
    CHECK(constraint_of_lane[static_cast<std::size_t>(lane)] == (lane < 20 ? lane : -1));
}

}  // namespace bendlab::colouring_test
