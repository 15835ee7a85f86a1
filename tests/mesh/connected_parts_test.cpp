#include "bendlab/mesh/connected_parts.hpp"

#include <algorithm>

#include "bendlab/mesh/flaws.hpp"
#include "bendlab/mesh/generators.hpp"
#include "tests/catch.hpp"

namespace bendlab::connected_parts_test {

TEST_CASE("connected parts: a sheet is one part, in breadth-first order from its first vertex", "[mesh]") {
  const RestMesh sheet(grid(1, 1, 2, 1));  // 3 4 5 above 0 1 2, diagonals from lower left to upper right
  CHECK(connected_parts(sheet.one_ring()) == std::vector<std::vector<int>>{{0, 1, 3, 4, 2, 5}});
}

TEST_CASE("connected parts: a sheet cut in two is two parts, which hold every vertex once", "[mesh]") {
  const RestMesh cut(with_flaw(grid(1, 1, 6, 6), "pieces"));
  const auto parts = connected_parts(cut.one_ring());
  REQUIRE(parts.size() == 2);
  std::vector<int> all;
  for (const auto& part : parts) {
    CHECK(part.front() == *std::ranges::min_element(part));
    all.insert(all.end(), part.begin(), part.end());
  }
  std::ranges::sort(all);
  for (int v = 0; v < cut.vertex_count(); ++v) CHECK(all[static_cast<std::size_t>(v)] == v);
  CHECK(all.size() == static_cast<std::size_t>(cut.vertex_count()));
}

}  // namespace bendlab::connected_parts_test
