// SimulationInput: what a solver method (methods.hpp) gets from a scene. Simulation: what a method returns.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/constraints/directors.hpp"
#include "bendlab/constraints/effective_stiffness.hpp"
#include "bendlab/constraints/kinds.hpp"
#include "bendlab/constraints/own_elements.hpp"
#include "bendlab/constraints/state.hpp"
#include "bendlab/mesh/triangle_mesh.hpp"
#include "bendlab/settings/archive.hpp"
#include "bendlab/settings/family.hpp"
#include "bendlab/settings/schedule.hpp"

namespace bendlab {

struct MethodKind;
/// A solver method with its settings: `Method method = QuasiNewton{.history = 8};`
using Method = Chosen<MethodKind>;

/// Settings that several methods read.
struct SolverSettings {
  double dt = 1.0 / 60;  ///< s
  int substeps = 1;
  int iterations = 10;  ///< per substep
  int threads = 1;
};

/// Where the first pose of a simulation comes from.
enum class StartingFrom {
  scene,       ///< made by the scene: rest shape, folds, …
  other_mesh,  ///< the end of a run on another mesh of the same cloth
  same_mesh,   ///< the end of a run on this mesh
};

struct StrainStiffness {
  StrainForm form = StrainForm::normalised;
  StiffnessKind kind = StiffnessKind::k;
  double warp = 1, weft = 1, shear = 1, area = 0;  ///< k in [0, 1]
  double compliance = 0;                           ///< m/N
  std::array<double, 3> softness = {1, 1, 1};      ///< of warp, weft and shear, times the compliance

  double largest_softness() const { return *std::max_element(softness.begin(), softness.end()); }
};

/// Factors on the stiffness of the membrane and of bending at a time.
struct StiffnessFactors {
  double strain = 1, bending = 1;
  bool operator==(const StiffnessFactors&) const = default;
};

struct BendingStiffness {
  StiffnessKind kind = StiffnessKind::k;
  double k = 0.5;         ///< in [0, 1]
  double compliance = 0;  ///< springs: m/N; elements: the unit that the model's softness implies
};

/// The input of a method, made from a scene.
struct SimulationInput {
  Method method;
  Positions positions;   ///< #V by 3, m: where the cloth starts
  Positions velocities;  ///< #V by 3, m/s, or empty: at rest
  Positions rest;        ///< #V by 3, m: collapsed elements open towards it; empty: they do not open
  Vector3 origin = Vector3::Zero();  ///< coordinates are kept relative to it, m
  double size = 1;  ///< of the rest shape, m: a vertex farther than 10⁶ sizes away means divergence
  std::vector<double> mass;     ///< #V, kg
  std::vector<char> is_pinned;  ///< #V
  std::vector<char> held;       ///< #V or #P: see Pins::held and Directors::held; MethodKind::holds_axes
  std::vector<int> permutation;  ///< #V, each vertex's index in the solver's arrays; empty: no change

  StrainConstraints strain;
  DistanceConstraints edges;  ///< the membrane of a method with Membrane::edges, instead of strain
  DistanceConstraints distance;
  ElementLists elements;
  OwnElements own;            ///< for methods with MethodKind::takes_own_elements
  Directors directors;        ///< of the bending model
  Positions start_directors;  ///< #D by 3, m: at the start; empty: relaxed in the pose at the start
  StrainStiffness strain_stiffness;
  BendingStiffness bending_stiffness;
  Schedule strain_schedule, bending_schedule;  ///< factors on both stiffnesses over time
  double push_tension = 0;                     ///< N/m, by which springs that push stretch the rest shape
  SolverSettings settings;
  StartingFrom starting_from = StartingFrom::scene;
  /// Single precision: whether the moves of a substep are so short that positions have too few digits for
  /// them. If so, a method with MethodKind::keeps_moves_apart stores moves apart from positions (see Places),
  /// and takes up to a fifth more time.
  bool moves_apart = true;

  // Vertices and directors together are points: first the vertices, then the directors.
  std::size_t point_count() const { return mass.size() + directors.vertices.size(); }
  Positions points() const;  ///< #P by 3, m: vertices and directors at the start
  /// #P by 3, m: vertices at `vertices` (#V by 3, m), and directors with the least energy.
  Positions points_at(const Positions& vertices) const;
  Positions rest_points() const;            ///< #P by 3, m; empty if `rest` is empty
  double mass_of(std::size_t point) const;  ///< kg; see Directors::mass_share
  bool is_free(std::size_t point) const;    ///< not pinned, and with a mass
  /// Whether the point keeps its coordinate along `axis` (0 to 2), although it is free.
  bool is_held(std::size_t point, int axis) const {
    return point < held.size() && (held[point] >> axis & 1) != 0;
  }
  /// The membrane's largest compliance in any direction and triangle, m/N, with the stiffness as stated (not
  /// as scaled by strain_schedule).
  double softest_membrane() const {
    const double by_place =
        strain.softness.empty() ? 1 : *std::max_element(strain.softness.begin(), strain.softness.end());
    return strain_stiffness.compliance * strain_stiffness.largest_softness() * by_place;
  }
};

struct PassStatistics {
  std::string name;
  double seconds = 0;
  std::uint64_t calls = 0;
  std::uint64_t acted = 0;  ///< number of changes by its calls (vertices, pairs …); effects only

  void archive(Archive& state) { state(name, seconds, calls, acted); }
};

/// Where a simulation diverged: its worst vertex and triangle.
struct Divergence {
  double time = 0;   ///< s
  int vertex = 0;    ///< the first without a finite position, else the farthest from the origin
  Vector3 position;  ///< m, may be non-finite
  /// Vertices of the most stretched triangle; -1 without strain constraints.
  std::array<int, 3> triangle = {-1, -1, -1};
  double stretch = 1;  ///< its larger principal stretch, may be non-finite
};

/// Unbalanced forces after an implicit substep: sums of the lengths of forces over free vertices, N.
struct StepResidual {
  double unbalanced;  ///< of the total force, inertia included, without the part that contacts balance
  double effects;     ///< of the effects' forces, without linear drag; of inertia if these are tiny
  double share() const { return unbalanced / effects; }
};

class Simulation {
 public:
  virtual ~Simulation() = default;

  /// One time step dt. Returns false if the cloth diverged (see divergence()). Do not use a diverged state.
  virtual bool step() = 0;

  /// Whether further steps would change nothing. Always false for a method that simulates motion.
  virtual bool settled() const { return false; }
  /// For a method that finds an equilibrium: the unbalanced forces, relative to the loads.
  virtual std::optional<double> unbalanced() const { return std::nullopt; }

  virtual double time() const = 0;           ///< s
  virtual Positions positions() const = 0;   ///< #V by 3, m
  virtual Positions velocities() const = 0;  ///< #V by 3, m/s
  virtual const Divergence& divergence() const = 0;
  /// The passes of the steps, in the order of a substep.
  virtual const std::vector<PassStatistics>& passes() const = 0;
  /// Seconds of work on passes so far, by all threads except the calling thread.
  virtual double helper_seconds() const = 0;
  /// Constraint projections so far (a triangle's strain counts as one, a spring as one, an element as one).
  /// For a method that does not project: evaluations of constraints.
  virtual std::uint64_t projections() const = 0;
  /// Substeps so far. If the method cut a substep into parts, each part counts as a substep.
  virtual std::uint64_t substeps() const = 0;
  /// Memory of the method's arrays so far: points, ordered constraints with their multipliers, and data for
  /// solving (a matrix, and the largest size of its factor). The lists of effects and of the scene are not
  /// counted.
  virtual std::size_t memory_bytes() const = 0;
  /// The order of the constraints: for each SIMD lane, the index of its constraint in the list, or -1.
  virtual const BatchOrder& strain_order() const = 0;
  virtual const BatchOrder& distance_order() const = 0;
  /// The order of the elements whose Kind::name is `kind`. Throws as index_of_kind() does.
  virtual const BatchOrder& element_order(std::string_view kind) const = 0;
  /// How much of the stated stiffness the cloth had in the last substep (effective_stiffness.hpp), if the
  /// method knows. The call takes about as long as ten projection sweeps.
  virtual std::optional<EffectiveStiffness> effective_stiffness() const { return std::nullopt; }

  /// The residual at the end of the last substep, for a method that steps implicitly. Empty before the first
  /// step, and if the forces are smaller than their rounding errors. Takes as long as an iteration.
  virtual std::optional<StepResidual> step_residual() const { return std::nullopt; }

  /// The membrane's compliance as a multiple of the stated compliance, if the method softened the membrane.
  virtual std::optional<double> membrane_softness() const { return std::nullopt; }

  /// Writes or reads everything that further steps depend on, and all counts. Call this between steps. After
  /// reading, a simulation of the same input computes the same steps, bit for bit.
  virtual void archive(Archive& state) = 0;
};

/// A simulation with the method input.method, in single (Real = float) or double precision, with the passes
/// of the scene's effects. Throws std::invalid_argument if the method cannot simulate the scene.
template <class Real>
std::unique_ptr<Simulation> make_simulation(const SimulationInput& input,
                                            std::vector<Pass<Real>> effect_passes);

}  // namespace bendlab
