#include "bendlab/bending/directed_rigidity.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace bendlab {

double OrthotropicRigidity::cylinder(const Vector2& d) const {
  const double c = d.x() * d.x(), s = d.y() * d.y();
  return warp * c * c + 2 * (coupling + 2 * twist) * c * s + weft * s * s;
}

double OrthotropicRigidity::strip(const Vector2& d) const {
  const double c = d.x() * d.x(), s = d.y() * d.y(), determinant = warp * weft - coupling * coupling;
  return 1 / ((weft * c * c + warp * s * s - 2 * coupling * c * s) / determinant + c * s / twist);
}

// The means of c⁴, c² s² and s⁴ are 3/8, 1/8 and 3/8.
double OrthotropicRigidity::mean() const {
  return (3 * warp + 2 * (coupling + 2 * twist) + 3 * weft) / 8;
}

double OrthotropicRigidity::product(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
  return warp * a(0) * b(0) + weft * a(1) * b(1) + coupling * (a(0) * b(1) + a(1) * b(0)) +
         twist * a(2) * b(2);
}

OrthotropicRigidity orthotropic_rigidity(double warp, double weft, std::optional<double> bias,
                                         double poisson_ratio) {
  const double middle = std::sqrt(warp * weft), plane = 1 - poisson_ratio * poisson_ratio;
  OrthotropicRigidity d{warp / plane, weft / plane, poisson_ratio * middle / plane, 0};
  if (!bias) {
    d.twist = 0.5 * (std::sqrt(d.warp * d.weft) - d.coupling);
    return d;
  }
  const double others = 1 / warp + 1 / weft - 2 * poisson_ratio / middle;  // S11 + S22 + 2 S12
  const double twist = 4 / *bias - others;                                 // S66
  if (!(twist > 0))
    throw std::invalid_argument(
        fmt::format("no sheet has such a bias: with warp {:.4g}, weft {:.4g} and a Poisson's ratio of "
                    "{:.4g}, a strip at 45 "
                    "degrees has a rigidity below {:.4g} N m; leave the bias out, or measure it again",
                    warp, weft, poisson_ratio, 4 / others));
  d.twist = 1 / twist;
  return d;
}

std::vector<Vector3> warp_axes(const TriangleMesh& mesh, const std::vector<InverseRest>& coordinates) {
  std::vector<Vector3> axes;
  for (Eigen::Index t = 0; t < mesh.triangle_count(); ++t) {
    const InverseRest& q = coordinates[static_cast<std::size_t>(t)];
    const auto p = [&](int corner) -> Vector3 {
      return mesh.positions.row(mesh.triangles(t, corner)).transpose();
    };
    axes.push_back((q[0] * (p(1) - p(0)) + q[2] * (p(2) - p(0))).normalized());
  }
  return axes;
}

void AxisSum::add(const Vector2& axis, double weight) {
  const double squared = axis.squaredNorm();
  if (!(squared > 0)) return;
  sum_ += weight / squared * Vector2(axis.x() * axis.x() - axis.y() * axis.y(), 2 * axis.x() * axis.y());
  weight_ += weight;
}

Vector2 AxisSum::mean() const {
  if (!(sum_.norm() > 1e-12 * weight_)) return {1, 0};
  const double angle = 0.5 * std::atan2(sum_.y(), sum_.x());
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace bendlab
