// A scene: all settings of a simulation in a struct. Every setting has a default; Scene{} is a sheet of 1 m
// that hangs from a corner. `bendlab schema` prints what each setting means (scene_tables.cpp). The path to a
// member is the setting's pointer in a config: scene.mesh.cells is /mesh/cells.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bendlab/bending/calibration.hpp"
#include "bendlab/bending/models.hpp"
#include "bendlab/constraints/batches.hpp"
#include "bendlab/effects/effects.hpp"
#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/mesh/generators.hpp"
#include "bendlab/mesh/material_coordinates.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/surface.hpp"
#include "bendlab/settings/schedule.hpp"
#include "bendlab/solver/methods.hpp"

namespace bendlab {

/// The rest mesh: generated, read from a file, or given. Lengths in m.
struct Mesh {
  Generator generator = Generator::grid;
  std::optional<std::string> file;  ///< instead of a generator, relative to Scene::folder
  double width = 1, height = 1;     ///< along x and y
  int cells = 32;                   ///< along the width
  Diagonal diagonal = Diagonal::same;
  std::optional<Rows> rows;  ///< absent: parallel to a side pinned by name, if any
  double radius = 0.5;
  std::optional<double> radius_top;  ///< absent: equal to radius
  std::uint32_t seed = 1;
  std::optional<int> refine;
  std::optional<double> jitter;
  double scale = 1;
  Vector3 offset{0, 0, 0};
  std::optional<std::uint32_t> shuffle;  ///< a seed
  std::string flaw = "none";
  BadTriangles bad_triangles = BadTriangles::refuse;
  double aspect = 1;     ///< of a cell: height over width
  NamedSurface surface;  ///< the rest shape, if it is not flat
  /// A mesh that was made in C++, used instead of generator and file.
  std::shared_ptr<const TriangleMesh> given;
};

/// Which vertices are held fixed, and which are held along one axis only.
struct Pinning {
  std::vector<Place> vertices{Place::upper_right};
  std::vector<int> indices;
  std::vector<Place> hold_x, hold_y, hold_z;
  std::vector<int> hold_x_indices, hold_y_indices, hold_z_indices;
  std::vector<CoordinateAxis> symmetry;  ///< axes whose held vertices are on planes of symmetry
  int ring = 0;
  double distance = 0;  ///< m
};

/// How a stiffness is stated: as k of projections, as a compliance, or as a physical stiffness of the cloth.
enum class Stiffness { k, k_per_step, compliance, physical };

/// Factors on a number of the material by place: a value v of the map means the factor low + (high - low) v.
struct MaterialMap {
  std::optional<std::string> file;  ///< .ply with `property`, or .png; relative to Scene::folder
  std::string property;
  double low = 0, high = 1;
  bool is_given() const { return file.has_value(); }
};

/// The membrane by direction, N/m, instead of Strain::membrane_stiffness.
struct DirectedMembrane {
  std::optional<double> warp, weft;
  std::optional<double> shear;  ///< absent: √(warp weft)
  bool is_given() const { return warp || weft || shear; }
};

/// Strain constraints of the triangles: the membrane.
struct Strain {
  std::optional<StrainForm> form;  ///< absent: stvk with a youngs_modulus, otherwise angle
  Stiffness stiffness = Stiffness::physical;
  /// N/m: about that of a thin cotton pulled along its threads.
  double membrane_stiffness = 1e4;
  double warp = 1, weft = 1, shear = 1, area = 0;  ///< k
  double compliance = 0;                           ///< m/N
  DirectedMembrane membrane;
  MaterialMap map;  ///< of the membrane's stiffness
  Schedule over_time;
};

struct Material {
  std::optional<std::string> fabric;  ///< name of a fabric (fabrics.hpp), whose numbers the config got
  double density = 0.2;               ///< kg/m²
  /// A shell of a solid: with youngs_modulus E and thickness h, settle() sets membrane_stiffness to E h and
  /// flexural_rigidity to E h³ / 12 (1 - ν²).
  std::optional<double> youngs_modulus;  ///< E, Pa
  std::optional<double> thickness;       ///< h, m
  double poisson_ratio = 0;              ///< ν
  double density_ratio = 1;
  MaterialCoordinates coordinates = MaterialCoordinates::warp;
  Vector3 warp_direction{1, 0, 0};
  Strain strain;
  MaterialMap density_map;
};

/// Where the sheet has no bending moment: in the rest shape of the mesh, or flat.
enum class RestCurvature { mesh, flat };

/// The flexural rigidity by direction, N m, instead of Bending::flexural_rigidity.
struct DirectedRigidity {
  std::optional<double> warp, weft;
  std::optional<double> bias;  ///< at 45 degrees; absent: see orthotropic_rigidity()
  bool is_given() const { return warp || weft || bias; }
};

/// How the moment softens as the curvature κ grows. Secant rigidity M/κ.
struct Softening {
  std::optional<double> half_at;            ///< 1/m: the secant rigidity is half of flexural_rigidity there
  std::vector<double> curvatures, moments;  ///< 1/m and N, instead of half_at
  bool is_given() const { return half_at || !curvatures.empty() || !moments.empty(); }
};

/// Internal friction: M = B κ ± moment.
struct BendingFriction {
  std::optional<double> hb;    ///< HB, N
  std::optional<double> slip;  ///< 1/m; absent: a fifth of HB / B
  bool is_given() const { return hb || slip; }
};

/// Folds that stay.
struct BendingPlasticity {
  std::optional<double> yield_at;  ///< 1/m
  double hardening = 0;
  bool is_given() const { return yield_at.has_value(); }
};

struct Bending {
  BendingModel model = DiscreteShells{};
  RestCurvature rest_curvature = RestCurvature::mesh;
  Stiffness stiffness = Stiffness::physical;
  double k = 0.5;
  double compliance = 0;  ///< m/N or 1/(N m)
  /// N m: a light cotton. At 0.2 kg/m² this gives a bending length (B/ρg)^⅓ of 17 mm. Shirt fabrics have
  /// bending lengths of 15 to 25 mm, measured by ASTM D1388.
  std::optional<double> flexural_rigidity = 1e-5;
  std::optional<double> quartic_coefficient;  ///< N m³
  /// 1/m: the curvature at which springs have the stated rigidity; 20 is a fold of 5 cm radius.
  std::optional<double> at_curvature = 20;
  Deflection deflection = Deflection::large;
  DirectedRigidity rigidity;
  Softening softening;
  BendingFriction hysteresis;
  BendingPlasticity plasticity;
  MaterialMap map;             ///< of the flexural rigidity
  MaterialMap hysteresis_map;  ///< of hysteresis.hb
  MaterialMap plasticity_map;  ///< of plasticity.yield_at
  Schedule over_time;          ///< of all bending stiffness, with its friction
};

/// The precision that a scene states; `automatic` is single precision where that suffices, otherwise double.
enum class ChosenPrecision { automatic, single_precision, double_precision };

struct Solver {
  Method method = QuasiNewton{};
  double dt = 1.0 / 60;                     ///< s
  std::optional<int> substeps, iterations;  ///< absent: the method's own defaults
  ChosenPrecision precision = ChosenPrecision::automatic;
  int threads = 1;
};

/// The pose at time 0.
struct Initial {
  int folds = 0;
  double fold_gap = 0.01;  ///< m
  int creases = 0;
  Vector3 scale{1, 1, 1};
  double tilt = 0;                      ///< degrees
  NamedSurface surface;                 ///< the pose, instead of the rest shape
  std::optional<std::string> file;      ///< a mesh whose points are the pose, relative to Scene::folder
  double perturbation = 0, random = 0;  ///< relative to the mesh's size
  Vector3 velocity{0, 0, 0};            ///< m/s
  Vector3 spin{0, 0, 0};                ///< rad/s
  std::uint32_t seed = 1;
  /// Start at the end of an earlier scene, which is this scene with changes "/json/pointer=value".
  std::optional<std::vector<std::string>> after;
};

struct Scene {
  Mesh mesh;
  Pinning pins;
  Material material;
  Bending bending;
  Solver solver;
  std::vector<Effect> effects{Gravity{}, ViscousDrag{}};
  Initial initial;
  double duration = 4;           ///< s, of a run
  std::filesystem::path folder;  ///< files are relative to it; empty: the working directory
};

/// A sheet of squares, each split by a diagonal: width by height (m), with `cells` squares along the width.
Mesh grid(double width, double height, int cells, Diagonal diagonal = Diagonal::same);

}  // namespace bendlab
