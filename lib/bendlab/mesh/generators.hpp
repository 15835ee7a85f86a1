// Rest meshes, centred at the origin; lengths in m. Flat meshes lie in the plane z = 0, every triangle
// counter-clockwise. All generators throw std::invalid_argument for a size or count that is not allowed.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

enum class Generator { grid, equilateral, delaunay, disc, tube, sphere };
inline constexpr std::array<std::string_view, 6> generator_names = {"grid", "equilateral", "delaunay",
                                                                    "disc", "tube",        "sphere"};

/// Which diagonal splits a cell.
///      same          alternating        both
///    +---+---+       +---+---+       +---+---+
///    | / | / |       | \ | / |       | X | X |       both: the diagonals cross at a vertex
///    +---+---+       +---+---+       +---+---+
///    | / | / |       | / | \ |       | X | X |
///    +---+---+       +---+---+       +---+---+
enum class Diagonal { same, alternating, both };
inline constexpr std::array<std::string_view, 3> diagonal_names = {"same", "alternating", "both"};

/// A rectangle of cells_x by cells_y cells. Vertices are numbered row by row from the lower left. With
/// `both`, the centres of a row of cells are numbered after the vertices below.
TriangleMesh grid(double width, double height, int cells_x, int cells_y, Diagonal diagonal = Diagonal::same);

/// Direction of an equilateral lattice's rows of edges, relative to the long side (x if width >= height).
enum class Rows { parallel, perpendicular };
inline constexpr std::array<std::string_view, 2> rows_names = {"parallel", "perpendicular"};

/// Equilateral triangles of edge a = long side / cells_along (at least 2), numbered row by row. Every second
/// row is shorter by a/2 at each end, so two sides of the outline zigzag. Exactly equilateral triangles can't
/// fill every rectangle, so the extents are rounded: along the rows to whole edges, across the rows to whole
/// strips of height a √3/2. With `parallel`, the long side is exact.
TriangleMesh equilateral(double width, double height, int cells_along, Rows rows = Rows::parallel);

/// An irregular sheet by Delaunay triangulation. Points on the boundary are evenly spaced by s ≈ width /
/// cells; interior points are random, but at least 0.79 s from all other points (Poisson-disc sampling, about
/// one point per s²). Equal seeds give equal points on every platform. For numbering, the sheet is divided
/// into rows of height s; vertices of a row are numbered from left to right.
TriangleMesh delaunay(double width, double height, int cells, std::uint64_t seed);

/// Concentric rings around a centre vertex. Ring r has 6 r vertices at the radius r / rings · radius.
/// Vertices are numbered from the centre outward, and in a ring from angle 0 on.
TriangleMesh disc(double radius, int rings);

/// A sleeve or skirt: the side of a cylinder or cone around z, open at both ends, without a seam, normals
/// outward. A row is a circle of `cells` (at least 3) vertices. Every second row is turned by half a cell:
///
///     +---+---+---+       radius_top at z = height / 2
///    / \ / \ / \ /        The radii of the rows form a geometric series, so all triangles are similar.
///   +---+---+---+         The number of rows is chosen so that the triangles are nearly equilateral.
///
/// Vertices are numbered row by row from the bottom. Even rows start at angle 0, odd rows at half a cell. The
/// first edge of each triangle lies in a row.
TriangleMesh tube(double radius, double radius_top, double height, int cells);

/// A closed sphere with normals outward: an octahedron whose edges are split into `cells` parts, and whose
/// vertices are then moved to the sphere. 4 cells² + 2 vertices, 8 cells² triangles.
TriangleMesh sphere(double radius, int cells);

}  // namespace bendlab
