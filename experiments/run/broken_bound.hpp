// A bound that a run broke, but that no correct result can break (plausibility.hpp), as text and as JSON.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bendlab/scene/strict_json.hpp"
#include "experiments/run/correction.hpp"

namespace bendlab {

/// A quantity with a limit that a run may not exceed. plausibility.cpp says when each quantity is checked,
/// and gives the reason for the limit.
enum class Bound {
  finite,       ///< a coordinate, a velocity or a metric of the summary is not finite
  stretch,      ///< of the most stretched triangle: length over rest length
  mean_strain,  ///< mean over triangles, the metric of that name
  reach,        ///< distance of a vertex from its nearest pin, m
  speed,        ///< of a vertex, m/s
  momentum,     ///< velocity of the centre of mass minus v0 + g t, m/s; for a cloth that nothing holds
  fall,    ///< displacement of the centre of mass minus v0 t + g t²/2, m; for a cloth that nothing holds
  energy,  ///< kinetic energy plus energy of weight, minus their value at the start, J
};
std::string_view name_of(Bound bound);  ///< as in the enum
std::string_view unit_of(Bound bound);

/// The first bound that a run broke.
struct BrokenBound {
  Bound bound = Bound::finite;
  double measured = 0, limit = 0;  ///< in unit_of(bound)
  double time = 0;                 ///< s, when a check found it
  int vertex = -1;                 ///< where; -1: the cloth as a whole
  Correction correction{};         ///< largest correction at that vertex, in the pose that was checked
  std::string advice{};            ///< remedies that helped in tests; empty if none is known
};

/// "at t = 0.5 s vertex 12 is 170 m away from its nearest pin, but …", followed by the advice.
std::string text_of(const BrokenBound& broken);
/// {bound, measured, limit, unit, time, vertex, constraint: {kind, correction}, advice}. In the text of this
/// JSON, numbers that are not finite become null.
Json to_json(const BrokenBound& broken);
/// Reads the JSON of to_json(). Returns nothing for other JSON.
std::optional<BrokenBound> broken_bound_of(const Json& json);

}  // namespace bendlab
