#include "bendlab/solver/tiling.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "bendlab/solver/colouring.hpp"
#include "bendlab/solver/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::tiling_test {
namespace {

std::size_t colour_of(const BatchOrder& order, std::size_t stack) {
  const auto behind = std::upper_bound(order.colours.begin(), order.colours.end(), stack);
  return static_cast<std::size_t>(behind - order.colours.begin()) - 1;
}

// Checks that tiles hold every stack once, that no range has two colours, and that stacks which share a
// vertex come in the order of their colours.
template <class Corners>
void check_tiles(const BatchOrder& order, const Corners& corners, int vertex_count, int tile_vertices) {
  std::vector<int> seen(order.stack_count(), 0);
  std::vector<std::size_t> latest(static_cast<std::size_t>(vertex_count), 0);  // colour at each vertex
  for (const StackRange& range : tiled(order, corners, vertex_count, tile_vertices)) {
    REQUIRE(range.first < range.last);
    const std::size_t colour = colour_of(order, range.first);
    REQUIRE(colour_of(order, range.last - 1) == colour);
    for (std::size_t stack = range.first; stack < range.last; ++stack) {
      ++seen[stack];
      for (std::size_t lane = order.stacks[stack]; lane < order.stacks[stack + 1]; ++lane)
        if (const int constraint = order.constraint(stack, lane); constraint >= 0)
          for (const int vertex : corners[static_cast<std::size_t>(constraint)]) {
            std::size_t& at_vertex = latest[static_cast<std::size_t>(vertex)];
            REQUIRE(at_vertex <= colour);
            at_vertex = colour;
          }
    }
  }
  CHECK(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
}

}  // namespace

TEST_CASE("tiles keep the order of constraints that share a vertex", "[solver]") {
  for (const TriangleMesh& mesh : {grid(1, 1, 24, 24), delaunay(1, 1, 16, 3), disc(1, 9)}) {
    const RestMesh rest(mesh);
    for (const char* model : {"crossover", "adaptive"}) {
      SimulationInput input = test::sheet(rest, make_pins(rest, {0}, 1), model);
      for (const bool numbered_at_random : {false, true}) {  // random numbering allows no tiles
        if (numbered_at_random) {
          std::vector<int> permutation(static_cast<std::size_t>(rest.vertex_count()));
          std::iota(permutation.begin(), permutation.end(), 0);
          std::shuffle(permutation.begin(), permutation.end(), std::mt19937_64(1));
          input.distance = input.distance.renumbered(permutation);
        }
        const auto& pairs = input.distance.vertices;
        for (const int tile : {1, 7, 50, 1 << 20}) {
          check_tiles(star_order(pairs, rest.vertex_count()), pairs, rest.vertex_count(), tile);
          check_tiles(colour_order(test::plain(pairs), rest.vertex_count()), pairs, rest.vertex_count(),
                      tile);
          check_tiles(colour_order(input.strain.vertices, rest.vertex_count()), input.strain.vertices,
                      rest.vertex_count(), tile);
        }
      }
    }
  }
}

TEST_CASE("tiles smaller than the grid divide each colour, a tile as large as the grid does not",
          "[solver]") {
  const RestMesh rest(grid(1, 1, 200, 200));
  const SimulationInput input = test::sheet(rest, make_pins(rest, {0}, 1), "crossover");
  const auto& pairs = input.distance.vertices;
  const BatchOrder order = star_order(pairs, rest.vertex_count());
  const std::size_t colours = order.colours.size() - 1;
  CHECK(tiled(order, pairs, rest.vertex_count(), rest.vertex_count()).size() == colours);
  CHECK(tiled(order, pairs, rest.vertex_count(), rest.vertex_count() / 8).size() >= 4 * colours);
}

TEMPLATE_TEST_CASE("tile by tile and colour by colour, the solver gives the same bits", "[solver]", float,
                   double) {
  const RestMesh rest(grid(1, 1, 180, 180));  // 32 761 vertices: several tiles in both precisions
  SimulationInput input = test::sheet(rest, make_pins(rest, {0}, 1), "crossover");
  input.method = Pbd{.sweep = Sweep::symmetric};
  const auto after = [&](int threads) {
    input.settings.threads = threads;
    const auto simulation = make_simulation<TestType>(input, test::effect_passes<TestType>("gravity"));
    for (int s = 0; s < 3; ++s) REQUIRE(simulation->step());
    return simulation->positions();
  };
  CHECK(after(1) == after(2));  // one thread goes tile by tile, two go colour by colour
}

}  // namespace bendlab::tiling_test
