// Puts flaws that real meshes have into a sound mesh on purpose.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// The names that with_flaw() knows, "none" first. If nothing else is said, about every twentieth vertex,
/// triangle or edge gets the flaw:
///
///   needles             an interior vertex moved towards a neighbour, to 10⁻³ of a triangle's longer edge
///   caps                an interior vertex moved to an opposite edge, to an angle of 179.9 degrees
///   degenerate          an interior vertex moved onto the middle of such an edge: a triangle without area
///   duplicate_vertices  an interior vertex moved onto a neighbour: an edge without length
///   duplicate_faces     a triangle listed twice
///   non_manifold_edge   a fin: a third triangle at an interior edge, upright on the sheet
///   bow_tie             two triangles of an interior vertex taken out, so that the others form two fans
///   isolated_vertices   five vertices in no triangle, beside the mesh
///   pieces              the mesh cut in its middle across x into two pieces that touch but share no vertex
///   mixed_orientation   every second triangle reversed
///   hole                triangles with their centre within 0.15 sizes of the mesh's taken out, with their
///                       vertices
std::span<const std::string_view> mesh_flaws();

/// Throws std::invalid_argument for another name, and for a mesh with texture coordinates.
TriangleMesh with_flaw(TriangleMesh mesh, std::string_view flaw);

/// The same mesh with its vertices and triangles numbered at random; equal seeds give equal meshes on every
/// platform. Throws for texture coordinates, as above.
TriangleMesh shuffled(const TriangleMesh& mesh, std::uint64_t seed);

}  // namespace bendlab
