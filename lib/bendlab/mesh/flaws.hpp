// Adds typical defects of real meshes to a mesh, for tests.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// "none" and the flaws of with_flaw(). Usually about every twentieth vertex, triangle or edge gets the flaw:
///
///   needles             an interior vertex moved near a neighbour, to 10⁻³ of the length of their edge
///   caps                an interior vertex moved near an opposite edge: an angle of 179.9 degrees
///   degenerate          an interior vertex moved onto the middle of an opposite edge: zero area
///   duplicate_vertices  an interior vertex moved onto a neighbour: an edge without length
///   duplicate_faces     a triangle listed twice
///   non_manifold_edge   a fin: a third triangle at an interior edge, upright on the sheet
///   bow_tie             two triangles of an interior vertex removed, so that the others form two fans
///   isolated_vertices   five vertices in no triangle, beside the mesh
///   pieces              the mesh cut in the middle of its width into two pieces that share no vertex
///   mixed_orientation   every second triangle reversed
///   hole                triangles removed whose centre is within 0.15 mesh sizes of the mesh's centre
std::span<const std::string_view> mesh_flaws();

/// Throws std::invalid_argument for an unknown name, and for a mesh with texture coordinates.
TriangleMesh with_flaw(TriangleMesh mesh, std::string_view flaw);

/// The mesh with its vertices and triangles in random order. Equal seeds give equal meshes on every platform.
/// Throws std::invalid_argument for a mesh with texture coordinates.
TriangleMesh shuffled(const TriangleMesh& mesh, std::uint64_t seed);

}  // namespace bendlab
