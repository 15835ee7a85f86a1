#include "bendlab/settings/family.hpp"

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/catch.hpp"

namespace bendlab::family_test {
namespace {

using bendlab::Registry;
using Catch::Matchers::ContainsSubstring;

struct Shape {
  std::string_view name;
  int corners;
};
constexpr Shape triangle{"triangle", 3}, square{"square", 4}, hexagon{"hexagon", 6};
constexpr std::array<const Shape*, 2> listed = {&triangle, &square};

std::vector<int> corners(std::span<const Shape* const> shapes) {
  std::vector<int> all;
  for (const Shape* shape : shapes) all.push_back(shape->corners);
  return all;
}

}  // namespace

TEST_CASE("registry: kinds that a program adds come after the listed kinds", "[settings]") {
  Registry<Shape> shapes("shape", listed);
  CHECK(shapes.added().empty());
  shapes.add(hexagon);
  CHECK(corners(shapes.added()) == std::vector{6});
  CHECK(corners(shapes.all()) == std::vector{3, 4, 6});
}

TEST_CASE("registry: an existing or invalid name is refused, and nothing is added", "[settings]") {
  Registry<Shape> shapes("shape", listed);
  constexpr Shape other{"square", 5};
  CHECK_THROWS_WITH(shapes.add(other), ContainsSubstring("shape 'square'") && ContainsSubstring("triangle"));
  for (const char* name : {"", "a/b", "a~b", "a b", "größe"}) {
    const Shape odd{name, 1};
    CHECK_THROWS_AS(shapes.add(odd), std::invalid_argument);
  }
  CHECK(corners(shapes.all()) == std::vector{3, 4});
}

std::vector<std::string_view> names_of_four_corners() {
  return {"square", "rhombus"};
}

TEST_CASE("registry: data derived from the kinds are derived again when the kinds change", "[settings]") {
  Registry<Shape> shapes("shape", listed);
  const auto& before = bendlab::made_of_kinds<names_of_four_corners>();
  CHECK(&before == &bendlab::made_of_kinds<names_of_four_corners>());
  shapes.add(hexagon);
  CHECK(&before != &bendlab::made_of_kinds<names_of_four_corners>());
  CHECK(before.size() == 2);
  shapes.remove("hexagon"), shapes.remove("square");
  CHECK(corners(shapes.all()) == std::vector{3, 4});
}

}  // namespace bendlab::family_test
