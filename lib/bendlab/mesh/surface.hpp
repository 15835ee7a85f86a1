// Surfaces with closed formulas, as rest shapes and poses: the coordinates of a flat mesh become points of
// the surface.
#pragma once

#include <array>
#include <string_view>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

enum class SurfaceShape {
  none,
  cylinder,
  annulus,
  helix,       ///< tangent developable of a helix
  helix_flat,  ///< the same surface, developed into the plane
  torus,       ///< the half of its tube with z above 0
  sphere,
  dome,
  twist,
  vee,
};
inline constexpr std::array<std::string_view, 10> surface_shape_names = {
    "none", "cylinder", "annulus", "helix", "helix_flat", "torus", "sphere", "dome", "twist", "vee"};

/// scene_tables.cpp says what the numbers mean for each shape.
struct NamedSurface {
  SurfaceShape shape = SurfaceShape::none;
  double radius = 1, inner_radius = 0.5, pitch = 1, ruling = 1;       ///< m
  double direction = 0, sweep = 360, polar_from = 0, polar_to = 180;  ///< degrees

  bool is_given() const { return shape != SurfaceShape::none; }
};

/// #V by 3, m: the vertices of a flat mesh (in the x-y plane) or of a tube along z, as points of the surface.
/// The width of a tube is its circumference. Throws std::invalid_argument if the mesh has no width or height
/// to map.
Positions on_surface(const NamedSurface& surface, const Positions& flat);

}  // namespace bendlab
