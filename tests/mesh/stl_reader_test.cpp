// Text STL. The format has only points, so only its keywords show whether a file is complete.
#include <stdexcept>
#include <string>

#include "bendlab/mesh/readers.hpp"
#include "tests/catch.hpp"

namespace bendlab::stl_reader_test {
using Catch::Matchers::ContainsSubstring;

namespace {

const std::vector<std::array<double, 3>> four = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<std::array<std::int64_t, 3>> two = {{0, 1, 2}, {0, 2, 3}};

}  // namespace

TEST_CASE("STL as text: all solids are read, in lower or upper case", "[mesh][files]") {
  const auto facet = [](const std::string& corners) {
    return "facet normal 0 0 1\nouter loop\n" + corners + "endloop\nendfacet\n";
  };
  const std::string lower = facet("vertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n"),
                    upper = facet("vertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\n");
  std::string capitals = "solid\n" + lower + upper + "endsolid\n";
  for (char& c : capitals)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  for (const std::string& text : std::vector<std::string>{
           "solid a\n" + lower + "endsolid a\nsolid b\n" + upper + "endsolid b\n",
           "\xEF\xBB\xBFsolid a\n" + lower + "endsolid a\n\n\nsolid solid\n" + upper + "endsolid",
           "\n  solid a\rfacet\rvertex 0 0 0\rvertex 1 0 0\rvertex 1 1 0\rvertex 0 1 0\rendfacet\rendsolid\r",
           capitals}) {
    INFO(text);
    const PolygonSoup soup = parse_stl(text);
    CHECK(soup.points == four);
    CHECK(soup.triangles == two);
  }
  CHECK_THROWS_WITH(parse_stl("solid a\n" + lower), ContainsSubstring("ends before 'endsolid'"));
  CHECK_THROWS_WITH(parse_stl("solid a\n" + lower + "endsolid\nsolid b\n" + upper),
                    ContainsSubstring("ends before 'endsolid'"));
  // The end of the first file is lost, and a second file follows.
  CHECK_THROWS_WITH(parse_stl("solid a\n" + lower.substr(0, 60) + "\nsolid b\n" + upper + "endsolid\n"),
                    ContainsSubstring("no 'endfacet'"));
}

}  // namespace bendlab::stl_reader_test
