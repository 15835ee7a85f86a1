#include "bendlab/solver/colouring.hpp"

#include <set>

#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab {
namespace {

template <class Vertices>
void check_order(const BatchOrder& order, const Vertices& vertices) {
  REQUIRE(order.stacks.front() == 0);
  REQUIRE(order.stacks.back() == order.constraint_of_lane.size());
  REQUIRE(order.colours.front() == 0);
  REQUIRE(order.colours.back() == order.stack_count());
  std::vector<int> seen(vertices.size(), 0);
  for (std::size_t colour = 0; colour + 1 < order.colours.size(); ++colour) {
    REQUIRE(order.colours[colour + 1] > order.colours[colour]);
    std::set<int> touched_in_colour;
    for (std::size_t stack = order.colours[colour]; stack < order.colours[colour + 1]; ++stack) {
      REQUIRE(order.stacks[stack] % max_lanes == 0);
      for (std::size_t lane = 0; lane < max_lanes; ++lane) {
        std::set<int> touched_in_lane;  // a star, or a single constraint
        int centre = -1;
        bool ended = false;
        for (std::size_t at = order.stacks[stack] + lane; at < order.stacks[stack + 1]; at += max_lanes) {
          const int constraint = order.constraint_of_lane[at];
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

}  // namespace

TEST_CASE("a colouring is a colouring", "[solver]") {
  for (const TriangleMesh& mesh : {grid(1, 1, 8, 8), delaunay(1, 1, 8, 3), disc(1, 5)}) {
    const RestMesh rest(mesh);
    const Pins pins = make_pins(rest, {0}, 1);
    for (const BendingModel* model : bending_models()) {
      const SimulationInput input = test::sheet(rest, pins, model->name);
      check_order(colour_order(test::plain(input.distance.vertices), rest.vertex_count()),
                  input.distance.vertices);
      check_order(star_order(input.distance.vertices, rest.vertex_count()), input.distance.vertices);
      check_order(colour_order(input.strain.vertices, rest.vertex_count()), input.strain.vertices);
    }
  }
}

TEST_CASE("greedy colouring needs fewer than twice the degree", "[solver]") {
  // An edge meets at most 2 (degree - 1) others, so first-fit uses at most 2 degree - 1 colours. Interior
  // degree: 6.
  const RestMesh rest(grid(1, 1, 12, 12));
  const SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "crossover");
  CHECK(colour_order(test::plain(input.distance.vertices), rest.vertex_count()).colours.size() - 1 <= 11);
}

TEST_CASE("stars fill their lanes", "[solver]") {
  // A colour of n stars pads at most 15 of them, and stars of an inner vertex are equally long: on a mesh
  // with hundreds of stars a colour few lanes are empty.
  const RestMesh rest(grid(1, 1, 128, 128));
  const SimulationInput input = test::sheet(rest, make_pins(rest, {0}, 1), "adaptive");
  const BatchOrder order = star_order(input.distance.vertices, rest.vertex_count());
  CHECK(static_cast<double>(order.constraint_of_lane.size()) <=
        1.05 * static_cast<double>(input.distance.size()));
  // In a stack of four every spring but the first finds its centre in a register.
  CHECK(order.stack_count() * max_lanes < input.distance.size() / 3);
}

TEST_CASE("list order keeps the list", "[solver]") {
  const BatchOrder order = list_order(20);
  CHECK_FALSE(order.conflict_free);
  REQUIRE(order.constraint_of_lane.size() == 32);
  for (int lane = 0; lane < 32; ++lane)
    CHECK(order.constraint_of_lane[static_cast<std::size_t>(lane)] == (lane < 20 ? lane : -1));
}

}  // namespace bendlab
