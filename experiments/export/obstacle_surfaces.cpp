#include "experiments/export/obstacle_surfaces.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bendlab/effects/obstacle.hpp"
#include "bendlab/mesh/files.hpp"
#include "experiments/scene/scene.hpp"

namespace bendlab {
namespace {

using obstacle::direction_of;
using obstacle::vector_of;

constexpr int around = 96;        // corners on a circle
constexpr int quarter = 24;       // edges on a quarter of an arc
constexpr double plane_size = 4;  // of the cloth's size

/// What a shape is made from.
struct ShapeInput {
  const ParameterValues& values;
  const InputFile* file;  // null: the run file does not have it
  Vector3 centre;         // of the cloth's rest box, m
  double size;            // of it, m
};

/// A point of a profile: its distance from the axis, its height along it.
using ProfilePoint = std::array<double, 2>;

// From one angle to another, both in quarters of a turn; 0 is the equator.
std::vector<ProfilePoint> arc(double radius, int first, int last) {
  std::vector<ProfilePoint> points;
  for (int i = first * quarter; i <= last * quarter; ++i) {
    const double angle = std::numbers::pi / 2 * i / quarter;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return points;
}

// The surface of revolution of a profile from bottom to top, closed at both ends on the axis: between them
// each point is a ring of corners. Normals point outward.
TriangleMesh revolved(const std::vector<ProfilePoint>& profile, const Vector3& origin, const Vector3& axis) {
  const Vector3 right = axis.unitOrthogonal(), forward = axis.cross(right);
  const int rings = static_cast<int>(profile.size()) - 2, bottom = rings * around, top = bottom + 1;
  TriangleMesh mesh{Positions(top + 1, 3), Triangles(2 * around * rings, 3), {}};
  mesh.positions.row(bottom) = origin + profile.front()[1] * axis;
  mesh.positions.row(top) = origin + profile.back()[1] * axis;
  int t = 0;
  for (int ring = 0; ring < rings; ++ring)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      const auto [radius, height] = profile[static_cast<std::size_t>(ring) + 1];
      const int here = ring * around + i, beside = ring * around + (i + 1) % around;
      mesh.positions.row(here) =
          origin + radius * (std::cos(angle) * right + std::sin(angle) * forward) + height * axis;
      if (ring == 0) mesh.triangles.row(t++) << bottom, beside, here;
      if (ring == rings - 1) {
        mesh.triangles.row(t++) << here, beside, top;
      } else {
        mesh.triangles.row(t++) << here, beside, beside + around;
        mesh.triangles.row(t++) << here, beside + around, here + around;
      }
    }
  return mesh;
}

TriangleMesh sphere_surface(const ShapeInput& input) {
  return revolved(arc(input.values.number("radius"), -1, 1), vector_of(input.values, "centre"),
                  Vector3::UnitZ());
}

TriangleMesh capsule_surface(const ShapeInput& input) {
  const Vector3 a = vector_of(input.values, "a"), along = vector_of(input.values, "b") - a;
  const double radius = input.values.number("radius");
  std::vector<ProfilePoint> profile = arc(radius, -1, 0);
  for (const auto& [distance, height] : arc(radius, 0, 1))
    profile.push_back({distance, height + along.norm()});
  return revolved(profile, a, along.normalized());
}

// A flat top and bottom, and half a circle as rim.
TriangleMesh disc_surface(const ShapeInput& input) {
  const double half_height = input.values.number("height") / 2,
               flat = input.values.number("radius") - half_height;
  std::vector<ProfilePoint> profile = {{0, -half_height}};
  for (const auto& [distance, height] : arc(half_height, -1, 1)) profile.push_back({flat + distance, height});
  profile.push_back({0, half_height});
  return revolved(profile, vector_of(input.values, "centre"), direction_of(input.values, "axis"));
}

TriangleMesh plane_surface(const ShapeInput& input) {
  const Vector3 normal = direction_of(input.values, "normal"), point = vector_of(input.values, "point");
  const Vector3 right = normal.unitOrthogonal(), forward = normal.cross(right),
                middle = input.centre - normal.dot(input.centre - point) * normal;
  const double half = plane_size * input.size / 2;
  TriangleMesh mesh{Positions(4, 3), Triangles(2, 3), {}};
  mesh.positions << (middle - half * (right + forward)).transpose(),
      (middle + half * (right - forward)).transpose(), (middle + half * (right + forward)).transpose(),
      (middle + half * (forward - right)).transpose();
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return mesh;
}

TriangleMesh mesh_surface(const ShapeInput& input) {
  if (!input.file)
    throw std::invalid_argument(
        fmt::format("the run file, of an older version, does not hold '{}'", input.values.text("file")));
  TriangleMesh mesh =
      accept(parse_polygon_soup(input.file->name, input.file->bytes), BadTriangles::refuse).mesh;
  mesh.positions *= input.values.number("scale");
  mesh.positions.rowwise() += vector_of(input.values, "offset").transpose();
  return mesh;
}

struct Shape {
  std::string_view effect;
  TriangleMesh (*surface)(const ShapeInput&);
};

constexpr std::array shapes = {Shape{"plane", plane_surface}, Shape{"sphere", sphere_surface},
                               Shape{"capsule", capsule_surface}, Shape{"disc", disc_surface},
                               Shape{"mesh_obstacle", mesh_surface}};

}  // namespace

std::vector<Surface> obstacle_surfaces(const std::vector<EffectSettings>& effects,
                                       const std::vector<InputFile>& inputs, const Vector3& centre,
                                       double size, std::vector<std::string>& notes) {
  std::vector<Surface> surfaces;
  for (std::size_t index = 0; index < effects.size(); ++index) {
    const EffectSettings& effect = effects[index];
    const auto shape = std::ranges::find(shapes, effect.type, &Shape::effect);
    if (shape == shapes.end()) continue;
    Surface surface{.name = pass_name(effects, index)};
    std::ranges::replace(surface.name, ' ', '_');
    const auto file = std::ranges::find(inputs, fmt::format("/effects/{}/file", index), &InputFile::pointer);
    try {
      TriangleMesh mesh =
          shape->surface({effect.values, file == inputs.end() ? nullptr : &*file, centre, size});
      surface.positions = std::move(mesh.positions);
      surface.triangles = std::move(mesh.triangles);
    } catch (const std::exception& error) {
      notes.push_back(fmt::format("{} is left out: {}", surface.name, error.what()));
      continue;
    }
    surface.velocity = vector_of(effect.values, "velocity");
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

}  // namespace bendlab
