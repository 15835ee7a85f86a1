// What is read of a run file, as JSON: from the child process that read it, and in the index of a folder.
#pragma once

#include <filesystem>
#include <string>

#include "bendlab/io/run_file.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// JSON has no number that is not finite: NaN is null, infinity the text "inf" or "-inf".
nlohmann::json number_json(double number);
double number_of(const nlohmann::json& value);

/// All but summary, config and provenance: {id, name, status, frames, wall_s, cpu_s, step_cpu_s, metrics,
/// constraints, passes}.
nlohmann::json head_json(const RunRecord& run);

/// Reads what head_json() wrote. Throws std::exception for anything else.
RunRecord record_of(const nlohmann::json& head, const std::filesystem::path& file);

/// A text of the run's provenance; `absent` if there is none of that name.
std::string provenance_text(const RunRecord& run, const std::string& name, const std::string& absent = "");

/// The JSON that such a text is; null if it is none.
Json provenance_json(const RunRecord& run, const std::string& name);

}  // namespace bendlab
