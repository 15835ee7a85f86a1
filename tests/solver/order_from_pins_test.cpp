#include "bendlab/solver/order_from_pins.hpp"

#include <algorithm>
#include <set>

#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::order_from_pins_test {

TEST_CASE("constraints nearest to the pins come first, and keep their rest values", "[solver]") {
  // The lower left corner of a grid with parallel diagonals is pinned. A vertex (i, j) is max(i, j) edges
  // away from the pin if a diagonal ends at the pin, else i + j.
  const RestMesh rest(grid(1, 1, 7, 7));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::lower_left), 0);
  for (const std::string_view model : {"sparse_lod", "dihedral", "isometric"}) {
    const SimulationInput before = test::sheet(rest, pins, model);
    SimulationInput input = before;
    order_from_pins(input, rest);

    const auto corner = rest.position(pins.seeds.at(0));
    const auto across = [&](int v) {  // columns and rows from the pin
      const Vector3 d = 7 * (rest.position(v) - corner);
      return std::array{std::lround(std::abs(d.x())), std::lround(std::abs(d.y()))};
    };
    bool straight = false;  // whether the diagonal of the pinned cell ends at the pin
    for (const int v : rest.one_ring()[pins.seeds.at(0)]) straight |= across(v) == std::array{1L, 1L};
    const auto edges_away = [&](const auto& vertices) {
      long least = 1000;
      for (const int v : vertices) {
        const auto [i, j] = across(v);
        least = std::min(least, straight ? std::max(i, j) : i + j);
      }
      return least;
    };
    const auto check = [&](const auto& list) {
      CHECK(std::is_sorted(list.vertices.begin(), list.vertices.end(),
                           [&](const auto& a, const auto& b) { return edges_away(a) < edges_away(b); }));
    };
    check(input.strain), check(input.distance);
    for_each_kind(input.elements, check);

    using Strain = std::pair<std::array<int, 3>, std::array<double, 4>>;
    const auto pairs = [](const StrainConstraints& list) {
      std::set<Strain> set;
      for (std::size_t c = 0; c < list.size(); ++c) set.insert({list.vertices[c], list.inverse_rest[c]});
      return set;
    };
    CHECK(pairs(input.strain) == pairs(before.strain));
    for (std::size_t c = 0; c < input.distance.size(); ++c) {
      const auto [a, b] = input.distance.vertices[c];
      CHECK_THAT(input.distance.rest(c),
                 Catch::Matchers::WithinRel((rest.position(a) - rest.position(b)).norm(), 1e-14));
    }
  }
}

}  // namespace bendlab::order_from_pins_test
