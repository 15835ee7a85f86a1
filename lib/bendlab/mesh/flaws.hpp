// Puts flaws that real meshes have into a sound mesh on purpose.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// The names that with_flaw() knows, "none" first. Unless stated otherwise, about every twentieth vertex,
/// triangle or edge gets the flaw:
///
///   needles             an interior vertex moved near a neighbour, to a distance of 10⁻³ of an edge
///   caps                an interior vertex moved near an opposite edge, so that its angle is 179.9 degrees
///   degenerate          an interior vertex moved onto the middle of an opposite edge: zero area
///   duplicate_vertices  an interior vertex moved onto a neighbour: an edge without length
///   duplicate_faces     a triangle listed twice
///   non_manifold_edge   a fin: a third triangle at an interior edge, upright on the sheet
///   bow_tie             two triangles of an interior vertex taken out, so that the rest form two fans
///   isolated_vertices   five vertices in no triangle, beside the mesh
///   pieces              the mesh cut at its middle in x into two pieces that touch but share no vertex
///   mixed_orientation   every second triangle reversed
///   hole                triangles taken out, with their vertices, whose centre is within 0.15 mesh sizes of
///                       the mesh's centre
std::span<const std::string_view> mesh_flaws();

/// Throws std::invalid_argument for an unknown name, and for a mesh with texture coordinates.
TriangleMesh with_flaw(TriangleMesh mesh, std::string_view flaw);

/// The same mesh with its vertices and triangles numbered at random; equal seeds give equal meshes on every
/// platform. Throws std::invalid_argument for a mesh with texture coordinates.
TriangleMesh shuffled(const TriangleMesh& mesh, std::uint64_t seed);

}  // namespace bendlab
