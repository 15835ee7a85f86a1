// Texts of a run's provenance.
#pragma once

#include <string>

#include "bendlab/io/run_file.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// A text of the run's provenance; `absent` if there is none of that name.
std::string provenance_text(const RunRecord& run, const std::string& name, const std::string& absent = "");

/// The JSON that such a text is; null if it is none.
Json provenance_json(const RunRecord& run, const std::string& name);

}  // namespace bendlab
