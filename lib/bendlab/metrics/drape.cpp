#include "bendlab/metrics/drape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace bendlab {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int directions = 3600;

struct Areas {
  double table = 0, specimen = 0;  // m²
  Vector3 centre = Vector3::Zero();
};

Areas areas_of(const RestMesh& rest, const Pins& pins) {
  Areas areas;
  for (int t = 0; t < rest.triangle_count(); ++t) {
    const auto corner = rest.triangles().row(t);
    const double area = rest.areas()[static_cast<std::size_t>(t)];
    areas.specimen += area;
    if (!pins.pinned(corner(0)) || !pins.pinned(corner(1)) || !pins.pinned(corner(2))) continue;
    areas.table += area;
    for (int c = 0; c < 3; ++c) areas.centre += area / 3 * rest.position(corner(c));
  }
  if (!(areas.table > 0))
    throw std::invalid_argument(
        "drape: no triangle is pinned, but the pinned triangles are the table: pin the centre, with "
        "/pins/distance equal to the table's radius");
  if (!(areas.table < areas.specimen))
    throw std::invalid_argument(
        "drape: all triangles are pinned, so no cloth hangs over the table: pin fewer vertices");
  areas.centre /= areas.table;
  return areas;
}

// reach[k] is the distance from the origin to the outline in direction k. Extends the reach up to the segment
// from `a` to `b`, in all directions that cross that segment.
void extend(std::vector<double>& reach, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double per_direction = 2 * pi / directions, start = std::atan2(a.y(), a.x());
  const double turn = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  const double low = std::min(start, start + turn), high = std::max(start, start + turn);
  for (double k = std::ceil(low / per_direction); k * per_direction <= high; ++k) {
    const Eigen::Vector2d direction(std::cos(k * per_direction), std::sin(k * per_direction)), along = b - a;
    const double across = along.x() * direction.y() - along.y() * direction.x();
    // If the line of the segment passes through the origin, rounding errors may put the crossing anywhere.
    const double crossing = across == 0 ? 0 : (a.y() * direction.x() - a.x() * direction.y()) / across;
    const double share = std::clamp(crossing, 0.0, 1.0);
    const double distance = (a + share * along).dot(direction);
    const auto at = static_cast<std::size_t>((static_cast<long>(k) % directions + directions) % directions);
    reach[at] = std::max(reach[at], distance);
  }
}

// The number of maxima of `reach` that are more than `depth` above the minima next to them.
int maxima(const std::vector<double>& reach, double depth) {
  const auto lowest = static_cast<std::size_t>(std::min_element(reach.begin(), reach.end()) - reach.begin());
  int count = 0;
  bool rising = true;
  double extreme = reach[lowest];
  for (std::size_t i = 1; i <= reach.size(); ++i) {
    const double r = reach[(lowest + i) % reach.size()];
    if (rising ? r > extreme : r < extreme) extreme = r;
    if (rising && r < extreme - depth) ++count, rising = false, extreme = r;
    if (!rising && r > extreme + depth) rising = true, extreme = r;
  }
  return count;
}

}  // namespace

Drape drape_of(const RestMesh& rest, const Pins& pins, const Positions& positions, const Vector3& down) {
  const Areas areas = areas_of(rest, pins);
  const Vector3 right = down.unitOrthogonal(), ahead = down.cross(right);
  Drape drape{.reach = std::vector<double>(directions, 0.0)};
  const auto projected = [&](int vertex) -> Eigen::Vector2d {
    const Vector3 offset = positions.row(vertex).transpose() - areas.centre;
    return {offset.dot(right), offset.dot(ahead)};
  };
  for (int e = 0; e < rest.edges().rows(); ++e)
    extend(drape.reach, projected(rest.edges()(e, 0)), projected(rest.edges()(e, 1)));
  double shadow = 0, mean = 0;
  for (const double r : drape.reach) shadow += pi / directions * r * r, mean += r / directions;
  drape.coefficient = (shadow - areas.table) / (areas.specimen - areas.table);
  drape.folds = maxima(drape.reach, 0.02 * mean);
  return drape;
}

}  // namespace bendlab
