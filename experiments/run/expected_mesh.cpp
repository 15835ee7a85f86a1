#include "experiments/run/expected_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>
#include <string>

#include "bendlab/bending/levels.hpp"
#include "bendlab/mesh/generators.hpp"
#include "bendlab/mesh/rings.hpp"
#include "bendlab/scene/built_scene.hpp"

namespace bendlab {
namespace {

// Of a sheet with a border, whose vertices and triangles are known.
ExpectedMesh sheet(double vertices, double triangles, double along, double across) {
  ExpectedMesh mesh{.vertices = vertices, .triangles = triangles};
  mesh.edges = vertices + triangles - 1;  // Euler
  mesh.along = std::max(along, across), mesh.across = std::min(along, across);
  return mesh;
}

ExpectedMesh expected_grid(double width, double height, double cells, Diagonal diagonal) {
  const double rows = std::max(1.0, std::round(cells * height / width)), squares = cells * rows;
  const double across = width / cells, up = height / rows, slanted = std::hypot(across, up);
  const double straight = across * cells * (rows + 1) + up * rows * (cells + 1);
  const bool both = diagonal == Diagonal::both;
  ExpectedMesh mesh = sheet((cells + 1) * (rows + 1) + (both ? squares : 0), (both ? 4 : 2) * squares,
                            (both ? 2 : 1) * cells, (both ? 2 : 1) * rows);
  mesh.mean_edge = (straight + squares * (both ? 2 : 1) * slanted) / mesh.edges;
  mesh.ring_growth = diagonal == Diagonal::same ? 6 : 8;
  mesh.size = std::hypot(width, height);
  return mesh;
}

ExpectedMesh expected_equilateral(double width, double height, double cells, Rows rows) {
  const double longer = std::max(width, height), shorter = std::min(width, height), edge = longer / cells,
               strip = edge * std::numbers::sqrt3 / 2;
  const bool parallel = rows == Rows::parallel;
  const double edges = parallel ? cells : std::max(2.0, std::round(shorter / edge));
  const double strips = std::max(1.0, std::round((parallel ? shorter : longer) / strip));
  ExpectedMesh mesh = sheet((strips + 1) * (edges + 0.5), strips * (2 * edges - 1), edges, strips);
  mesh.mean_edge = edge, mesh.size = std::hypot(width, height);
  return mesh;
}

ExpectedMesh expected_delaunay(double width, double height, double cells) {
  const double rows = std::max(1.0, std::round(cells * height / width)), border = 2 * (cells + rows),
               vertices = (cells + 1) * (rows + 1);
  ExpectedMesh mesh = sheet(vertices, 2 * vertices - border - 2, cells, rows);
  mesh.mean_edge = 1.1 * width / cells;  // one point per square of this width; measured
  mesh.ring_growth = 6.6;                // measured
  mesh.size = std::hypot(width, height);
  return mesh;
}

ExpectedMesh expected_disc(double radius, double rings) {
  ExpectedMesh mesh = sheet(1 + 3 * rings * (rings + 1), 6 * rings * rings, 1.7 * rings, 1.7 * rings);
  mesh.mean_edge = 1.12 * radius / rings;  // measured
  mesh.size = 2 * std::numbers::sqrt2 * radius;
  return mesh;
}

ExpectedMesh expected_tube(double radius, double radius_top, double height, double cells) {
  const double slant = std::hypot(radius_top - radius, height), growth = std::log(radius_top / radius);
  const double mean = std::abs(growth) < 1e-6 ? (radius + radius_top) / 2 : (radius_top - radius) / growth;
  const double edge = 2 * mean * std::sin(std::numbers::pi / cells),
               rows = std::max(1.0, std::round(slant / (std::numbers::sqrt3 / 2 * edge)));
  ExpectedMesh mesh{.vertices = cells * (rows + 1), .triangles = 2 * cells * rows};
  mesh.edges = mesh.vertices + mesh.triangles;
  mesh.mean_edge = edge, mesh.along = std::numeric_limits<double>::infinity(), mesh.across = rows;
  mesh.size = std::hypot(2 * std::numbers::sqrt2 * std::max(radius, radius_top), height);
  return mesh;
}

ExpectedMesh expected_sphere(double radius, double cells) {
  ExpectedMesh mesh{.vertices = 4 * cells * cells + 2, .triangles = 8 * cells * cells};
  mesh.edges = mesh.vertices + mesh.triangles - 2;
  mesh.along = mesh.across = std::numeric_limits<double>::infinity();
  // So that the triangles' areas, √3/4 of a square of the edge, cover the sphere.
  mesh.mean_edge = std::sqrt(4 * std::numbers::pi * radius * radius / mesh.triangles / 0.433);
  mesh.size = 2 * std::numbers::sqrt3 * radius;
  return mesh;
}

ExpectedMesh expected_generated(const Mesh& mesh) {
  const double width = mesh.width, height = mesh.height, radius = mesh.radius, cells = mesh.cells;
  switch (mesh.generator) {
    case Generator::grid:
      return expected_grid(width, height, cells, mesh.diagonal);
    case Generator::equilateral:
      return expected_equilateral(width, height, cells, mesh.rows.value_or(Rows::parallel));
    case Generator::delaunay:
      return expected_delaunay(width, height, cells);
    case Generator::disc:
      return expected_disc(radius, cells);
    case Generator::tube:
      return expected_tube(radius, mesh.radius_top.value_or(radius), height, cells);
    case Generator::sphere:
      return expected_sphere(radius, cells);
  }
  return {};
}

// The mesh with each triangle cut into four, so many times.
ExpectedMesh refined(ExpectedMesh mesh, std::int64_t times) {
  for (std::int64_t i = 0; i < times; ++i) {
    const double vertices = mesh.vertices + mesh.edges;
    mesh.edges = 2 * mesh.edges + 3 * mesh.triangles;
    mesh.vertices = vertices, mesh.triangles *= 4;
    mesh.along *= 2, mesh.across *= 2, mesh.mean_edge /= 2;
  }
  return mesh;
}

// How fast rings grow, from some vertices' rings. A vertex near the border has fewer in a ring than one
// inside, so the median stands for those inside.
double ring_growth(const RestMesh& rest) {
  constexpr int samples = 64, depth = 6;
  RingWalker walker(rest.one_ring());
  std::vector<double> growth;
  for (int sample = 0; sample < std::min(samples, rest.vertex_count()); ++sample) {
    walker.walk(static_cast<int>(static_cast<std::int64_t>(rest.vertex_count()) * sample / samples), depth);
    double sum = 0;
    for (int r = 2; r <= depth; ++r) sum += static_cast<double>(walker.ring(r).size()) / r / (depth - 1);
    growth.push_back(sum);
  }
  const auto middle = growth.begin() + static_cast<std::ptrdiff_t>(growth.size() / 2);
  std::nth_element(growth.begin(), middle, growth.end());
  return *middle;
}

std::optional<ExpectedMesh> measured(const RunConfig& config) try {
  const RestMesh rest(rest_mesh_of(config.scene().mesh, config.folder()).mesh);
  ExpectedMesh mesh{.vertices = static_cast<double>(rest.vertex_count()),
                    .triangles = static_cast<double>(rest.triangle_count()),
                    .edges = static_cast<double>(rest.edges().rows()),
                    .size = rest.size(),
                    .mean_edge = rest.mean_edge_length(),
                    .ring_growth = ring_growth(rest)};
  mesh.along = mesh.across = std::sqrt(mesh.vertices);
  return mesh;
} catch (const std::exception&) {
  return std::nullopt;
}

// Near enough: a pin that stands for a side has as many vertices as the mesh has edges along it.
double expected_pins(const RunConfig& config, const ExpectedMesh& mesh) {
  const Pinning& pins = config.scene().pins;
  const double ring = pins.ring;
  const double along = std::min(mesh.along, std::sqrt(mesh.vertices));
  double pinned = static_cast<double>(pins.indices.size());
  for (const Place place : pins.vertices) {
    if (place == Place::interior)
      pinned += mesh.vertices;
    else if (place == Place::centre)
      pinned += 1 + 3 * ring * (ring + 1);
    else if (place <= Place::lower_left)  // a corner
      pinned += 1 + ring * (ring + 2);
    else
      pinned += (along + 1) * (1 + ring) * (place == Place::circle ? 4 : 1);
  }
  return std::min(pinned, mesh.vertices);
}

}  // namespace

std::optional<ExpectedMesh> expected_mesh(const RunConfig& config) {
  static std::mutex mutex;
  static std::map<std::string, std::optional<ExpectedMesh>> known;  // by the settings that decide it
  const Mesh& settings = config.scene().mesh;
  const bool from_file = !config.mesh_file().empty();
  std::optional<ExpectedMesh> mesh;
  if (from_file || settings.flaw != "none") {
    const std::string key = config.folder().string() + config.resolved().at("mesh").dump();
    const std::lock_guard lock(mutex);
    const auto found = known.find(key);
    mesh = found != known.end() ? found->second : known.emplace(key, measured(config)).first->second;
  } else {
    mesh = refined(expected_generated(settings), settings.refine.value_or(0));
    const double scale = settings.scale;
    mesh->size *= scale, mesh->mean_edge *= scale;
  }
  if (!mesh || !(mesh->vertices > 0)) return std::nullopt;
  mesh->hinges = std::max(0.0, 3 * mesh->triangles - mesh->edges);
  mesh->pinned = expected_pins(config, *mesh);
  return mesh;
}

}  // namespace bendlab
