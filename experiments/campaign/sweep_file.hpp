// A file beside the runs that lists the runs of a sweep, so that programs need not expand the sweep.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"

namespace bendlab {

/// `<out>/<experiment>/<name of the config's file>.sweep.json`. If there are overrides, the name contains a
/// hash of the overrides, so that the file of the config without overrides is not replaced.
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
