#include "bendlab/mesh/near_points.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {
namespace {

using Cell = std::array<std::int64_t, 3>;

// The points that are not replaced by another point, sorted into the cells of a grid.
class Cells {
 public:
  Cells(const std::vector<std::array<double, 3>>& points, const Vector3& origin, double tolerance)
      : points_(points), origin_(origin), tolerance_(tolerance) {}

  void add(std::size_t p) { points_in_[cell_of(at(p))].push_back(p); }

  // The point in the grid that is nearest to p, or p if none is within the tolerance; ties go to the first.
  std::size_t nearest(std::size_t p) const {
    const Cell low = cell_of(at(p).array() - tolerance_), high = cell_of(at(p).array() + tolerance_);
    std::size_t best = p;
    double least = tolerance_;
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const auto cell = points_in_.find({x, y, z});
          if (cell == points_in_.end()) continue;
          for (const std::size_t other : cell->second) {
            const double distance = (at(other) - at(p)).norm();
            if (best == p ? distance > least : distance >= least) continue;
            best = other, least = distance;
          }
        }
    return best;
  }

 private:
  Vector3 at(std::size_t p) const { return Eigen::Map<const Vector3>(points_[p].data()); }

  // A cell is 32 tolerances wide, so most searches look into only one cell.
  Cell cell_of(const Vector3& p) const {
    const double size = tolerance_ > 0 ? 32 * tolerance_ : 1;
    Cell cell;
    for (std::size_t i = 0; i < 3; ++i)
      cell[i] = static_cast<std::int64_t>(
          std::floor((p(static_cast<Eigen::Index>(i)) - origin_(static_cast<Eigen::Index>(i))) / size));
    return cell;
  }

  const std::vector<std::array<double, 3>>& points_;
  Vector3 origin_;
  double tolerance_;
  std::map<Cell, std::vector<std::size_t>> points_in_;
};

}  // namespace

std::vector<std::size_t> near_points(const std::vector<std::array<double, 3>>& points,
                                     const std::vector<char>& used, double tolerance) {
  std::vector<std::size_t> same_as(points.size());
  std::iota(same_as.begin(), same_as.end(), std::size_t{0});
  Eigen::AlignedBox3d box;
  for (std::size_t p = 0; p < points.size(); ++p)
    if (used[p] != 0) box.extend(Eigen::Map<const Vector3>(points[p].data()));
  // Cell indices of huge coordinates would not fit into 64 bits. The caller refuses a mesh with such
  // coordinates.
  if (box.isEmpty() || !std::isfinite(tolerance) ||
      !(box.diagonal().maxCoeff() < 1e15 * std::max(tolerance, 1.0)))
    return same_as;
  Cells cells(points, box.min(), tolerance);
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (used[p] == 0) continue;
    same_as[p] = cells.nearest(p);
    if (same_as[p] == p) cells.add(p);
  }
  return same_as;
}

}  // namespace bendlab
