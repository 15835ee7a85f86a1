// A few springs per vertex into the ring t edges away, evenly spread over the directions, for the models
// sparse_lod and prestressed.
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
        field<&Settings::t, Settings>(
            {.name = "t",
             .unit = "1",
             .meaning = "LOD level of every vertex; 0: m for free vertices and n for pinned vertices",
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
             .meaning = "springs that start at each vertex, whatever its level; with the springs that end "
                        "there, a vertex has twice as many on average",
             .minimum = 1,
             .maximum = 64})},
    level_fields<Settings>);

/// Springs at rest, ordered by vertex, and the levels as facts. The axes of a vertex's springs divide a half
/// turn evenly, because a spring resists bending along its axis, whichever way it points; every other spring
/// points the opposite way. The softness is (length / (t mean edges))^power, so that springs whose energy is
/// ∝ length^power / softness all have the same energy.
BendingConstraints thinned_rings(const ThinnedRingSettings& settings, const BendingInput& input, int power);

}  // namespace bendlab
