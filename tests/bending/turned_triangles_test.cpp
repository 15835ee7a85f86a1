// The orientation of a triangle has no meaning: models give the same result if some triangles are turned
// over.
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "bendlab/bending/calibration.hpp"
#include "bendlab/bending/unit_bend.hpp"
#include "bendlab/mesh/delaunay.hpp"
#include "tests/bending/shapes.hpp"
#include "tests/catch.hpp"

namespace bendlab::turned_triangles_test {
namespace {

TriangleMesh turned(TriangleMesh mesh, const std::function<bool(Eigen::Index)>& which) {
  for (Eigen::Index t = 0; t < mesh.triangle_count(); ++t)
    if (which(t)) std::swap(mesh.triangles(t, 1), mesh.triangles(t, 2));
  return mesh;
}

TriangleMesh a_third_turned(TriangleMesh mesh) {
  std::mt19937_64 random(7);
  return turned(std::move(mesh), [&](Eigen::Index) { return random() % 3 == 0; });
}

TriangleMesh half_turned(TriangleMesh mesh) {
  return turned(std::move(mesh), [](Eigen::Index t) { return t % 2 == 0; });
}

std::vector<double> calibrated_softness(std::string_view model, const RestMesh& rest, const Pins& pins) {
  BendingConstraints constraints = test::built(model, rest, pins);
  calibrate(constraints, rest, pins, {.flexural_rigidity = 1e-5, .at_curvature = 5.0});
  std::vector<double> softness = constraints.distance.softness;
  for_each_kind(constraints.elements, [&](const auto& list) {
    softness.insert(softness.end(), list.softness.begin(), list.softness.end());
  });
  return softness;
}

}  // namespace

TEST_CASE("turned triangles: a flat sheet counts as flat and has the same coordinates", "[bending][turned]") {
  for (const TriangleMesh& mesh : {grid(1, 2, 8, 16), delaunay(1, 1, 12, 4)}) {
    const std::vector<Vector2> plane = plane_coordinates(RestMesh(mesh));
    REQUIRE(plane.size() == static_cast<std::size_t>(mesh.vertex_count()));
    CHECK(plane_coordinates(RestMesh(a_third_turned(mesh))) == plane);
    CHECK(plane_coordinates(RestMesh(half_turned(mesh))).size() == plane.size());
  }
  // A surface that is not flat does not become flat, although the normals of a half turned closed surface
  // have a sum other than zero.
  CHECK(plane_coordinates(RestMesh(half_turned(sphere(1, 4)))).empty());
  CHECK(plane_coordinates(RestMesh(half_turned(tube(0.3, 0.3, 1, 12)))).empty());
}

// Without pins, and with a clamp of two columns. Hinges at the clamp resist bending only in some directions.
TEST_CASE("turned triangles: calibration gives the same stiffness", "[bending][turned]") {
  for (const std::string_view model :
       {"dihedral", "discrete_shells", "crossover", "adaptive", "lod", "sparse_lod"})
    for (const TriangleMesh& mesh :
         {delaunay(1, 1, 16, 4), equilateral(0.23335, 0.125, 12, Rows::perpendicular)})
      for (const double clamped : {0.0, 0.0338}) {
        INFO(model << ", " << clamped << " m");
        const auto softness = [&](const TriangleMesh& of) {
          const RestMesh rest(of);
          std::vector<int> seeds;
          if (clamped > 0) seeds = select_vertices(rest, Place::left);
          return calibrated_softness(model, rest, make_pins(rest, seeds, 0, clamped));
        };
        const auto largest_change = [](const std::vector<double>& before, const std::vector<double>& after) {
          if (before.size() != after.size()) return 1e300;
          double change = 0;
          for (std::size_t c = 0; c < before.size(); ++c)
            change = std::max(change, std::abs(after[c] / before[c] - 1));
          return change;
        };
        const std::vector<double> sound = softness(mesh);
        REQUIRE(!sound.empty());
        CHECK(largest_change(sound, softness(a_third_turned(mesh))) < 1e-9);
        if (model != "sparse_lod")  // it chooses other springs if the sheet is seen from the other side
          CHECK(largest_change(sound, softness(half_turned(mesh))) < 1e-9);
      }
}

TEST_CASE("turned triangles: sparse_lod chooses the same springs on curved cloth", "[bending][turned]") {
  const TriangleMesh mesh = tube(0.3, 0.3, 1, 24);
  const auto springs = [](const TriangleMesh& of) {
    return test::built("sparse_lod", RestMesh(of)).distance.vertices;
  };
  CHECK(springs(a_third_turned(mesh)) == springs(mesh));
}

}  // namespace bendlab::turned_triangles_test
