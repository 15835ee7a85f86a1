// A few springs from each vertex to vertices that are t edges away, in evenly spread directions. The models
// sparse_lod and prestressed use these springs.
#pragma once

#include "bendlab/bending/levels.hpp"

namespace bendlab {

/// The settings that thinned_rings() reads.
struct ThinnedRingSettings : LevelSettings {
  int t = 0;
  int t_min = 2;
  int springs = 4;  ///< per vertex
};
template <class Settings>
inline constexpr auto thinned_ring_fields = joined(
    std::array{
        field<&Settings::t, Settings>({.name = "t",
                                       .unit = "1",
                                       .meaning = "LOD level of every vertex; 0 gives free vertices the "
                                                  "level m, and pinned vertices the level n",
                                       .minimum = 0,
                                       .maximum = 1000}),
        field<&Settings::t_min, Settings>({.name = "t_min",
                                           .unit = "1",
                                           .meaning = "lower bound on the LOD level, because springs along "
                                                      "the mesh's own edges do not resist bending",
                                           .minimum = 1,
                                           .maximum = 1000}),
        field<&Settings::springs, Settings>(
            {.name = "springs",
             .unit = "1",
             .meaning = "number of springs that start at each vertex, at any LOD level; on average the same "
                        "number of springs ends at a vertex",
             .minimum = 1,
             .maximum = 64})},
    level_fields<Settings>);

/// Springs at rest, ordered by vertex; `facts` of the result states the levels. The axes of a vertex's
/// springs divide a half turn evenly, because a spring resists bending along its axis in both directions.
/// Every second spring points the opposite way. The softness is (length / (t mean edges))^power, so that
/// springs whose energy is ∝ length^power / softness all have the same energy.
BendingConstraints thinned_rings(const ThinnedRingSettings& settings, const BendingInput& input, int power);

}  // namespace bendlab
