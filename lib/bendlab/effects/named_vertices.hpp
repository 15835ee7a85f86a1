// The vertices on which a load acts.
#pragma once

#include <vector>

#include "bendlab/effects/effect.hpp"

namespace bendlab {

/// The vertices that a load lists by place and by index, ascending; all free vertices if it lists none.
/// Throws std::invalid_argument for a vertex that is not in the mesh, and for listed vertices that are all
/// pinned, because a load on a pinned vertex does nothing.
std::vector<int> loaded_vertices(const EffectInput& input, const std::vector<Place>& places,
                                 const std::vector<int>& indices);

/// The share of a load at a time: it grows linearly during `ramp` seconds.
inline double share_of_load(double ramp, double time) {
  return ramp > 0 && time < ramp ? time / ramp : 1;
}

}  // namespace bendlab
