#include "experiments/cli/mesh_report.hpp"

#include <cmath>

#include "bendlab/mesh/generators.hpp"
#include "tests/catch.hpp"

namespace bendlab::mesh_report_test {
using Catch::Matchers::WithinRel;

namespace {

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("the mesh report has the right counts", "[mesh][report]") {
  const auto json = mesh_report_json(grid(2, 1, 4, 2), "sheet");  // cells of 0.5 × 0.5
  CHECK(json["name"] == "sheet");
  CHECK(json["vertices"] == 15);
  CHECK(json["triangles"] == 16);
  CHECK(json["edges"] == 4 * 3 + 5 * 2 + 8);
  CHECK(json["boundary_edges"] == 12);
  CHECK(json["pieces"] == 1);
  CHECK(json["euler_number"] == 1);
  CHECK(json["size_m"] == nlohmann::ordered_json({2.0, 1.0, 0.0}));
  const double mean_edge = (22 + 8 * std::sqrt(2.0)) * 0.5 / 30, omega = std::sqrt(5.0) / 4;
  CHECK_THAT(json["mean_edge_length_m"].get<double>(), WithinRel(mean_edge, 1e-14));  // 30 additions
  CHECK_THAT(json["levels"]["omega_m"].get<double>(), WithinRel(omega, 1e-15));
  CHECK_THAT(json["levels"]["m_unrounded"].get<double>(), WithinRel(omega / mean_edge * 0.1 + 1, 1e-14));
  CHECK(json["levels"]["m"] == 1);
  CHECK(json["levels"]["n"] == 3);
  CHECK_THAT(json["quality"]["maximum_angle"]["median"].get<double>(), WithinRel(90.0, 1e-14));
  CHECK(json["counts"]["degenerate_triangles"] == 0);
  CHECK(json["thresholds"]["cap_angle"] == 160);

  const std::string text = mesh_report(grid(2, 1, 4, 2), "sheet", {.needle_ratio = 1.2, .cap_angle = 170});
  CHECK(contains(text, "vertices 15, triangles 16, edges 30 (12 on the boundary)"));
  CHECK(contains(text, "m = 1, n = 3"));
  CHECK(contains(text, "longest edge at least 1.2 times the shortest"));
  CHECK(contains(text, "an angle of at least 170°"));
  for (const QualityMeasure& measure : quality_measures()) CHECK(contains(text, measure.name));
}

TEST_CASE("the mesh report has the counts of two pieces, one of them closed", "[mesh][report]") {
  TriangleMesh mesh;  // a tetrahedron and a triangle
  mesh.positions.resize(7, 3);
  mesh.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 5, 0, 0, 6, 0, 0, 5, 1, 0;
  mesh.triangles.resize(5, 3);
  mesh.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2, 4, 5, 6;
  const auto json = mesh_report_json(mesh, "two");
  CHECK(json["pieces"] == 2);
  CHECK(json["boundary_edges"] == 3);
  CHECK(json["euler_number"] == 3);  // 2 for the tetrahedron, 1 for the triangle
}

TEST_CASE("the JSON of an infinite measure is valid", "[mesh][report]") {
  TriangleMesh mesh = grid(1, 1, 1, 1);
  mesh.positions.row(3) = mesh.positions.row(0);
  const auto json = mesh_report_json(mesh, "folded");
  CHECK(json["quality"]["condition"]["maximum"] == "infinity");
  CHECK(json["counts"]["collinear"] == 2);
  CHECK(!contains(json.dump(), "null"));
}

}  // namespace bendlab::mesh_report_test
