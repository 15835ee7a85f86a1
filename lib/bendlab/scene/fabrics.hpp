// Fabrics by name: measured numbers of cloth, from publications.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "bendlab/scene/scene.hpp"

namespace bendlab {

struct Fabric {
  std::string_view name;
  std::string_view description;
  double density;              ///< kg/m²
  double warp, weft;           ///< B of narrow strips along the warp and along the weft, N m
  std::optional<double> bias;  ///< B of a narrow strip at 45 degrees, N m
  double friction;             ///< HB, N; 0: not known
  double half_at;              ///< curvature at which the warp's secant rigidity is half, 1/m; 0: not known
  double thickness;            ///< m; 0: not known
  double drape;                ///< Cusick's drape coefficient, %; 0: not known
  std::string_view source;     ///< publication, table, and where the number was read
};

std::span<const Fabric> fabrics();
/// The fabric with this name, or nullptr.
const Fabric* find_fabric(std::string_view name);

/// Sets density, rigidity, friction and softening of the scene; friction and softening only if the scene's
/// bending model can have them (BendingKind::softens, yields), and friction only if the method has motion.
void apply_fabric(const Fabric& fabric, Scene& scene);

/// Units of textile laboratories in SI: 1 gf cm²/cm of rigidity in N m, and 1 gf cm/cm of moment in N.
inline constexpr double gf_cm2_per_cm = 9.80665e-5, gf_cm_per_cm = 9.80665e-3;

}  // namespace bendlab
