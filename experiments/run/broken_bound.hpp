// What a run did that its scene cannot do (plausibility.hpp): as a text and as JSON.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bendlab/scene/strict_json.hpp"
#include "experiments/run/correction.hpp"

namespace bendlab {

/// What a run may not do. plausibility.cpp says when each is checked, and why its limit is what it is.
enum class Bound {
  finite,       ///< a coordinate, a velocity or a number of the summary is not finite
  stretch,      ///< of the most stretched triangle: length over rest length
  mean_strain,  ///< mean over triangles, the metric of that name
  reach,        ///< distance of a vertex from its nearest pin, m
  speed,        ///< of a vertex, m/s
  momentum,     ///< velocity of the centre of mass minus v0 + g t, m/s; for a cloth that nothing holds
  fall,         ///< displacement of the centre of mass minus v0 t + g t²/2, m; for such a cloth
  energy,       ///< kinetic energy plus energy of weight, minus their value at the start, J
};
std::string_view name_of(Bound bound);  ///< as in the enum
std::string_view unit_of(Bound bound);

/// The first bound that a run broke.
struct BrokenBound {
  Bound bound = Bound::finite;
  double measured = 0, limit = 0;  ///< in unit_of(bound)
  double time = 0;                 ///< s, when it was seen
  int vertex = -1;                 ///< where; -1: of the cloth as a whole
  Correction correction{};         ///< at that vertex, in the pose in which it was seen
  std::string advice{};            ///< what was measured to help; empty if nothing was
};

/// "at t = 0.5 s vertex 12 is 170 m away from its nearest pin, but …", with the advice.
std::string text_of(const BrokenBound& broken);
/// {bound, measured, limit, unit, time, vertex, constraint: {kind, correction}, advice}; as a text, numbers
/// that are not finite are null.
Json to_json(const BrokenBound& broken);
/// Reads what to_json() wrote; nothing if it is not that.
std::optional<BrokenBound> broken_bound_of(const Json& json);

}  // namespace bendlab
