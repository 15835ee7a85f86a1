#include "bendlab/scene/initial_pose.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "bendlab/mesh/files.hpp"
#include "bendlab/mesh/surface.hpp"
#include "bendlab/scene/counted.hpp"
#include "bendlab/scene/strict_json.hpp"
#include "bendlab/settings/random_numbers.hpp"

namespace bendlab {
namespace {

// The sheet folded back and forth along x: layers of equal width, joined by half circles of diameter `gap`.
Positions folded(const RestMesh& rest, int folds, double gap) {
  const double width = (rest.box_max() - rest.box_min()).x(), turn = 0.5 * std::numbers::pi * gap;
  const double layer = (width - folds * turn) / (folds + 1);
  if (layer <= 0)
    throw ConfigError("initial pose",
                      {{"/initial/fold_gap",
                        fmt::format("the half circles of {} with a gap of {} m need {:.3g} m, but the sheet "
                                    "is {:.3g} m wide: use fewer folds or a smaller gap",
                                    counted(folds, "fold"), gap, folds * turn, width)}});
  Positions positions = rest.positions();
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const double along = positions(v, 0) - rest.box_min().x();
    const int below = std::min(folds, static_cast<int>(along / (layer + turn)));
    const double within = along - below * (layer + turn);  // position in a layer and the half circle after it
    const double angle = std::max(0.0, within - layer) / (0.5 * gap);
    const double to_the_right = std::min(within, layer) - 0.5 * layer + 0.5 * gap * std::sin(angle);
    positions(v, 0) = rest.centre().x() + (below % 2 == 0 ? to_the_right : -to_the_right);
    positions(v, 2) += below * gap + 0.5 * gap * (1 - std::cos(angle));
  }
  return positions;
}

// The sheet folded like a fan along x: strips of equal width lie exactly on top of each other.
Positions creased(const RestMesh& rest, int creases) {
  const double column = (rest.box_max() - rest.box_min()).x() / (creases + 1);
  Positions positions = rest.positions();
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const double along = (positions(v, 0) - rest.box_min().x()) / column;
    const double within = along - 2 * std::floor(0.5 * along);  // going there and back takes 2 columns
    positions(v, 0) = rest.centre().x() + (std::min(within, 2 - within) - 0.5) * column;
  }
  return positions;
}

[[noreturn]] void refuse(const char* pointer, const std::string& message) {
  throw ConfigError("initial pose", {{pointer, message}});
}

// The points of a mesh file, which has to have the rest mesh's triangles.
Positions positions_of_file(const std::filesystem::path& path, const RestMesh& rest) {
  const auto refuse_file = [&](const std::string& what) {
    refuse("/initial/file",
           fmt::format("'{}' {}; remove the setting, or write the pose with the numbering of "
                       "the rest mesh",
                       path.string(), what));
  };
  const PolygonSoup soup = read_polygon_soup(path);
  const auto is_vertex = [&](std::int64_t v) { return v >= 0 && std::cmp_less(v, soup.points.size()); };
  for (const auto& triangle : soup.triangles)
    if (!std::ranges::all_of(triangle, is_vertex))
      refuse_file("has a triangle that names a vertex which is not in the file");
  if (!std::ranges::all_of(soup.points, is_finite<std::array<double, 3>>))
    refuse_file("has a coordinate that is not finite");
  const TriangleMesh pose = to_mesh(soup);
  if (pose.positions.rows() != rest.vertex_count() || pose.triangles.rows() != rest.triangle_count())
    refuse_file(fmt::format("has {} points and {} triangles, but the rest mesh has {} and {}",
                            pose.positions.rows(), pose.triangles.rows(), rest.vertex_count(),
                            rest.triangle_count()));
  for (Eigen::Index t = 0; t < pose.triangles.rows(); ++t)
    if (pose.triangles.row(t) != rest.triangles().row(t))
      refuse_file(fmt::format("has a triangle {} with other vertices than in the rest mesh", t));
  return pose.positions;
}

// The pose before it is turned and stretched.
Positions stated_pose(const Initial& initial, const RestMesh& rest, const std::filesystem::path& folder) {
  const std::array<std::pair<const char*, bool>, 4> stated{{{"/initial/file", initial.file.has_value()},
                                                            {"/initial/surface", initial.surface.is_given()},
                                                            {"/initial/folds", initial.folds > 0},
                                                            {"/initial/creases", initial.creases > 0}}};
  const auto is_stated = [](const auto& pose) { return pose.second; };
  const auto first = std::ranges::find_if(stated, is_stated);
  if (first == stated.end()) return rest.positions();
  if (const auto second = std::find_if(first + 1, stated.end(), is_stated); second != stated.end())
    refuse(second->first,
           fmt::format("cannot be combined with {}: remove one of these settings", first->first));
  if (initial.file) return positions_of_file(folder / *initial.file, rest);
  if (initial.folds > 0) return folded(rest, initial.folds, initial.fold_gap);
  if (initial.creases > 0) return creased(rest, initial.creases);
  try {
    const Positions& flat = rest.named_positions();
    const Eigen::RowVector3d centre = 0.5 * (flat.colwise().minCoeff() + flat.colwise().maxCoeff());
    return on_surface(initial.surface, flat).rowwise() + centre;
  } catch (const std::invalid_argument& error) {
    refuse("/initial/surface/shape", error.what());
  }
}

Positions tilted(const Positions& positions, const Vector3& centre, double degrees) {
  if (degrees == 0) return positions;
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vector3::UnitX()).toRotationMatrix();
  return ((positions.rowwise() - centre.transpose()) * rotation.transpose()).rowwise() + centre.transpose();
}

// Whether a vertex keeps its coordinate along an axis.
bool is_held(const Pins& pins, int v, int axis) {
  return pins.pinned(v) || (!pins.held.empty() && (pins.held[static_cast<std::size_t>(v)] >> axis & 1) != 0);
}

// Stretches free vertices, relative to the mean of the seeds of the pins, or to the centre without pins.
void scale(Positions& positions, const Vector3& factor, const RestMesh& rest, const Pins& pins) {
  if (factor == Vector3::Ones()) return;
  Vector3 about = pins.seeds.empty() ? rest.centre() : Vector3::Zero();
  for (const int seed : pins.seeds)
    about += positions.row(seed).transpose() / static_cast<double>(pins.seeds.size());
  for (int v = 0; v < rest.vertex_count(); ++v)
    for (int i = 0; i < 3; ++i)
      if (!is_held(pins, v, i)) positions(v, i) = about[i] + factor[i] * (positions(v, i) - about[i]);
}

// A vector with components uniform in [-1, 1].
Vector3 uniform_vector(std::mt19937_64& generator) {
  const double x = 2 * uniform(generator) - 1, y = 2 * uniform(generator) - 1, z = 2 * uniform(generator) - 1;
  return {x, y, z};
}

}  // namespace

Positions initial_positions(const Initial& initial, const RestMesh& rest, const Pins& pins,
                            const std::filesystem::path& folder) {
  Positions positions = tilted(stated_pose(initial, rest, folder), rest.centre(), initial.tilt);
  scale(positions, initial.scale, rest, pins);
  const double box = initial.random * rest.size(), amplitude = initial.perturbation * rest.size();
  if (box == 0 && amplitude == 0) return positions;
  std::mt19937_64 generator(initial.seed);
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const Vector3 random = uniform_vector(generator);
    for (int i = 0; i < 3; ++i) {
      if (is_held(pins, v, i)) continue;
      // std::fma, because otherwise rounding depends on whether the compiler fuses multiply and add.
      positions(v, i) = box > 0 ? rest.centre()[i] + 0.5 * box * random[i]
                                : std::fma(amplitude, random[i], positions(v, i));
    }
  }
  return positions;
}

Positions initial_velocities(const Initial& initial, const Positions& positions, const Vector3& centre) {
  const Vector3 &velocity = initial.velocity, &spin = initial.spin;
  if (velocity.isZero(0) && spin.isZero(0)) return {};
  Positions velocities(positions.rows(), 3);
  for (Eigen::Index v = 0; v < positions.rows(); ++v)
    velocities.row(v) = velocity + spin.cross(positions.row(v).transpose() - centre);
  return velocities;
}

}  // namespace bendlab
