// measure_quality() uses quick tests of its own first. Here these tests are compared with CGAL's predicates
// in exact rational numbers, for single triangles.
#include <CGAL/Exact_rational.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <numbers>
#include <random>

#include "bendlab/mesh/quality.hpp"
#include "tests/catch.hpp"

namespace bendlab::quality_cgal_test {
namespace PMP = CGAL::Polygon_mesh_processing;

TEST_CASE("the counts of needles, caps and collinear triangles agree with CGAL", "[mesh][quality]") {
  using Point = CGAL::Simple_cartesian<CGAL::Exact_rational>::Point_3;
  using Mesh = CGAL::Surface_mesh<Point>;
  constexpr QualityThresholds thresholds;
  const double cap_cosine = std::cos(thresholds.cap_angle * std::numbers::pi / 180);

  // Corners lie on a coarse lattice, so many triangles are collinear. Some corners are moved by one part in
  // 10¹⁵, so many triangles are nearly collinear.
  std::mt19937_64 random(11);
  int needles = 0, caps = 0, collinear = 0;
  for (int trial = 0; trial < 6000; ++trial) {
    Positions corners(3, 3);
    for (Eigen::Index i = 0; i < 9; ++i) {
      corners.data()[i] = static_cast<double>(random() % 5) * (trial % 2 == 0 ? 1.0 : 0.1);
      if (random() % 8 == 0) corners.data()[i] *= 1 + 1e-15;
    }
    const MeshQuality q = measure_quality(corners, Triangles{{0, 1, 2}}, thresholds);

    Mesh mesh;
    std::array<Mesh::Vertex_index, 3> v;
    for (Eigen::Index c = 0; c < 3; ++c)
      v[static_cast<std::size_t>(c)] = mesh.add_vertex(Point(corners(c, 0), corners(c, 1), corners(c, 2)));
    const Mesh::Face_index face = mesh.add_face(v[0], v[1], v[2]);
    const bool is_needle =
        PMP::is_needle_triangle_face(face, mesh, thresholds.needle_ratio) != Mesh::null_halfedge();
    const bool is_cap = PMP::is_cap_triangle_face(face, mesh, cap_cosine) != Mesh::null_halfedge();
    const bool is_collinear = PMP::is_degenerate_triangle_face(face, mesh);
    INFO("corners\n" << corners);
    REQUIRE(q.needles == is_needle);
    REQUIRE(q.caps == is_cap);
    REQUIRE(q.collinear == is_collinear);
    REQUIRE(q.degenerate_triangles == (is_needle || is_cap || is_collinear));
    needles += is_needle, caps += is_cap, collinear += is_collinear;
  }
  CHECK(needles > 50);  // the sample has enough triangles of each kind
  CHECK(caps > 50);
  CHECK(collinear > 50);
}

}  // namespace bendlab::quality_cgal_test
