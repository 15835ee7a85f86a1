// The stiffness of a run whose cloth is a cantilever strip (lib/bendlab/metrics/stiffness.hpp), with the load
// and the defaults that follow from the run's config.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "bendlab/mesh/pins.hpp"
#include "bendlab/metrics/stiffness.hpp"
#include "experiments/config/experiment.hpp"

namespace bendlab {

/// The defaults follow from the reach of the bending model: how far the model's constraints extend along the
/// strip (the median over the free vertices that a constraint joins to the clamp). The reach is t rows of the
/// mesh for springs to ring t, and two rows for hinges.
struct StripSettings {
  /// m; default: a quarter of the reach, but 0 with physical stiffness, because the calibration already
  /// corrects for the clamp.
  std::optional<double> clamp_offset;
  std::optional<double> exclude;  ///< m; default: the reach
};

struct RunStrip {
  StiffnessMeter meter;
  StripOptions options;
};

/// Takes density and gravity from the config. Throws std::invalid_argument if the cloth is not a cantilever
/// strip.
RunStrip strip_of(const RunConfig& config, const RestMesh& rest, const Pins& pins,
                  const StripSettings& settings = {});

/// Like strip_of(), but reads mesh and pins from a run's file. Also throws RunFileError.
RunStrip strip_in(const std::filesystem::path& file, const RunConfig& config,
                  const StripSettings& settings = {});

/// The metrics that the measure `stiffness` puts into a run's summary, by name. Leaves out metrics that are
/// not finite.
std::map<std::string, double> summary_of(const StripStiffness& stiffness);

}  // namespace bendlab
