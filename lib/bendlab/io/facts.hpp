// The facts of a run: all its data except arrays, as JSON. Facts are in the run's file, in the index of a
// folder, and in the answer of a process that reads a file.
#pragma once

#include <nlohmann/json.hpp>

#include "bendlab/io/run_file.hpp"

namespace bendlab {

using Json = nlohmann::ordered_json;

/// Facts of a run that has not ended. facts.merge_patch(facts_of(footer)) adds the facts of the run's end.
/// Throws Json::exception if the config is not JSON.
Json facts_of(const RunHeader& header);
Json facts_of(const RunFooter& footer);

/// The facts that a RunRecord has, and `frames`.
Json facts_of(const RunRecord& run);

/// Makes a RunRecord from the facts of a file, or from the result of facts_of(RunRecord). Summary, provenance
/// and config may be missing. Throws Json::exception or std::invalid_argument.
RunRecord record_of(const Json& json, const std::filesystem::path& file);

/// A number as JSON, which has no NaN and infinities: they become the texts "nan", "inf" and "-inf".
Json number_json(double number);
double number_of(const Json& json);

}  // namespace bendlab
