// The names of a run and of its folder.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/config/experiment.hpp"

namespace bendlab {

/// 16 hex digits of XXH3.
std::string hex_hash(const std::string& text);

/// Hash (16 hex digits) of the bending model, method and effects of the run that this program added, and of
/// its added measures if they may apply. Their code is not among our sources, so the hash gives runs of a
/// changed program other ids. Where an added kind has no `code`, the program's file is hashed. Empty if the
/// run has no added kind.
std::string own_code_hash(const RunConfig& config);

/// Hash (16 hex digits) of the resolved config, the bytes of the files that it names, the program's sources,
/// own_code_hash(), and the ids of the runs that the run starts after or is compared with.
std::string run_id(const RunConfig& config);

/// `<out>/<experiment>/<readable point of the sweep>-<id>`. The second function takes an id that is known
/// already.
std::filesystem::path run_folder(const std::filesystem::path& out, const Experiment& experiment,
                                 const RunConfig& config);
std::filesystem::path run_folder(const std::filesystem::path& out, const Experiment& experiment,
                                 const RunConfig& config, const std::string& id);

}  // namespace bendlab
