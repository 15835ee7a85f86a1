// Coarse levels of a cloth, for position-based dynamics. A projection passes a correction on by one edge, so
// that a fine mesh needs many of them before its lower end knows of its pins. Levels carry it far:
//
//   level 2    o---------------o      per iteration, from the coarsest level on:
//               \               \       take the points' positions from the cloth
//   level 1    o-------o-------o         move them as the coarser level has moved
//               \       \       \        shorten the spans that are too long
//   the cloth  o---o---o---o---o       then the cloth's own constraints
//
// The points of a level are vertices about twice as far apart as those of the level below. A span joins
// neighbours. It is slack until it is longer than the way between them through the cloth at rest: no shape
// that the cloth can take without stretching is longer than that, folded or not, so a span never asks for
// what the cloth's own constraints would refuse. (A coarse mesh that keeps its own lengths and angles would:
// it moves a folded cloth away from rest, Müller 2008.) A move spreads to the finer points by hats that reach
// as far as points are apart; they sum to 1.
#pragma once

#include <vector>

#include "bendlab/constraints/batches.hpp"
#include "bendlab/solver/simulation.hpp"
#include "bendlab/solver/workers.hpp"

namespace bendlab {

/// Whether there are fewer substeps than edges across the cloth. More of them reach everywhere alone, and
/// with levels gained energy: 0.04 to 0.4 of its scale in plain scenes of 6 to 24 cells in 64 substeps.
bool levels_are_worthwhile(const SimulationInput& input);

template <class Real>
class CoarseLevels {
 public:
  /// At most so many levels, fewer if a mesh has no more than a few vertices to an edge of its coarsest.
  /// Spans have the stiffness of input.strain_stiffness. Throws std::invalid_argument if the membrane does
  /// not resist stretch in all directions: spans would.
  CoarseLevels(const SimulationInput& input, int most_levels);

  /// Forgets what spans pulled so far: at the start of a substep.
  void begin_substep();
  /// Moves the cloth's free points, with `cloth` in the order of input.permutation; h in s.
  void correct(const Places<Real>& cloth, Real h, Workers& workers);

  std::size_t count() const { return levels_.size(); }
  std::size_t span_count() const;
  std::size_t memory_bytes() const;

 private:
  // What a point of the finer level takes of its neighbours' moves.
  struct Hat {
    int point;
    Real share;
  };
  struct Hats {
    std::vector<std::size_t> first;  // by finer point, then the number of hats
    std::vector<Hat> all;
  };
  struct Level {
    std::vector<int> slot;            // of each point in the cloth
    Points<Real> base, moved, taken;  // places, and what was taken over from the cloth
    DistanceBatch<Real> spans;
    Hats hats;  // at the finer level's points, or at the cloth's
  };
  struct Builder;

  void take_over(Level& level, const Places<Real>& cloth) const;
  void shorten(Level& level, bool is_split, Real h, int sweeps, Workers& workers) const;

  std::vector<Level> levels_;  // from fine to coarse
};

}  // namespace bendlab
