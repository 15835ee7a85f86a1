// The stiffness of a run whose cloth is a cantilever strip (lib/bendlab/metrics/stiffness.hpp), with what it
// takes from the run's config.
#pragma once

#include <optional>

#include "bendlab/mesh/pins.hpp"
#include "bendlab/metrics/stiffness.hpp"
#include "experiments/config/config.hpp"

namespace bendlab {

/// The defaults follow from the reach of the bending model: how far along the strip its constraints join a
/// free vertex to others (the median over the vertices that a constraint joins to the clamp). It is t rows
/// for springs of ring t, two for hinges.
struct StripSettings {
  /// m; default: a quarter of the reach, 0 for physical stiffness, whose calibration makes up for the clamp.
  std::optional<double> clamp_offset;
  std::optional<double> exclude;  ///< m; default: the reach
};

struct RunStrip {
  StiffnessMeter meter;
  StripOptions options;
};

/// Density and gravity are the config's. Throws std::invalid_argument for what is no cantilever strip.
RunStrip strip_of(const RunConfig& config, const RestMesh& rest, const Pins& pins,
                  const StripSettings& settings = {});

}  // namespace bendlab
