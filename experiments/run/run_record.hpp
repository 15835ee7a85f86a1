// Texts of a run's provenance.
#pragma once

#include <string>

#include "bendlab/io/run_file.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// The text `name` of the run's provenance; `absent` if there is no such text.
std::string provenance_text(const RunRecord& run, const std::string& name, const std::string& absent = "");

/// The text `name` of the run's provenance, parsed as JSON; null if there is no such text, or it is not JSON.
Json provenance_json(const RunRecord& run, const std::string& name);

}  // namespace bendlab
