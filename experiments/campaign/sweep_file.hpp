// A file beside the runs that says what a sweep consists of, so that programs that read results need not
// expand sweeps.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"

namespace bendlab {

/// `<out>/<experiment>/<name of the config's file>.sweep.json`. With overrides the name has a hash of the
/// overrides, so that a trial does not replace the sweep of the config as written.
std::filesystem::path sweep_file(const std::filesystem::path& out, const Experiment& experiment);

struct SweepFile {
  std::filesystem::path file;
  std::string text;
};

/// The sweep file of each experiment: the settings as written, the program, every registered bending model
/// with its label, the axes with their values, the expectations, and the point, id and folder of each run.
/// Reads every input file of the runs, and throws RunFileError if a file can't be read. Writes nothing.
std::vector<SweepFile> sweep_files(const std::filesystem::path& out,
                                   const std::vector<Experiment>& experiments);

/// Throws RunFileError.
void write(const std::vector<SweepFile>& files);

}  // namespace bendlab
