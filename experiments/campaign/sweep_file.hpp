// What a sweep consists of, on disk beside its runs, so that who reads results need not expand sweeps.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"

namespace bendlab {

/// `<out>/<experiment>/<name of the config's file>.sweep.json`. With overrides it has their hash in its name:
/// a trial does not replace the sweep as it is written.
std::filesystem::path sweep_file(const std::filesystem::path& out, const Experiment& experiment);

struct SweepFile {
  std::filesystem::path file;
  std::string text;
};

/// Of each experiment: the settings as written, the program, every registered bending model with its label,
/// the axes with their values, what is expected of the runs, and of each run its point, id and folder. Reads
/// every file that a run needs, and throws RunFileError if one can't be read. Nothing is created.
std::vector<SweepFile> sweep_files(const std::filesystem::path& out,
                                   const std::vector<Experiment>& experiments);

/// Throws RunFileError.
void write(const std::vector<SweepFile>& files);

}  // namespace bendlab
