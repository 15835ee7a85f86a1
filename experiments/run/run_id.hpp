// What a run and its folder are called.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/config/experiment.hpp"

namespace bendlab {

/// 16 hex digits of XXH3.
std::string hex_hash(const std::string& text);

/// For a run with something that this program added, or possibly with a measure that it added, whose code is
/// not among our sources: hex_hash() of the program's file, so that a program that was changed makes other
/// runs. For any other run empty.
std::string own_code_hash(const RunConfig& config);

/// Hash (16 hex digits) of the resolved config, the bytes of the files that it names, the program's sources,
/// its file where they are not all ours, and the ids of the runs that it starts after or is
/// compared with.
std::string run_id(const RunConfig& config);

/// `<out>/<experiment>/<readable place on the sweep>-<id>`; the id where it is known.
std::filesystem::path run_folder(const std::filesystem::path& out, const Experiment& experiment,
                                 const RunConfig& config);
std::filesystem::path run_folder(const std::filesystem::path& out, const Experiment& experiment,
                                 const RunConfig& config, const std::string& id);

}  // namespace bendlab
