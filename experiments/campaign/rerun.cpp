#include "experiments/campaign/rerun.hpp"

#include <fmt/format.h>

#include <array>

#include "bendlab/io/disk.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/config/settings_by_pointer.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/run/run.hpp"
#include "experiments/run/run_id.hpp"
#include "experiments/run/run_record.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

// The entries of a run's provenance that, together with the settings, decide the bits of the result.
constexpr std::array<const char*, 13> decisive = {
    "version",        "git_commit", "git_dirty",   "git_changes", "source_hash", "own_code",    "compiler",
    "compiler_flags", "build_type", "vector_bits", "processor",   "libraries",   "blas_kernels"};

// The run's experiment. Writes the run's input files into `folder`, and changes the file names in the
// settings.
Experiment repeated(const RunRecord& run, const fs::path& folder) {
  Json settings = parse_strict_json(run.config, run.file.string());
  settings["name"] = run.name;
  const std::vector<InputFile> inputs = read_inputs(run.file);
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const fs::path file =
        fs::absolute(folder / fmt::format("input_{}{}", k, fs::path(inputs[k].name).extension().string()));
    replace_file(file, inputs[k].bytes);
    set_at(settings, inputs[k].pointer, file.string());
  }
  return experiment_of(settings, run.file.string());
}

}  // namespace

Repetition repeat(const RunRecord& run, const fs::path& folder, const RunControl& control) {
  make_folder(folder);
  Experiment experiment = repeated(run, folder);
  experiment.settings = {
      {"name", run.name}};  // no user stated the other settings, so there are no warnings about them
  RunConfig& config = experiment.runs.front();
  const Json point = provenance_json(run, "point");
  if (point.is_object())
    for (const auto& [pointer, value] : point.items()) config.point.emplace_back(pointer, value);
  std::error_code none;
  if (fs::equivalent(run_folder(folder, experiment, config), run.file.parent_path(), none))
    throw UsageError(fmt::format("a repetition in '{}' would replace the run itself: name another folder",
                                 folder.string()));
  RunControl again = control;
  again.force = true;
  Repetition repetition{execute_run(experiment, config, folder, again), {}, {}};
  if (repetition.outcome.status == RunStatus::interrupted) return repetition;
  repetition.differing_parts = differing_parts(run.file, repetition.outcome.file);
  const RunRecord now = read_run(repetition.outcome.file);
  for (const char* name : decisive)
    if (const std::pair texts(provenance_text(run, name, "unknown"), provenance_text(now, name, "unknown"));
        texts.first != texts.second)
      repetition.changed.emplace(name, texts);
  return repetition;
}

}  // namespace bendlab
