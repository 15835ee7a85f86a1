// The stiffness of a run whose cloth is a cantilever strip (lib/bendlab/metrics/stiffness.hpp), with what it
// takes from the run's config.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "bendlab/mesh/pins.hpp"
#include "bendlab/metrics/stiffness.hpp"
#include "experiments/config/experiment.hpp"

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

/// The same of a run's file. Throws RunFileError, too.
RunStrip strip_in(const std::filesystem::path& file, const RunConfig& config,
                  const StripSettings& settings = {});

/// What the measure `stiffness` puts into a run's summary, by name; numbers that are not finite are left out.
std::map<std::string, double> summary_of(const StripStiffness& stiffness);

}  // namespace bendlab
