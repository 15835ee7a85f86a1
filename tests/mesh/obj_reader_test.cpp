// OBJ files as many programs write them, compared with the definition of the format.
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "bendlab/mesh/readers.hpp"
#include "tests/catch.hpp"

namespace bendlab::obj_reader_test {
using Catch::Matchers::ContainsSubstring;

namespace {

using Triangles3 = std::vector<std::array<std::int64_t, 3>>;
using Points = std::vector<std::array<double, 3>>;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const Points four = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const Triangles3 two = {{0, 1, 2}, {0, 2, 3}};

void check_two(const std::string& text) {
  INFO(text);
  const PolygonSoup soup = parse_obj(text);
  CHECK(soup.points == four);
  CHECK(soup.triangles == two);
}

void check_refused(const std::string& text, const std::string& part) {
  INFO(text);
  CHECK_THROWS_WITH(parse_obj(text), ContainsSubstring(part));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

double area_of(const PolygonSoup& soup) {
  double area = 0;
  for (const auto& t : soup.triangles) {
    const auto at = [&](std::size_t c) {
      return Eigen::Map<const Vector3>(soup.points[static_cast<std::size_t>(t[c])].data());
    };
    area += 0.5 * Vector3(at(1) - at(0)).cross(Vector3(at(2) - at(0))).norm();
  }
  return area;
}

}  // namespace

TEST_CASE("OBJ: a byte order mark and any line ends are allowed", "[mesh][obj]") {
  const std::string text = square + "# a comment\n\nf 1 2 3 4\n";
  for (const char* mark : {"", "\xEF\xBB\xBF"})
    for (const char* end : {"\n", "\r\n", "\r"}) {
      check_two(mark + replaced(text, "\n", end));
      check_two(mark + replaced(square + "f 1 2 3 4", "\n", end));  // the last line without its end
    }
  check_two("v 0 0 0\rv 1 0 0\r\nv 1 1 0\nv 0 1 0\r\n\rf 1 2 3 4\r");  // a mixture
}

TEST_CASE("OBJ: a backslash at the end of a line joins this line and the next", "[mesh][obj]") {
  check_two(square + "f 1 2 \\\n3 4\n");
  check_two(square + "f 1 2\\\n3 4\n");       // right behind the number
  check_two(square + "f 1 2 \\  \t\n3 4\n");  // before blanks
  check_two(square + "f 1 2\\\r\n3 4\r\n");   // with other line ends
  check_two(square + "f 1 2\\\r3 4\r");
  check_two(square + "f \\\n1\\\n 2 \\\n3\\\n4");
  check_two(square + "f 1 2 3 4\\");  // nothing follows
  check_two("v 0 0 \\\n0\nv\\\n1 0 0\nv 1\\\n1\\\n0\nv 0 1 0\nf 1 2 3 4\n");
  check_two(square + "# a path: C:\\\nf 1 2 3 4\n");  // a comment ends with its line
  check_two(square + "f 1 2 3 4 # C:\\\n");
  check_refused(square + "f 1 2\\ 3 4\n", "line 5");
  // Two pentagons and a triangle give 3 + 3 + 1 triangles.
  const PolygonSoup soup = parse_obj(
      "v 0 0 0\nv 1 0 0\nv 1.2 0.5 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n"
      "f 1 2 3 4\\\n5\nf 6 7 4 3\\\n2\nf 1 4 5\n");
  CHECK(soup.triangles.size() == 7);
}

TEST_CASE("OBJ: comments and blanks are allowed anywhere", "[mesh][obj]") {
  check_two("# x\n" + replaced(square, "0\n", "0 # p\n") + "f 1 2 3 4 # quad\n");
  check_two(replaced(square, "\n", "# p\n") + "f 1 2 3 4# quad\n");
  check_two(replaced(square, " ", " \t  ") + "  f\t1  2 3\t4  \n\n \t \n#");
}

TEST_CASE("OBJ: corners may have no numbers after their slashes", "[mesh][obj]") {
  const std::string text = square + "vt 0 0\nvn 0 0 1\n";
  for (const char* face : {"f 1 2 3 4", "f 1/ 2/ 3/ 4/", "f 1// 2// 3// 4//", "f 1//1 2//1 3//1 4//1",
                           "f 1/1 2/1 3/1 4/1", "f 1/1/ 2/1/ 3/1/ 4/1/", "f 1/1/1 2/1/1 3/1/1 4/1/1",
                           "f -4/-1/-1 -3 -2/1 -1//1", "f +1 +2 +3 +4", "fo 1 2 3 4"})
    check_two(text + face);
  CHECK(parse_obj(text + "f 1/1/ 2/1/1 3/1 4/-1").texture_coordinates.size() == 6);
  CHECK(parse_obj(text + "f 1/1 2/1 3/1 4/").texture_coordinates.empty());
}

TEST_CASE("OBJ: negative numbers count backwards from their line, and faces may come first", "[mesh][obj]") {
  CHECK(
      parse_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 0 0\nv 6 1 0\nf -3 -2 -1\n").triangles ==
      Triangles3{{0, 1, 2}, {3, 4, 5}});
  check_two("f 1 2 3 4\n" + square);
  const PolygonSoup soup = parse_obj("f 1/1 2/2 3/3\n" + square + "vt 0 0.25\nvt 0.5 0\nvt 1 1 7\n");
  CHECK(soup.texture_coordinates == std::vector<std::array<double, 2>>{{0, 0.25}, {0.5, 0}, {1, 1}});
  check_two("f 1 2 3 4\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n");
  // A concave face before its points is cut once the points are known.
  CHECK(area_of(parse_obj("f 1 2 3 4\nv 0 0 0\nv 2 1 0\nv 0 2 0\nv 0.5 1 0\n")) == 1.5);
}

TEST_CASE("OBJ: everything except points, texture coordinates and faces is skipped", "[mesh][obj]") {
  check_two("mtllib a b.mtl\no sheet\ng left right\n" + square +
            "vn 0 0 1\nvp 0.5\nusemtl red\ns 1\ns off\nl 1 2\nl 1/1 2/2\np 1 2 3\ncstype bezier\ndeg 3\n"
            "curv 0 1 1 2 3 4\nparm u 0 1\nend\nshadow_obj x.obj\nlod 1\nwhatever 1 2\nf 1 2 3 4\n");
  check_two("v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0 1 0.5 0.5 0.5\nv 0 1 0 255 0 0 255\nf 1 2 3 4\n");
  CHECK(parse_obj("vt 0.5\nvt 0.5 1\nvt 0.5 1 2\n" + square + "f 1/1 2/2 3/3\n").texture_coordinates ==
        std::vector<std::array<double, 2>>{{0.5, 0}, {0.5, 1}, {0.5, 1}});
}

TEST_CASE("OBJ: numbers are read in all spellings", "[mesh][obj]") {
  const std::string zeros(400, '0');
  const PolygonSoup soup = parse_obj("v .5 1. +2E+1\nv 1e-400 1e400 -1e400\nv 0." + zeros + "1 nan -inf\n");
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CHECK(soup.points[0] == std::array{0.5, 1.0, 20.0});
  CHECK(soup.points[1] == std::array{0.0, infinity, -infinity});
  CHECK(soup.points[2][0] == 0);
  CHECK(std::isnan(soup.points[2][1]));
  CHECK(soup.points[2][2] == -infinity);
}

TEST_CASE("OBJ: faces of any length are read, and concave faces keep area and texture", "[mesh][obj]") {
  std::string circle, face = "f";
  for (int c = 0; c < 1000; ++c) {
    circle += "v " + std::to_string(std::cos(c * 0.006)) + " " + std::to_string(std::sin(c * 0.006)) + " 0\n";
    face += " " + std::to_string(c + 1);
  }
  CHECK(parse_obj(circle + face + "\n").triangles.size() == 998);

  const std::array<std::array<double, 2>, 6> ell = {{{2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 0}}};
  for (std::size_t first = 0; first < ell.size(); ++first) {
    std::string text, corners = "f";
    for (std::size_t c = 0; c < ell.size(); ++c) {
      const auto& [x, y] = ell[c];
      const std::string xy = std::to_string(x) + " " + std::to_string(y);
      text += "v " + xy + " 0\nvt " + xy + "\n";
      const std::string number = std::to_string((first + c) % ell.size() + 1);
      corners += " " + number + "/" + number;
    }
    const PolygonSoup soup = parse_obj(text + corners);
    CHECK(area_of(soup) == 3);  // sums of quarters are exact
    REQUIRE(soup.texture_coordinates.size() == 12);
    for (std::size_t i = 0; i < 12; ++i) {
      const auto& p = soup.points[static_cast<std::size_t>(soup.triangles[i / 3][i % 3])];
      CHECK(soup.texture_coordinates[i] == std::array{p[0], p[1]});
    }
  }
}

TEST_CASE("OBJ: a line that cannot be read is refused with its number", "[mesh][obj]") {
  check_refused(square + "f 1 2\n", "line 5: a face has fewer than 3 corners: it has 2");
  check_refused(square + "f\n", "line 5: a face has fewer than 3 corners: it has 0");
  check_refused(square + "f 0 1 2\n", "line 5: index 0");
  check_refused(square + "vt 0 0\nf 1/0 2/1 3/1\n", "line 6: index 0");
  check_refused(square + "f 1 2 -5\n", "line 5: '-5' refers to vertex '-5', but only 4 vertices are defined");
  check_refused(square + "f 1 2 99999999999999999999\n", "is too large a number");
  check_refused(square + "f 1 2 1.5\n", "'1.5' is not a whole number");
  check_refused(square + "f 1 2 /3\n", "line 5");
  check_refused(square + "f 1 2 3/1/x\n", "'x' is not a whole number");
  check_refused(square + "f 1 2 3/1/1/1\n", "'1/1' is not a whole number");
  check_refused(square + "vt 0 0\nf 1/1 2/1 3/-2\n", "texture coordinate '-2' is used");
  check_refused(square + "vt 0 0\nf 1/1 2/1 3/2\n",
                "triangle 0 uses texture coordinate 2, but the file has 1");
  check_refused("v 0 0\n", "line 1: 3 words are too few");
  check_refused("v 1,5 0 0\n", "line 1: '1,5' is not a number");
  check_refused("v 0 0 0 red\n", "line 1: 'red' is not a number");
  check_refused("\nv 0 0 \\\n\\\nx\n", "line 2: 'x' is not a number");  // the number of its first line
  check_refused("vt inf 0\n", "not finite");
  check_refused("v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\n# bow tie\nf 1 2 3 4\n",
                "line 6: the face crosses itself");
}

}  // namespace bendlab::obj_reader_test
