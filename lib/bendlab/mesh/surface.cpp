#include "bendlab/mesh/surface.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

namespace bendlab {
namespace {

constexpr double pi = std::numbers::pi;

double radians(double degrees) {
  return degrees * pi / 180;
}

// The coordinates of a mesh along its width (around a tube) and its height, from 0 to 1.
struct Parameters {
  std::function<Vector2(const Vector3&)> of;
  Vector3 centre, extent;
  bool is_tube = false;

  explicit Parameters(const Positions& flat) {
    const Vector3 low = flat.colwise().minCoeff(), high = flat.colwise().maxCoeff();
    centre = 0.5 * (low + high), extent = high - low;
    constexpr double thin = 1e-6;
    is_tube = extent.z() > thin * extent.norm();
    if (!is_tube) {
      if (!(extent.x() > 0 && extent.y() > 0))
        throw std::invalid_argument("a surface needs a mesh that has an extent along x and along y");
      of = [low, size = extent](const Vector3& p) {
        return Vector2((p.x() - low.x()) / size.x(), (p.y() - low.y()) / size.y());
      };
    } else {
      of = [low, size = extent, middle = centre](const Vector3& p) {
        const double angle = std::atan2(p.y() - middle.y(), p.x() - middle.x()) / (2 * pi);
        return Vector2(angle < 0 ? angle + 1 : angle, (p.z() - low.z()) / size.z());
      };
    }
  }
};

Vector3 turned_about_x(const Vector3& p, double angle) {
  return {p.x(), std::cos(angle) * p.y() - std::sin(angle) * p.z(),
          std::sin(angle) * p.y() + std::cos(angle) * p.z()};
}

// A point of the surface. `p` is relative to the centre of the mesh, and `uv` its coordinates from 0 to 1.
Vector3 point_of(const NamedSurface& s, const Vector3& p, const Vector2& uv, const Vector3& extent,
                 bool is_tube) {
  const double sweep = radians(s.sweep);
  switch (s.shape) {
    case SurfaceShape::none:
      break;
    case SurfaceShape::cylinder: {
      if (is_tube) {
        const double around = 2 * pi * uv.x();
        return {s.radius * std::cos(around), s.radius * std::sin(around), p.z()};
      }
      const double c = std::cos(radians(s.direction)), sine = std::sin(radians(s.direction));
      const double along = c * p.x() + sine * p.y(), across = -sine * p.x() + c * p.y(),
                   turn = along / s.radius;
      const double x = s.radius * std::sin(turn), z = s.radius * (1 - std::cos(turn));
      return {c * x - sine * across, sine * x + c * across, z};
    }
    case SurfaceShape::annulus: {
      const double r = s.inner_radius + uv.y() * (s.radius - s.inner_radius), angle = uv.x() * sweep;
      return {r * std::cos(angle), r * std::sin(angle), 0};
    }
    // The tangent developable x(a) + y x'(a) of the helix x, with y from the ruling to twice the ruling,
    // divided by the radius.
    case SurfaceShape::helix: {
      const double a = 2 * pi * uv.x(), y = s.ruling / s.radius * (1 + uv.y());
      return {s.radius * (std::cos(a) - y * std::sin(a)), s.radius * (std::sin(a) + y * std::cos(a)),
              s.pitch * (a + y) / (2 * pi)};
    }
    // In the plane the helix becomes a circle of the same curvature.
    case SurfaceShape::helix_flat: {
      const double a = 2 * pi * uv.x(), y = s.ruling / s.radius * (1 + uv.y()),
                   speed = std::hypot(s.radius, s.pitch / (2 * pi)), circle = speed * speed / s.radius,
                   angle = a * speed / circle;
      return {circle * std::cos(angle) - y * speed * std::sin(angle),
              circle * std::sin(angle) + y * speed * std::cos(angle), 0};
    }
    case SurfaceShape::torus: {
      const double around = 2 * pi * uv.x(), tube = pi * uv.y(),
                   r = s.radius + s.inner_radius * std::cos(tube);
      return {r * std::cos(around), r * std::sin(around), s.inner_radius * std::sin(tube)};
    }
    case SurfaceShape::sphere: {
      const double off = radians(s.polar_from + uv.y() * (s.polar_to - s.polar_from)),
                   around = uv.x() * sweep;
      return {s.radius * std::sin(off) * std::cos(around), s.radius * std::sin(off) * std::sin(around),
              s.radius * std::cos(off)};
    }
    case SurfaceShape::dome: {
      const double distance = std::hypot(p.x(), p.y()),
                   off = radians(s.polar_to) * distance / (0.5 * extent.x());
      if (distance == 0) return {0, 0, s.radius};
      const double r = s.radius * std::sin(off) / distance;
      return {r * p.x(), r * p.y(), s.radius * std::cos(off)};
    }
    case SurfaceShape::twist:
      return turned_about_x(p, (uv.x() - 1) * sweep);
    case SurfaceShape::vee:
      if (p.x() <= 0) return p;
      return {p.x() * std::cos(sweep), p.y(), p.x() * std::sin(sweep)};
  }
  return p;
}

}  // namespace

Positions on_surface(const NamedSurface& surface, const Positions& flat) {
  if (!surface.is_given()) return flat;
  const Parameters parameters(flat);
  Positions points(flat.rows(), 3);
  for (Eigen::Index v = 0; v < flat.rows(); ++v) {
    const Vector3 p = flat.row(v).transpose();
    points.row(v) =
        point_of(surface, p - parameters.centre, parameters.of(p), parameters.extent, parameters.is_tube)
            .transpose();
  }
  return points;
}

}  // namespace bendlab
