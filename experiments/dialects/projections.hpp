// The rigidity that projections of PBD give a sheet of hinges.
//
// A projection moves the four vertices of a hinge by -s θ w ∂θ/∂x / Σ w |∂θ/∂x|², where w is the inverse mass
// and s the share of θ that it removes. The displacements Δx of the n sweeps of a time step h act as forces
// m Δx / h². In a bend that is much wider than a cell, these are the forces of hinges with the stiffness
//
//   k = n (s + s²/2) / (h² Σ w |∂θ/∂x|²).
//
// s²/2 comes from neighbours that are projected earlier in the sweep, because their corrections fold the
// hinge further. The terms in s and s² are the same for every order of projections. At s = 1 the factor is
// not 1.5 but 1.7 in the order of the mesh, and 1.2 to 1.3 in the order of colours (measured on grids and
// equilateral triangles). The formula holds for bends that swing slowly compared with h: B (2 π /
// wavelength)⁴ h² / density is far below 1. Narrower bends are stiffer than B.
#pragma once

#include <array>
#include <cmath>

#include "experiments/dialects/dialect.hpp"

namespace bendlab {

inline constexpr DialectSetting pbd_density{
    .name = "density", .unit = "kg/m²", .meaning = "the masses of all vertices, divided by the area"};
inline constexpr DialectSetting pbd_dt{.name = "dt", .unit = "s", .meaning = "the time of a substep"};
inline constexpr DialectSetting pbd_iterations{.name = "iterations",
                                               .unit = "1",
                                               .meaning = "the number of sweeps per substep",
                                               .above = 1,
                                               .may_equal = true,
                                               .whole = true};

inline constexpr std::string_view pbd_limits =
    "for bends much wider than a cell that swing slowly compared with the time step; narrower bends are "
    "stiffer. For k above a half, B also depends on the order of projections, by up to a quarter";

/// n / (h² Σ w |∂θ/∂x|²), N m.
inline double projection_stiffness(const MeshHinge& hinge, const DialectNumbers& arguments) {
  const double dt = arguments.at("dt");
  return arguments.at("iterations") * arguments.at("density") / (dt * dt * hinge.mobility);
}

/// s + s²/2, and its inverse.
inline double sweep_factor(double share) {
  return share + share * share / 2;
}
inline double share_of(double factor) {
  return std::sqrt(1 + 2 * factor) - 1;
}

}  // namespace bendlab
