#include "bendlab/mesh/near_points.hpp"

#include <limits>

#include "tests/catch.hpp"

namespace bendlab::near_points_test {
TEST_CASE("a long row of near points does not merge into one point", "[mesh]") {
  // Each point is within the tolerance of the next point, but not of the one after that.
  std::vector<std::array<double, 3>> points;
  for (int i = 0; i < 6; ++i) points.push_back({7, -0.6e-3 * i, 0});
  CHECK(near_points(points, std::vector<char>(6, 1), 1e-3) == std::vector<std::size_t>{0, 0, 2, 2, 4, 4});
}

TEST_CASE("a point merges with the nearest of the points within the tolerance", "[mesh]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::array<double, 3>> points = {{0, 0, 0},   {1e-3, 0, 0},   {0.6e-3, 0, 0},
                                                     {nan, 0, 0}, {0.4e-3, 0, 0}, {5, 5, 5},
                                                     {5, 5, 5},   {0, 0, 0.9e-3}};
  const std::vector<char> used = {1, 1, 1, 0, 1, 1, 0, 1};
  CHECK(near_points(points, used, 0.9e-3) == std::vector<std::size_t>{0, 1, 1, 3, 0, 5, 6, 0});
  CHECK(near_points({{1, 2, 3}, {1, 2, 3}, {1, 2, 4}}, {1, 1, 1}, 0) == std::vector<std::size_t>{0, 0, 2});
}

}  // namespace bendlab::near_points_test
