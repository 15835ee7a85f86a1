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
  int ring = 0;
  double distance = 0;  ///< m
};

/// How a stiffness is stated: as k of projections, as a compliance, or as a physical stiffness of the cloth.
enum class Stiffness { k, k_per_step, compliance, physical };

/// Strain constraints of the triangles: the membrane.
struct Strain {
  std::optional<StrainForm> form;  ///< absent: stvk with a youngs_modulus, otherwise angle
  Stiffness stiffness = Stiffness::physical;
  /// N/m: about that of a thin cotton pulled along its threads.
  double membrane_stiffness = 1e4;
  double warp = 1, weft = 1, shear = 1, area = 0;  ///< k
  double compliance = 0;                           ///< m/N
};

struct Material {
  double density = 0.2;  ///< kg/m²
  /// A shell of a solid: with youngs_modulus E and thickness h, settle() sets membrane_stiffness to E h and
  /// flexural_rigidity to E h³ / 12 (1 - ν²).
  std::optional<double> youngs_modulus;  ///< E, Pa
  std::optional<double> thickness;       ///< h, m
  double poisson_ratio = 0;              ///< ν
  double density_ratio = 1;
  MaterialCoordinates coordinates = MaterialCoordinates::warp;
  Vector3 warp_direction{1, 0, 0};
  Strain strain;
};

/// Where the sheet has no bending moment: in the rest shape of the mesh, or flat.
enum class RestCurvature { mesh, flat };

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
