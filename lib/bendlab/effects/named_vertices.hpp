// The vertices on which a load acts.
#pragma once

#include <array>
#include <stdexcept>
#include <vector>

#include "bendlab/effects/effects.hpp"

namespace bendlab {

/// The vertices that a load lists by place and by index, ascending; all free vertices if it lists none.
/// Throws std::invalid_argument for a vertex that is not in the mesh, and for listed vertices that are all
/// pinned, because a load on a pinned vertex does nothing.
std::vector<int> loaded_vertices(const RestMesh& rest, const Pins& pins, const std::vector<Place>& places,
                                 const std::vector<int>& indices);

/// The rows of GrowingLoad, for a load of this type.
template <class Growing>
inline constexpr std::array load_fields = {
    field<&GrowingLoad::ramp, Growing>({.name = "ramp",
                                        .unit = "s",
                                        .meaning = "time in which the load grows linearly to its full size",
                                        .minimum = 0}),
    field<&Schedule::times, Growing>({.name = "times",
                                      .unit = "s",
                                      .meaning = "times of keyframes of the load, ascending; instead of ramp",
                                      .minimum = 0}),
    field<&Schedule::factors, Growing>(
        {.name = "factors",
         .unit = "1",
         .meaning = "share of the load at each of the times, linear between them. May be "
                    "below 0"}),
};

/// The share of a load at a time.
inline double share_of_load(const GrowingLoad& load, double time) {
  const double grown = load.ramp > 0 && time < load.ramp ? time / load.ramp : 1;
  return load.is_given() ? load.at(time) : grown;
}

/// Throws std::invalid_argument if the keyframes of a load are unsound.
inline void check_schedule(const GrowingLoad& load) {
  if (const std::string problem = load.problem(); !problem.empty()) throw std::invalid_argument(problem);
  if (load.is_given() && load.ramp > 0)
    throw std::invalid_argument("ramp cannot be combined with times and factors: remove one of them");
}

}  // namespace bendlab
