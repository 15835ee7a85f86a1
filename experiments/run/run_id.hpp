// The names of a run and of its folder.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/config/experiment.hpp"

namespace bendlab {

/// 16 hex digits of XXH3.
std::string hex_hash(const std::string& text);

/// Hash (16 hex digits) of the code of the bending model, method, effects and measures that this program
/// added, if the run uses or may use them. This code is not among our sources, so without the hash the runs
/// of a changed program would keep their ids. For an addition without a `code`, the program's file is hashed.
/// Empty if the run uses no addition.
std::string own_code_hash(const RunConfig& config);

/// Hash (16 hex digits) of the resolved config, the bytes of the files that the config names, the program's
/// sources, own_code_hash(), and the ids of the runs that the run starts after or is compared with.
std::string run_id(const RunConfig& config);

/// `<out>/<experiment>/<readable point of the sweep>-<id>`. The second function is for a run whose id is
/// already known.
std::filesystem::path run_folder(const std::filesystem::path& out, const Experiment& experiment,
                                 const RunConfig& config);
std::filesystem::path run_folder(const std::filesystem::path& out, const Experiment& experiment,
                                 const RunConfig& config, const std::string& id);

}  // namespace bendlab
