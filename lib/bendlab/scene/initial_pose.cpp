#include "bendlab/scene/initial_pose.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

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

Positions folded_rest_shape(const Initial& initial, const RestMesh& rest) {
  if (initial.surface.is_given()) {
    if (initial.folds > 0 || initial.creases > 0)
      throw ConfigError("initial pose",
                        {{"/initial/surface/shape",
                          "cannot be combined with /initial/folds or /initial/creases: set these "
                          "to 0"}});
    try {
      return on_surface(initial.surface, rest.named_positions());
    } catch (const std::invalid_argument& error) {
      throw ConfigError("initial pose", {{"/initial/surface/shape", error.what()}});
    }
  }
  if (initial.folds > 0 && initial.creases > 0)
    throw ConfigError("initial pose", {{"/initial/creases",
                                        "cannot be combined with /initial/folds: set one of these "
                                        "settings to 0"}});
  if (initial.folds > 0) return folded(rest, initial.folds, initial.fold_gap);
  return initial.creases > 0 ? creased(rest, initial.creases) : rest.positions();
}

Positions tilted(const Positions& positions, const Vector3& centre, double degrees) {
  if (degrees == 0) return positions;
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vector3::UnitX()).toRotationMatrix();
  return ((positions.rowwise() - centre.transpose()) * rotation.transpose()).rowwise() + centre.transpose();
}

// Stretches free vertices, relative to the mean of the seeds of the pins, or to the centre without pins.
void scale(Positions& positions, const Vector3& factor, const RestMesh& rest, const Pins& pins) {
  if (factor == Vector3::Ones()) return;
  Vector3 about = pins.seeds.empty() ? rest.centre() : Vector3::Zero();
  for (const int seed : pins.seeds)
    about += positions.row(seed).transpose() / static_cast<double>(pins.seeds.size());
  for (int v = 0; v < rest.vertex_count(); ++v)
    if (!pins.pinned(v)) positions.row(v) = about + factor.cwiseProduct(positions.row(v).transpose() - about);
}

// A vector with components uniform in [-1, 1].
Vector3 uniform_vector(std::mt19937_64& generator) {
  const double x = 2 * uniform(generator) - 1, y = 2 * uniform(generator) - 1, z = 2 * uniform(generator) - 1;
  return {x, y, z};
}

}  // namespace

Positions initial_positions(const Initial& initial, const RestMesh& rest, const Pins& pins) {
  Positions positions = tilted(folded_rest_shape(initial, rest), rest.centre(), initial.tilt);
  scale(positions, initial.scale, rest, pins);
  const double box = initial.random * rest.size(), amplitude = initial.perturbation * rest.size();
  if (box == 0 && amplitude == 0) return positions;
  std::mt19937_64 generator(initial.seed);
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const Vector3 random = uniform_vector(generator);
    if (pins.pinned(v)) continue;
    if (box > 0)
      positions.row(v) = rest.centre() + 0.5 * box * random;
    else
      // std::fma, because otherwise rounding depends on whether the compiler fuses multiply and add.
      for (int i = 0; i < 3; ++i) positions(v, i) = std::fma(amplitude, random[i], positions(v, i));
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
