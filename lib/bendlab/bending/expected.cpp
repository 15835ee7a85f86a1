#include "bendlab/bending/expected.hpp"

#include <algorithm>

namespace bendlab {

double expected_in_rings(const ExpectedMesh& mesh, int first, int last) {
  double sum = 0;
  for (int r = first; r <= last; ++r) {
    const double whole = r == 1 ? 2 * mesh.edges / mesh.vertices : mesh.ring_growth * r;
    // A vertex of ring r lies 0.6 r edges to the side on average. It is on the mesh if its centre is that far
    // from the border. (Ring 1 was counted with the border.)
    const auto inside = [&](double extent) { return r == 1 ? 1.0 : std::max(0.0, 1 - 0.6 * r / extent); };
    const double there = whole * inside(mesh.along) * inside(mesh.across);
    if (!(there > 0)) break;
    sum += there;
  }
  return std::min(sum, mesh.vertices - 1);
}

}  // namespace bendlab
