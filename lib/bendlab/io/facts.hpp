// What is known of a run besides its arrays, as JSON: in its file, in the index of a folder, and as the
// answer of a process that reads a file.
#pragma once

#include <nlohmann/json.hpp>

#include "bendlab/io/run_file.hpp"

namespace bendlab {

using Json = nlohmann::ordered_json;

/// Everything of a header but its arrays, for a run that has not ended; facts.merge_patch(facts_of(footer))
/// adds its end. Throws Json::exception if the config is not JSON.
Json facts_of(const RunHeader& header);
Json facts_of(const RunFooter& footer);

/// The part of these that a RunRecord has, and `frames`.
Json facts_of(const RunRecord& run);

/// From facts of either kind; summary, provenance and config may be missing. Throws Json::exception or
/// std::invalid_argument.
RunRecord record_of(const Json& json, const std::filesystem::path& file);

/// A number, or the texts "nan", "inf" and "-inf", which JSON has no numbers for.
Json number_json(double number);
double number_of(const Json& json);

}  // namespace bendlab
