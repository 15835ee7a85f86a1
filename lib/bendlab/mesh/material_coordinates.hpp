// Material coordinates of each triangle: orthonormal axes (warp, weft) in its rest plane, and the inverse of
// Q = [q1 - q0, q2 - q0], so that the deformation gradient is F = P Q⁻¹ (SBD 2014, eqs. 5-11).
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Where material coordinates come from: the direction of the warp threads, or texture coordinates.
enum class MaterialCoordinates { warp, texture };
inline constexpr std::array<std::string_view, 2> material_coordinates_names = {"warp", "texture"};

/// Q⁻¹ row by row: {(0,0), (0,1), (1,0), (1,1)}, 1/m.
using InverseRest = std::array<double, 4>;

/// One per triangle. The warp axis is `warp_direction` projected into the triangle's rest plane, or the
/// triangle's first edge if `warp_direction` is perpendicular to the plane. A degenerate triangle first gets
/// a height (see bad_triangles.hpp) in an arbitrary direction.
std::vector<InverseRest> inverse_rest_from_warp(const TriangleMesh& mesh, const Vector3& warp_direction);

/// One per triangle. The warp axis is the texture's u direction in the rest plane. Only that direction is
/// used, so the texture may be stretched (SBD 2014, appendix). Throws std::invalid_argument if the mesh has
/// no texture coordinates or a triangle has degenerate texture coordinates.
std::vector<InverseRest> inverse_rest_from_texture(const TriangleMesh& mesh);

}  // namespace bendlab
