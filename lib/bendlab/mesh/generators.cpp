#include "bendlab/mesh/generators.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "bendlab/mesh/delaunay.hpp"
#include "bendlab/settings/random_numbers.hpp"

namespace bendlab {
namespace {

constexpr int max_count = 16384;  // 4 times its square still fits into an int

double checked_size(std::string_view name, double metres) {
  if (std::isfinite(metres) && metres > 0) return metres;
  throw std::invalid_argument(fmt::format("mesh {} is {} m, but has to be finite and above 0", name, metres));
}

// `count` is a double, because a quotient of two lengths may be too large for an int.
int checked_count(std::string_view name, double count, int minimum = 1) {
  if (count >= minimum && count <= max_count) return static_cast<int>(count);
  throw std::invalid_argument(
      fmt::format("mesh {} is {}; allowed are {} to {}", name, count, minimum, max_count));
}

// Coordinate of grid line i of 0 … n. Lines i and n - i are exactly symmetric about 0.
double grid_line(double extent, int i, int n) {
  return extent * (2 * i - n) / (2.0 * n);
}

class MeshBuilder {
 public:
  int add_vertex(double x, double y, double z = 0) {
    points_.push_back({x, y, z});
    return static_cast<int>(points_.size()) - 1;
  }
  void add_triangle(int a, int b, int c) { triangles_.push_back({a, b, c}); }

  TriangleMesh build() const {
    TriangleMesh mesh;
    mesh.positions.resize(static_cast<Eigen::Index>(points_.size()), 3);
    for (std::size_t v = 0; v < points_.size(); ++v)
      mesh.positions.row(static_cast<Eigen::Index>(v)) = points_[v].transpose();
    mesh.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      mesh.triangles.row(static_cast<Eigen::Index>(t)) << triangles_[t][0], triangles_[t][1],
          triangles_[t][2];
    return mesh;
  }

 private:
  std::vector<Vector3> points_;
  std::vector<std::array<int, 3>> triangles_;
};

// Points in a rectangle, and a grid to find the points near a new point. A cell is so small that it has room
// for only one point. (In a very thin strip, boundary points of two sides share a cell, but interior points
// have no room anyway.)
class DiscSampler {
 public:
  DiscSampler(double width, double height, double distance)
      : width_(width),
        height_(height),
        distance_(distance),
        cell_(distance / std::numbers::sqrt2),
        columns_(static_cast<int>(width / cell_) + 1),
        rows_(static_cast<int>(height / cell_) + 1),
        cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -1) {}

  void add(const Vector2& point) {
    cells_[cell_of(column(point), row(point))] = static_cast<int>(points_.size());
    points_.push_back(point);
  }

  bool has_room(const Vector2& point) const {
    const int i = column(point), j = row(point);
    for (int y = std::max(j - 2, 0); y <= std::min(j + 2, rows_ - 1); ++y)
      for (int x = std::max(i - 2, 0); x <= std::min(i + 2, columns_ - 1); ++x) {
        const int other = cells_[cell_of(x, y)];
        if (other >= 0 && (points_[static_cast<std::size_t>(other)] - point).norm() < distance_) return false;
      }
    return true;
  }

  std::vector<Vector2> take() { return std::move(points_); }

 private:
  int column(const Vector2& p) const {
    return std::min(static_cast<int>((p.x() + width_ / 2) / cell_), columns_ - 1);
  }
  int row(const Vector2& p) const {
    return std::min(static_cast<int>((p.y() + height_ / 2) / cell_), rows_ - 1);
  }
  std::size_t cell_of(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
  }

  double width_, height_, distance_, cell_;
  int columns_, rows_;
  std::vector<int> cells_;  // index of the point in the cell, or -1
  std::vector<Vector2> points_;
};

}  // namespace

TriangleMesh grid(double width, double height, int cells_x, int cells_y, Diagonal diagonal) {
  checked_size("width", width);
  checked_size("height", height);
  checked_count("cells along x", cells_x);
  checked_count("cells along y", cells_y);

  const bool both = diagonal == Diagonal::both;
  const int stride = cells_x + 1 + (both ? cells_x : 0);  // from a vertex to the vertex above it
  MeshBuilder builder;
  for (int j = 0; j <= cells_y; ++j) {
    for (int i = 0; i <= cells_x; ++i)
      builder.add_vertex(grid_line(width, i, cells_x), grid_line(height, j, cells_y));
    for (int i = 0; both && j < cells_y && i < cells_x; ++i)
      builder.add_vertex(grid_line(width, 2 * i + 1, 2 * cells_x), grid_line(height, 2 * j + 1, 2 * cells_y));
  }
  for (int j = 0; j < cells_y; ++j)
    for (int i = 0; i < cells_x; ++i) {
      const int a = j * stride + i, b = a + 1, c = b + stride,
                d = a + stride;  // counter-clockwise from lower left
      if (both) {
        const int centre = a + cells_x + 1;
        builder.add_triangle(a, b, centre);
        builder.add_triangle(b, c, centre);
        builder.add_triangle(c, d, centre);
        builder.add_triangle(d, a, centre);
      } else if (diagonal == Diagonal::same || (i + j) % 2 == 0) {
        builder.add_triangle(a, b, c);
        builder.add_triangle(a, c, d);
      } else {
        builder.add_triangle(a, b, d);
        builder.add_triangle(b, c, d);
      }
    }
  return builder.build();
}

TriangleMesh equilateral(double width, double height, int cells_along, Rows rows) {
  checked_size("width", width);
  checked_size("height", height);
  checked_count("cells along the long side", cells_along,
                2);  // with 1 the shorter rows would be single vertices

  const double long_side = std::max(width, height), short_side = std::min(width, height);
  const double edge = long_side / cells_along, strip_height = edge * std::numbers::sqrt3 / 2;
  const bool parallel = rows == Rows::parallel;
  const int edges =
      parallel ? cells_along : checked_count("edges across", std::max(2.0, std::round(short_side / edge)), 2);
  const double across = (parallel ? short_side : long_side) / strip_height;
  const int strips = checked_count("number of strips", std::max(1.0, std::round(across)));
  const bool rows_along_x = (width >= height) == parallel;

  //    +---+---+      odd row: `edges` vertices
  //   / \ / \ / \     strip: 2 edges - 1 triangles
  //  +---+---+---+    even row: edges + 1 vertices
  MeshBuilder builder;
  std::vector<int> below, row;
  for (int j = 0; j <= strips; ++j) {
    below.swap(row);
    row.clear();
    const int steps = edges - j % 2;
    for (int i = 0; i <= steps; ++i) {
      const double u = grid_line(steps * edge, i, steps), v = grid_line(strips * strip_height, j, strips);
      row.push_back(rows_along_x ? builder.add_vertex(u, v) : builder.add_vertex(v, -u));
    }
    if (j == 0) continue;
    const auto& wide = j % 2 == 1 ? below : row;
    const auto& narrow = j % 2 == 1 ? row : below;
    const auto add = [&](int a, int b, int c) {
      if (j % 2 == 0) std::swap(a, b);  // the given order is counter-clockwise if `wide` lies below
      builder.add_triangle(a, b, c);
    };
    for (std::size_t i = 0; i < narrow.size(); ++i) {
      add(wide[i], wide[i + 1], narrow[i]);
      if (i + 1 < narrow.size()) add(wide[i + 1], narrow[i + 1], narrow[i]);
    }
  }
  return builder.build();
}

TriangleMesh delaunay(double width, double height, int cells, std::uint64_t seed) {
  checked_size("width", width);
  checked_size("height", height);
  checked_count("cells", cells);
  const double spacing = width / cells;
  const int rows = checked_count("number of rows", std::max(1.0, std::round(height / spacing)));

  constexpr int darts_per_point = 30;  // as in Bridson, "Fast Poisson disk sampling", 2007
  // After this many attempts, an area of distance² holds 0.62 points, so an area of spacing² holds one point.
  constexpr double relative_distance = 0.79;
  DiscSampler sampler(width, height, relative_distance * spacing);
  // Corners are exact. A corner slightly beside the line of a side would give very thin triangles there.
  for (const double x : {-width / 2, width / 2})
    for (const double y : {-height / 2, height / 2}) sampler.add({x, y});
  for (int i = 1; i < cells; ++i)
    for (const double y : {-height / 2, height / 2}) sampler.add({grid_line(width, i, cells), y});
  for (int j = 1; j < rows; ++j)
    for (const double x : {-width / 2, width / 2}) sampler.add({x, grid_line(height, j, rows)});
  std::mt19937_64 random(seed);
  for (std::int64_t dart = std::int64_t{darts_per_point} * cells * rows; dart > 0; --dart) {
    const double x = width * (uniform(random) - 0.5), y = height * (uniform(random) - 0.5);
    if (sampler.has_room({x, y})) sampler.add({x, y});
  }

  std::vector<Vector2> points = sampler.take();
  const auto row_of = [&](const Vector2& p) { return std::floor((p.y() / height + 0.5) * rows); };
  std::sort(points.begin(), points.end(), [&](const Vector2& l, const Vector2& r) {
    return std::array{row_of(l), l.x(), l.y()} < std::array{row_of(r), r.x(), r.y()};
  });
  MeshBuilder builder;
  for (const Vector2& p : points) builder.add_vertex(p.x(), p.y());
  TriangleMesh mesh = builder.build();
  mesh.triangles = delaunay_triangles(points);
  return mesh;
}

TriangleMesh disc(double radius, int rings) {
  checked_size("radius", radius);
  checked_count("rings", rings);
  MeshBuilder builder;
  builder.add_vertex(0, 0);
  for (int r = 1; r <= rings; ++r)
    for (int k = 0; k < 6 * r; ++k) {
      const double angle = std::numbers::pi * k / (3 * r);
      builder.add_vertex(radius * r / rings * std::cos(angle), radius * r / rings * std::sin(angle));
    }

  const auto vertex = [](int r, int k) { return r == 0 ? 0 : 1 + 3 * r * (r - 1) + k % (6 * r); };
  for (int r = 1; r <= rings; ++r)
    for (int sector = 0; sector < 6; ++sector)
      for (int k = 0; k < r; ++k) {  // r triangles with an edge on ring r, r - 1 with one on ring r - 1
        const int inner = vertex(r - 1, sector * (r - 1) + k);
        const int outer = sector * r + k;
        builder.add_triangle(inner, vertex(r, outer), vertex(r, outer + 1));
        if (k + 1 < r)
          builder.add_triangle(inner, vertex(r, outer + 1), vertex(r - 1, sector * (r - 1) + k + 1));
      }
  return builder.build();
}

TriangleMesh tube(double radius, double radius_top, double height, int cells) {
  checked_size("radius", radius);
  checked_size("radius_top", radius_top);
  checked_size("height", height);
  checked_count("cells around", cells, 3);

  // At radius r an edge is e = 2 r sin(π/cells) long, and a row of equilateral triangles is √3/2 e high. The
  // height grows in proportion to r, so the rows are evenly spaced in ln r.
  const double slant = std::hypot(radius_top - radius, height), growth = std::log(radius_top / radius);
  const double mean_radius =
      std::abs(growth) < 1e-6 ? (radius + radius_top) / 2 : (radius_top - radius) / growth;
  const double row = std::numbers::sqrt3 * mean_radius * std::sin(std::numbers::pi / cells);
  const int rows = checked_count("number of rows", std::max(1.0, std::round(slant / row)));

  MeshBuilder builder;
  for (int j = 0; j <= rows; ++j) {
    const double r = j == rows ? radius_top : radius * std::exp(growth * j / rows);
    const double up =
        std::abs(growth) < 1e-6 ? static_cast<double>(j) / rows : (r - radius) / (radius_top - radius);
    for (int i = 0; i < cells; ++i) {
      const double angle = std::numbers::pi * (2 * i + j % 2) / cells;
      builder.add_vertex(r * std::cos(angle), r * std::sin(angle), (up - 0.5) * height);
    }
  }
  const auto vertex = [&](int j, int i) { return j * cells + i % cells; };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < cells; ++i) {
      const int turned =
          j % 2;  // the row above lies half a cell ahead of an even row, half a cell behind an odd row
      builder.add_triangle(vertex(j, i), vertex(j, i + 1), vertex(j + 1, i + turned));
      builder.add_triangle(vertex(j + 1, i + 1), vertex(j + 1, i), vertex(j, i + 1 - turned));
    }
  return builder.build();
}

TriangleMesh sphere(double radius, int cells) {
  checked_size("radius", radius);
  checked_count("cells", cells);
  MeshBuilder builder;
  std::map<std::array<int, 3>, int> vertices;  // lattice point with |i| + |j| + |k| = cells → vertex
  const auto vertex = [&](const Eigen::Array3i& lattice) {
    const auto [entry, is_new] = vertices.try_emplace({lattice.x(), lattice.y(), lattice.z()}, 0);
    if (is_new) {
      const Vector3 point = radius * lattice.cast<double>().matrix().normalized();
      entry->second = builder.add_vertex(point.x(), point.y(), point.z());
    }
    return entry->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const Eigen::Array3i sign(octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1);
    const auto add = [&](Eigen::Array3i a, Eigen::Array3i b, const Eigen::Array3i& c) {
      if (sign.prod() < 0) std::swap(a, b);  // mirroring reverses the orientation
      builder.add_triangle(vertex(sign * a), vertex(sign * b), vertex(sign * c));
    };
    for (int i = 0; i < cells; ++i)
      for (int j = 0; i + j < cells; ++j) {
        const int k = cells - 1 - i - j;
        add({i + 1, j, k}, {i, j + 1, k}, {i, j, k + 1});
        if (k > 0) add({i + 1, j + 1, k - 1}, {i, j + 1, k}, {i + 1, j, k});
      }
  }
  return builder.build();
}

}  // namespace bendlab
