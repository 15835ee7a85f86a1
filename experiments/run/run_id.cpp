#include "experiments/run/run_id.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "bendlab/settings/input_file.hpp"
#include "experiments/config/references.hpp"
#include "experiments/measures/measure.hpp"
#include "experiments/run/version.hpp"

namespace bendlab {
namespace {

// Identifies the versions of the model, method, effects and measures that the program added and the run uses.
// Includes all measures that may apply, because only a built scene shows whether a measure applies.
std::string code_of_added_kinds(const RunConfig& config) {
  static const std::string program = "of this program";
  std::string codes;
  const auto add = [&](const auto& added, const auto& is_used) {
    for (const auto* kind : added)
      if (is_used(*kind)) codes += kind->code.empty() ? program : kind->code;
  };
  const Scene& scene = config.scene();
  add(added_bending_models(), [&](const BendingKind& kind) { return &kind == &scene.bending.model.kind(); });
  add(added_methods(), [&](const MethodKind& kind) { return &kind == &scene.solver.method.kind(); });
  add(added_effects(), [&](const EffectKind& kind) {
    return std::ranges::any_of(scene.effects, [&](const Effect& effect) { return &effect.kind() == &kind; });
  });
  add(added_measures(),
      [&](const Measure& measure) { return measure.applies || is_asked_for(measure, config); });
  if (codes.find(program) == std::string::npos) return codes;
  static const std::string hash = hex_hash(read_input_file("/proc/self/exe"));
  return codes + hash;
}

std::string bytes_of(const NamedFile& file) try {
  return read_input_file(file.path);
} catch (const std::runtime_error& error) {
  throw RunFileError(fmt::format("{}: the mesh file {}; check {} and the file's permissions",
                                 file.path.string(), error.what(), file.pointer));
}

// Writes "cells" for "mesh/cells", values without quotes, and '_' for characters that can't be in a name.
std::string readable_place(const RunConfig& config) {
  std::string place;
  for (const auto& [pointer, value] : config.point) {
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    place += fmt::format("{}{}={}", place.empty() ? "" : ",", pointer.substr(pointer.rfind('/') + 1), text);
  }
  for (char& c : place)
    if (!std::isalnum(static_cast<unsigned char>(c)) && !std::strchr("=,.-_", c)) c = '_';
  constexpr std::size_t longest = 120;  // with the id appended, well within a file system's 255 bytes
  return place.substr(0, longest);
}

// The id of a run that another run needs because of its setting `pointer`. RunFileErrors name the setting.
std::string id_of_other(const RunConfig& other, const std::string& pointer) try {
  return run_id(other);
} catch (const RunFileError& error) {
  throw RunFileError(fmt::format("{}: {}", pointer, error.what()));
}

// A run with another reference has another id, because its summary has errors against the reference. Wrong
// settings of the reference are reported when the reference is needed.
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
  const std::string code = code_of_added_kinds(config);
  return code.empty() ? "" : hex_hash(code);
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
