// Mesh files: bytes → soup → mesh accepted by each policy → quantities computed from the mesh.
//
// The first byte chooses the format (0 OBJ, 1 PLY, 2 OFF, 3 STL), the other bytes are the file. Either the
// file is refused with std::invalid_argument, or:
// * an accepted mesh has finite positions and indices in range, and is larger than a point;
// * a mesh that `refuse` or `repair` accepts has no problems;
// * its edges, areas, quality, pins, material axes and parts can be computed.
#include <cmath>
#include <stdexcept>

#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/mesh/connected_parts.hpp"
#include "bendlab/mesh/geodesics.hpp"
#include "bendlab/mesh/material_coordinates.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/quality.hpp"
#include "bendlab/mesh/readers.hpp"
#include "bendlab/mesh/rest_mesh.hpp"
#include "tests/fuzz/fuzzer.hpp"

using namespace bendlab;
using namespace bendlab::fuzz;

namespace {

PolygonSoup parse(std::uint8_t format, const std::string& bytes) {
  switch (static_cast<std::uint8_t>(format - '0') % 4) {
    case 0:
      return parse_obj(bytes);
    case 1:
      return parse_ply(bytes);
    case 2:
      return parse_off(bytes);
    default:
      return parse_stl(bytes);
  }
}

void check(const TriangleMesh& mesh, BadTriangles policy) {
  require(mesh.positions.allFinite(), "an accepted mesh has finite positions");
  require(mesh.triangles.size() > 0 && mesh.triangles.minCoeff() >= 0 &&
              mesh.triangles.maxCoeff() < mesh.positions.rows(),
          "an accepted mesh has indices in range");
  if (policy == BadTriangles::refuse || policy == BadTriangles::repair)
    require(diagnose(mesh).empty(), "a mesh that is accepted as sound has no problems");
}

// None of these functions may throw for an accepted mesh, except for the two caught errors.
void measure(const TriangleMesh& mesh) {
  const RestMesh rest(mesh);
  const MeshQuality quality = measure_quality(mesh.positions, mesh.triangles);
  require(quality.measures[0].minimum <= quality.measures[0].maximum, "quality is ordered");
  require(!connected_parts(rest.one_ring()).empty(), "a mesh has a part");
  const Pins pins = make_pins(rest, {0}, 1, 0.1 * rest.size());
  geodesic_distances(rest, pins.all);
  inverse_rest_from_warp(mesh, Vector3::UnitX());
  for (std::size_t place = 0; place < place_names.size(); ++place) try {
      for (const int vertex : select_vertices(rest, static_cast<Place>(place)))
        require(vertex >= 0 && vertex < rest.vertex_count(), "a selected vertex exists");
    } catch (const std::invalid_argument&) {  // this mesh has no place of this name
    }
  if (mesh.texture_coordinates.rows() > 0) try {
      inverse_rest_from_texture(mesh);
    } catch (const std::invalid_argument&) {  // a triangle without area in the texture
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return -1;
  PolygonSoup soup;
  try {
    soup = parse(data[0], std::string(text_of(data + 1, size - 1)));
  } catch (const std::invalid_argument&) {
    return 0;
  }
  for (const BadTriangles policy :
       {BadTriangles::refuse, BadTriangles::regularise, BadTriangles::membrane_off, BadTriangles::repair}) {
    AcceptedMesh accepted;
    try {
      accepted = accept(soup, policy);
    } catch (const std::invalid_argument&) {
      continue;
    }
    check(accepted.mesh, policy);
    measure(accepted.mesh);
  }
  return 0;
}
