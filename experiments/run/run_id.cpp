#include "experiments/run/run_id.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "bendlab/parameters/input_file.hpp"
#include "experiments/config/references.hpp"
#include "experiments/measures/measure.hpp"
#include "experiments/run/version.hpp"

namespace bendlab {
namespace {

bool has_added_kind(const Scene& scene) {
  const auto is_in = [](const auto& added, const auto& kind) {
    return std::ranges::find(added, &kind) != added.end();
  };
  return is_in(added_bending_models(), scene.bending.model.kind()) ||
         is_in(added_methods(), scene.solver.method.kind()) ||
         std::ranges::any_of(scene.effects,
                             [&](const Effect& effect) { return is_in(added_effects(), effect.kind()); });
}

// Whether a measure applies is known only when there is a scene: here it counts if it may.
bool may_have_added_measure(const RunConfig& config) {
  return std::ranges::any_of(added_measures(), [&](const Measure* measure) {
    return measure->applies != nullptr || is_asked_for(*measure, config);
  });
}

std::string bytes_of(const NamedFile& file) try {
  return read_input_file(file.path);
} catch (const std::runtime_error& error) {
  throw RunFileError(fmt::format("{}: the mesh file {}; check {} and the file's permissions",
                                 file.path.string(), error.what(), file.pointer));
}

// "mesh/cells" → "cells", values without quotes; what a folder's name can't hold becomes '_'.
std::string readable_place(const RunConfig& config) {
  std::string place;
  for (const auto& [pointer, value] : config.point) {
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    place += fmt::format("{}{}={}", place.empty() ? "" : ",", pointer.substr(pointer.rfind('/') + 1), text);
  }
  for (char& c : place)
    if (!std::isalnum(static_cast<unsigned char>(c)) && !std::strchr("=,.-_", c)) c = '_';
  constexpr std::size_t longest = 120;  // well within a file system's 255 bytes, with the id behind it
  return place.substr(0, longest);
}

// The id of a run that another one needs. Throws RunFileError that names the setting which asks for it.
std::string id_of_other(const RunConfig& other, const std::string& pointer) try {
  return run_id(other);
} catch (const RunFileError& error) {
  throw RunFileError(fmt::format("{}: {}", pointer, error.what()));
}

// The summary has errors against a reference, so another reference makes another run. Wrong settings of the
// reference are reported when it is needed.
std::string reference_id(const RunConfig& config, Against against, bool coarser) try {
  const std::optional<RunConfig> reference = reference_of(config, against, coarser);
  return reference ? id_of_other(*reference, reference_pointer(against, coarser)) : "";
} catch (const ConfigError&) {
  return "";
}

}  // namespace

std::string hex_hash(const std::string& text) {
  return fmt::format("{:016x}", XXH3_64bits(text.data(), text.size()));
}

std::string own_code_hash(const RunConfig& config) {
  if (!has_added_kind(config.scene()) && !may_have_added_measure(config)) return "";
  static const std::string hash = hex_hash(read_input_file("/proc/self/exe"));
  return hash;
}

std::string run_id(const RunConfig& config) {
  std::string identity =
      identity_text(config.resolved()) + std::string(build_info().source_hash) + own_code_hash(config);
  for (const NamedFile& file : input_files(config)) identity += bytes_of(file);
  if (const std::optional<RunConfig> before = run_before(config))
    identity += id_of_other(*before, "/initial/after");
  for (const Against against : references)
    for (const bool coarser : {false, true}) identity += reference_id(config, against, coarser);
  return hex_hash(identity + config.starts_at_end_of);
}

std::filesystem::path run_folder(const std::filesystem::path& out, const Experiment& experiment,
                                 const RunConfig& config) {
  return run_folder(out, experiment, config, run_id(config));
}

std::filesystem::path run_folder(const std::filesystem::path& out, const Experiment& experiment,
                                 const RunConfig& config, const std::string& id) {
  const std::string place = readable_place(config);
  return out / experiment.name / (place.empty() ? id : place + "-" + id);
}

}  // namespace bendlab
