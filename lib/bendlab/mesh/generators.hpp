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

/// A rectangle of cells_x by cells_y cells. Vertices are numbered row by row from the lower left (x inner, y
/// outer); with `both` each row of cell centres follows the row of vertices below it.
TriangleMesh grid(double width, double height, int cells_x, int cells_y, Diagonal diagonal = Diagonal::same);

/// Direction of an equilateral lattice's rows of edges relative to the long side (x if width >= height).
enum class Rows { parallel, perpendicular };
inline constexpr std::array<std::string_view, 2> rows_names = {"parallel", "perpendicular"};

/// Equilateral triangles of edge a = long side / cells_along (at least 2), numbered row by row. Every second
/// row is shorter by a/2 at both ends, so two sides of the outline zigzag. Exactly equilateral triangles
/// can't fill every rectangle: along the rows the size is the nearest whole number of edges (`parallel`: the
/// long side itself), across them the nearest whole number of strips of height a √3/2.
TriangleMesh equilateral(double width, double height, int cells_along, Rows rows = Rows::parallel);

/// An irregular sheet by Delaunay triangulation. Points on the boundary are evenly spaced by s ≈ width /
/// cells; interior points are random, but no two are closer than 0.79 s (Poisson-disc darts, about one point
/// per s²). Equal seeds give equal points on every platform. Vertices are numbered in rows of height s, from
/// left to right.
TriangleMesh delaunay(double width, double height, int cells, std::uint64_t seed);

/// Concentric rings around a centre vertex, ring r with 6 r vertices at radius r / rings · radius. Vertices
/// are numbered from the centre outward, each ring from angle 0.
TriangleMesh disc(double radius, int rings);

/// A sleeve or skirt: the side of a cylinder or cone frustum around z, open at both ends, without a seam,
/// normals outward. Rows of `cells` (at least 3) vertices on circles, every second row turned by half a cell:
///
///     +---+---+---+       radius_top at z = height / 2
///    / \ / \ / \ /        Each row's radius is a constant times that of the row below, so all triangles are
///   +---+---+---+         similar. The number of rows makes them as nearly equilateral as possible.
///
/// Vertices are numbered row by row from the bottom, each row from angle 0 or half a cell. A triangle's first
/// edge lies along a circle of vertices.
TriangleMesh tube(double radius, double radius_top, double height, int cells);

/// A closed ball with normals outward: an octahedron whose edges are split into `cells` and whose vertices
/// are moved to `radius`. 4 cells² + 2 vertices, 8 cells² triangles.
TriangleMesh sphere(double radius, int cells);

}  // namespace bendlab
