#include "bendlab/scene/counted.hpp"

#include <cstddef>

#include "tests/catch.hpp"

namespace bendlab::counted_test {
TEST_CASE("counted: the word is singular for 1 and plural for any other number") {
  CHECK(counted(0, "run") == "0 runs");
  CHECK(counted(1, "run") == "1 run");
  CHECK(counted(std::size_t{2}, "more run") == "2 more runs");
}

}  // namespace bendlab::counted_test
