// Coarse levels of a cloth, for position-based dynamics. A projection passes a correction on by one edge
// only, so a fine mesh needs many projections before the pins affect its lower end. On coarse levels a
// correction moves farther in one projection:
//
//   level 2    o---------------o      per iteration, from the coarsest level on:
//               \               \       copy the points' positions from the cloth
//   level 1    o-------o-------o         move the points as the coarser level has moved
//               \       \       \        shorten the spans that are too long
//   the cloth  o---o---o---o---o       then project the cloth's own constraints
//
// The points of a coarse level are vertices, about twice as far apart as the points of the next finer level.
// A span joins two neighbouring points. A span resists only if its points are farther apart than the shortest
// path between the points along the cloth at rest. In a cloth that does not stretch, folded or not, no two
// points are farther apart than this path. So spans do not contradict the cloth's own constraints. (Beside a
// hole, a span may be too short by up to 0.3 edges, because geodesic_distances() is inexact there. A coarse
// mesh with lengths and angles of its own contradicts the cloth's constraints: it moves a folded cloth away
// from rest, Müller 2008.) Hat functions spread the move of a point to the finer points. The hat function of
// a point falls from 1 to 0 over the least distance between points. The hat functions of all points sum to 1.
#pragma once

#include <vector>

#include "bendlab/constraints/batches.hpp"
#include "bendlab/solver/simulation.hpp"
#include "bendlab/solver/workers.hpp"

namespace bendlab {

/// Whether there are fewer substeps than edges across the cloth. With more substeps, corrections reach the
/// whole cloth without levels. With levels the cloth then even gained energy: 0.04 to 0.4 of its energy scale
/// in plain scenes of 6 to 24 cells with 64 substeps.
bool levels_are_worthwhile(const SimulationInput& input);

template <class Real>
class CoarseLevels {
 public:
  /// Makes up to `most_levels` levels, and stops before a level with too few points. The stiffness of spans
  /// follows from input.strain_stiffness. Throws std::invalid_argument if the membrane does not resist
  /// stretch in all directions.
  CoarseLevels(const SimulationInput& input, int most_levels);

  /// Sets the multipliers of all spans to 0. Call this at the start of a substep.
  void begin_substep();
  /// Moves the cloth's free points. `cloth` has the vertices in the order of input.permutation; h in s.
  void correct(const Places<Real>& cloth, Real h, Workers& workers);

  /// Multiplies the stated stiffness of the spans from now on.
  void scale_stiffness(double factor) {
    for (Level& level : levels_) level.spans.compliance = static_cast<Real>(compliance_ / factor);
  }

  std::size_t count() const { return levels_.size(); }
  std::size_t span_count() const;
  std::size_t memory_bytes() const;

 private:
  // A point of the finer level moves by this share of the move of the coarse point with index `point`.
  struct Hat {
    int point;
    Real share;
  };
  struct Hats {
    std::vector<std::size_t> first;  // the first hat of each finer point, then the number of hats
    std::vector<Hat> all;
  };
  struct Level {
    std::vector<int> slot;            // of each point in the cloth's arrays
    Points<Real> base, moved, taken;  // see Places; taken: `moved` when copied from the cloth
    DistanceBatch<Real> spans;
    Hats hats;  // of the points of the next finer level, or of the cloth
  };
  struct Builder;

  void take_over(Level& level, const Places<Real>& cloth) const;
  void shorten(Level& level, bool is_split, Real h, int sweeps, Workers& workers) const;

  std::vector<Level> levels_;  // from fine to coarse
  double compliance_ = 0;      // of spans as stated
};

}  // namespace bendlab
