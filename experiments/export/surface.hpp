// A triangulated surface that an export writes: the cloth, or an obstacle.
#pragma once

#include <string>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

struct Surface {
  std::string name;  ///< a letter, then letters, digits and '_': also of files and of prims in USD
  bool deforms = false;
  Positions positions;                 ///< #V by 3, m: of the cloth at rest, of an obstacle at time 0
  Triangles triangles;                 ///< #T by 3
  TextureCoordinates texture;          ///< #U by 2, or empty
  Triangles texture_corners;           ///< #T by 3, rows of `texture`
  Vector3 velocity = Vector3::Zero();  ///< m/s, of an obstacle

  bool moves() const { return deforms || !velocity.isZero(0); }
};

}  // namespace bendlab
