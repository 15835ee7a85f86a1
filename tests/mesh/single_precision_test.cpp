#include "bendlab/mesh/single_precision.hpp"

#include <cmath>

#include "bendlab/mesh/generators.hpp"
#include "tests/catch.hpp"

namespace bendlab::mesh_single_precision_test {
namespace {

TriangleMesh moved(TriangleMesh mesh, double x, double y, double z) {
  mesh.positions.rowwise() += Eigen::RowVector3d(x, y, z);
  return mesh;
}

bool loses_edges(const TriangleMesh& mesh) {
  return needs_double(mesh.positions, mesh.triangles);
}

TEST_CASE("far from the origin single precision loses edges", "[mesh]") {
  // A triangle of a square cell has the sides a, a and √2 a. The rounding of coordinates is at most 2⁻²⁴ of
  // their size.
  const double mean = (2 + std::sqrt(2.0)) / 3 / 64, limit = 1e-4 * mean * 0x1p24;
  const TriangleMesh sheet = grid(1, 1, 64, 64);
  CHECK_FALSE(loses_edges(sheet));
  CHECK_FALSE(loses_edges(moved(sheet, 0, limit - 0.6, 0)));  // the sheet extends by half a metre
  CHECK(loses_edges(moved(sheet, 0, limit - 0.4, 0)));
  CHECK(loses_edges(moved(sheet, 0, 0, -2 * limit)));
  CHECK_FALSE(needs_double(Positions(0, 3), Triangles(0, 3)));

  TriangleMesh survey = moved(grid(100, 100, 64, 64), 4.5e5, 5.4e6, 300);
  CHECK(loses_edges(survey));
  // The same in other units.
  survey.positions *= 1e-3;
  CHECK(loses_edges(survey));
}

TEST_CASE("the chosen origin is a round number near the mesh, so floats keep their digits", "[mesh]") {
  CHECK(round_centre(moved(grid(1, 1, 2, 2), 1e6, -1e5, 0.25).positions) == Vector3(1e6, -1e5, 0));
  CHECK(round_centre(moved(grid(100, 80, 2, 2), 450123, 5412345, 250).positions) ==
        Vector3(450100, 5412300, 300));  // whole hundreds
  // Multiples of a thousandth, as the nearest doubles that a parser reads from the text.
  CHECK(round_centre(moved(grid(0.002, 0.002, 2, 2), 0.5004, 1.2346, 0).positions) == Vector3(0.5, 1.235, 0));

  const TriangleMesh far = moved(grid(3, 2, 50, 30), 1234567.8, 7654321.9, 1e7);
  const Positions near = far.positions.rowwise() - round_centre(far.positions).transpose();
  CHECK(near.cwiseAbs().maxCoeff() <= 2);  // half of the box plus half a metre of rounding
  CHECK_FALSE(needs_double(near, far.triangles));
}

}  // namespace
}  // namespace bendlab::mesh_single_precision_test
