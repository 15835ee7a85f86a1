#include "bendlab/solver/colouring.hpp"

#include <set>

#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab {
namespace {

template <std::size_t arity>
void check_colouring(const std::vector<std::array<int, arity>>& vertices, int vertex_count) {
  const BatchOrder order = colour_order(vertices, vertex_count);
  REQUIRE(order.colours.front() == 0);
  REQUIRE(order.colours.back() == order.constraint_of_lane.size());
  std::set<int> seen;
  for (std::size_t c = 0; c + 1 < order.colours.size(); ++c) {
    CHECK(order.colours[c + 1] > order.colours[c]);
    CHECK(order.colours[c] % max_lanes == 0);
    std::set<int> touched;
    int last = -1;
    for (std::size_t lane = order.colours[c]; lane < order.colours[c + 1]; ++lane) {
      const int constraint = order.constraint_of_lane[lane];
      if (constraint < 0) continue;
      CHECK(constraint > last);  // list order within a colour
      last = constraint;
      CHECK(seen.insert(constraint).second);
      for (const int vertex : vertices[static_cast<std::size_t>(constraint)])
        CHECK(touched.insert(vertex).second);
    }
  }
  CHECK(seen.size() == vertices.size());
}

}  // namespace

TEST_CASE("a colouring is a colouring", "[solver]") {
  for (const TriangleMesh& mesh : {grid(1, 1, 8, 8), delaunay(1, 1, 8, 3), disc(1, 5)}) {
    const RestMesh rest(mesh);
    const Pins pins = make_pins(rest, {0}, 1);
    for (const BendingModel* model : bending_models()) {
      const SimulationInput input = test::sheet(rest, pins, model->name);
      check_colouring(input.distance.vertices, rest.vertex_count());
      check_colouring(input.strain.vertices, rest.vertex_count());
    }
  }
}

TEST_CASE("greedy colouring needs fewer than twice the degree", "[solver]") {
  // An edge meets at most 2 (degree - 1) others, so first-fit uses at most 2 degree - 1 colours. Interior
  // degree: 6.
  const RestMesh rest(grid(1, 1, 12, 12));
  const SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "crossover");
  CHECK(colour_order(input.distance.vertices, rest.vertex_count()).colours.size() - 1 <= 11);
}

TEST_CASE("list order keeps the list", "[solver]") {
  const BatchOrder order = list_order(20);
  CHECK_FALSE(order.conflict_free);
  REQUIRE(order.constraint_of_lane.size() == 32);
  for (int lane = 0; lane < 32; ++lane)
    CHECK(order.constraint_of_lane[static_cast<std::size_t>(lane)] == (lane < 20 ? lane : -1));
}

}  // namespace bendlab
