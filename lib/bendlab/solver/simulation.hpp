// The time step of position-based dynamics over a step plan that is compiled from what the scene lists.
//
//   per substep h:  force passes → damp passes → predict → predicted passes →
//                   n × (strain, bending, project passes, contact passes) → update → velocity passes
//
// (Müller et al. 2007, §3.1.) A pass that the scene does not list is not in the plan: it has no branch and no
// time.
//
// Why the constraints lie in memory as they do. A projection is a handful of arithmetic between reading two
// or three points and writing them back; what it costs is moving them. So
//
// * a vertex is four numbers, position and inverse mass, moved by one load or store and transposed in
//   registers: one load where x, y, z and w apart would take four;
// * constraints without a common vertex go side by side, one per lane. Colouring finds them: a greedy
//   first-fit over the list, after the pins are known (a constraint between pinned vertices is not there to
//   be coloured). It knows nothing of lane width or threads, so neither changes a bit of the result;
// * springs are coloured as stars, up to four springs of one centre in one lane: the centre stays in a
//   register (half the traffic) and the colours are few and large, which is what threads want: they meet once
//   per colour. Longer stars are faster and converge worse;
// * triangles are coloured one by one: they share too few vertices for stars to pay;
// * a batch stores what the kernel needs in the order in which it needs it: offsets ready for an address,
//   rest values, XPBD's multipliers; nothing is computed twice and nothing is branched on;
// * vertices keep the mesh's numbering where that is local, else the reverse Cuthill-McKee order (a scanned
//   or exported mesh may be numbered at random);
// * one thread takes all colours of one tile of vertices before it goes on to the next (tiling.hpp), so that
//   the points of a large mesh come from memory once per sweep, not once per colour. The bits are those of
//   colour after colour, which is how several threads go.
//
// What colouring costs is convergence: a colour sees its neighbours' corrections only after a whole colour,
// where list order passes them on at once. `bendlab bench` measures by how much; `order: mesh` runs the list
// order on the reference kernels.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/constraints/effective_stiffness.hpp"
#include "bendlab/constraints/kinds.hpp"
#include "bendlab/constraints/state.hpp"
#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

enum class Method {
  pbd,          ///< position-based dynamics, as above
  kang_cho,     ///< an approximate implicit mass-spring step, see kang_cho.hpp
  equilibrium,  ///< Newton's method on the way to a static equilibrium, see equilibrium.hpp
};

/// What of a spring's tangent kang_cho takes into its implicit step.
enum class Tangent {
  along,      ///< k along the spring, nothing across it: J = k d dᵀ / |d|², as in the source
  taut,       ///< besides, k (1 - L / |d|) across a spring that is longer than L
  isotropic,  ///< k in every direction: J = k 1
};

enum class Sweep {
  forward,    ///< one pass over the constraints per iteration
  symmetric,  ///< forward, then backward: two projections per iteration, no energy pumped at small steps
};

enum class ConstraintOrder {
  colour,  ///< by colour, lanes and threads side by side
  mesh,    ///< in the order of the lists, one after another, by the reference implementation
};

enum class FirstConstraint { strain, bending };

struct SolverSettings {
  Method method = Method::pbd;
  Tangent tangent = Tangent::along;
  double dt = 1.0 / 60;  ///< s
  int substeps = 1;
  int iterations = 10;  ///< per substep
  double flight_limit =
      0;  ///< pbd: forces change a deformation gradient by no more per substep, see flight.hpp; 0: they may
  Sweep sweep = Sweep::forward;
  ConstraintOrder order = ConstraintOrder::colour;
  FirstConstraint first = FirstConstraint::strain;
  int threads = 1;
  /// pbd in single precision: projections see what a substep moves a vertex apart from where it was (see Places), else rounded
  /// positions, which takes up to a fifth less time and does where a substep moves the cloth by far more than their last digit.
  bool apart = true;
  bool starts_near = false;  ///< equilibrium: the pose is already near one
  /// equilibrium: the pose is one's of the same mesh, found by another method; the way must not leave its basin
  bool starts_there = false;

  int projections_per_substep() const { return iterations * (sweep == Sweep::symmetric ? 2 : 1); }
};

struct StrainStiffness {
  StrainForm form = StrainForm::normalised;
  StiffnessKind kind = StiffnessKind::k;
  double warp = 1, weft = 1, shear = 1, area = 0;  ///< k in [0, 1]
  double compliance = 0;                           ///< m/N
};

struct BendingStiffness {
  StiffnessKind kind = StiffnessKind::k;
  double k = 0.5;         ///< in [0, 1]
  double compliance = 0;  ///< of a spring in m/N, of an element by its model's softness
};

/// A scene as the solver sees it.
struct SimulationInput {
  Positions positions;   ///< #V by 3, m: where the cloth starts
  Positions velocities;  ///< #V by 3, m/s, or empty: at rest
  Positions rest;        ///< #V by 3, m: the shape by which collapsed elements open; empty: they stay
  Vector3 origin;        ///< coordinates are kept relative to it, m
  double size = 1;       ///< of the rest shape, m: a vertex farther than 10⁶ sizes away means divergence
  std::vector<double> mass;     ///< #V, kg
  std::vector<char> is_pinned;  ///< #V
  std::vector<int> place;  ///< #V, where each vertex stands in the solver's memory; empty: in its own place

  StrainConstraints strain;
  DistanceConstraints edges;  ///< the membrane of kang_cho, instead of strain; pbd does not look at it
  DistanceConstraints distance;
  ElementLists elements;
  StrainStiffness strain_stiffness;
  BendingStiffness bending_stiffness;
  SolverSettings settings;
};

struct PassStatistics {
  std::string name;
  double seconds = 0;
  std::uint64_t calls = 0;
  std::uint64_t acted = 0;  ///< sum of what its calls say they changed (vertices, pairs …); of effects only
};

/// What stopped a simulation: its worst vertex and triangle.
struct Divergence {
  double time = 0;   ///< s
  int vertex = 0;    ///< the first without a finite position, else the farthest
  Vector3 position;  ///< m, may be non-finite
  std::array<int, 3> triangle = {-1, -1,
                                 -1};  ///< vertices of the most stretched; -1 without strain constraints
  double stretch = 1;                  ///< its larger principal stretch, may be non-finite
};

class Simulation {
 public:
  virtual ~Simulation() = default;

  /// One time step dt. Returns false when the cloth diverged (see divergence()); the state is then of no use.
  virtual bool step() = 0;

  /// Whether a further step would change nothing. A method that moves on in time never says so.
  virtual bool settled() const { return false; }
  /// Of a method that looks for an equilibrium: forces that are left over, relative to the loads.
  virtual std::optional<double> unbalanced() const { return std::nullopt; }

  virtual double time() const = 0;           ///< s
  virtual Positions positions() const = 0;   ///< #V by 3, m
  virtual Positions velocities() const = 0;  ///< #V by 3, m/s
  virtual const Divergence& divergence() const = 0;
  virtual const std::vector<PassStatistics>& passes()
      const = 0;  ///< the step plan, in the order of a substep
  /// Seconds that threads beside the calling one spent on passes so far.
  virtual double helper_seconds() const = 0;
  /// Constraint projections so far (a triangle's strain counts as one, a spring as one, an element as one). In
  /// a step of kang_cho every spring counts once.
  virtual std::uint64_t projections() const = 0;
  /// Substeps so far, those that flight_limit made of others among them.
  virtual std::uint64_t substeps() const = 0;
  /// What the method holds so far, from the sizes of its arrays: points, ordered constraints with their multipliers, and what
  /// else it solves with (a matrix, its factor at its largest). Without the effects' and the scene's own lists.
  virtual std::size_t memory_bytes() const = 0;
  /// The order the constraints stand in: original index per lane, -1 for padding.
  virtual const BatchOrder& strain_order() const = 0;
  virtual const BatchOrder& distance_order() const = 0;
  virtual const BatchOrder& element_order(std::string_view kind) const = 0;  ///< Kind::name
  /// What the last substep made of the stiffness told, for the shares that effective_stiffness.hpp has; of pbd only. Takes
  /// up to about ten sweeps' time.
  virtual std::optional<EffectiveStiffness> effective_stiffness() const { return std::nullopt; }
};

/// A simulation in single (Real = float) or double precision, with the passes of the scene's effects. Throws
/// std::invalid_argument for what the method cannot do (see kang_cho.hpp; pbd can do all).
template <class Real>
std::unique_ptr<Simulation> make_simulation(const SimulationInput& input,
                                            std::vector<Pass<Real>> effect_passes);

}  // namespace bendlab
