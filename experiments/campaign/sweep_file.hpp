// What a sweep consists of, on disk beside its runs, so that who reads results need not expand sweeps.
#pragma once

#include <filesystem>

#include "experiments/config/config.hpp"

namespace bendlab {

/// `<out>/<experiment>/<name of the config's file>.sweep.json`. With overrides it has their hash in its name:
/// a trial does not replace the sweep as it is written.
std::filesystem::path sweep_file(const std::filesystem::path& out, const Experiment& experiment);

/// Writes it: the settings as written, the program, every registered bending model with its label, the axes
/// with their values, what is expected of the runs, and of each run its point, its id and its folder (null
/// where a file that the run needs can't be read). Throws RunFileError.
void write_sweep_file(const std::filesystem::path& out, const Experiment& experiment);

}  // namespace bendlab
