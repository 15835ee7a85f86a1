#include "experiments/run/folder.hpp"

#include <fmt/format.h>

#include <system_error>
#include <vector>

#include "bendlab/io/checksum.hpp"
#include "bendlab/io/disk.hpp"
#include "experiments/run/checked_read.hpp"
#include "experiments/run/run_record.hpp"
#include "experiments/run/version.hpp"

namespace bendlab {
namespace {

RunOutcome outcome_of(const RunRecord& record) {
  return {.id = record.id,
          .status = record.status,
          .reused = true,
          .file = record.file,
          .broken = broken_bound_of(provenance_json(record, "implausible")),
          .warnings = warnings_of(provenance_json(record, "warnings")),
          .message = provenance_text(record, "message"),
          .wall_s = record.wall_s,
          .cpu_s = record.cpu_s,
          .step_cpu_s = record.step_cpu_s,
          .summary = record.summary,
          .passes = record.passes};
}

}  // namespace

Found look_for(const std::filesystem::path& file, const std::string& id) {
  std::error_code ignored;
  if (!std::filesystem::exists(std::filesystem::symlink_status(file, ignored))) return {};
  try {
    switch (seal_of(file)) {
      case Seal::none:
        return {{}, "has no checksum, so this program did not finish the file"};
      case Seal::broken:
        return {{}, "was changed after it was written: its checksum is wrong"};
      case Seal::whole:
        break;
    }
    const RunRecord record = read_run(file);
    if (record.id != id) return {{}, fmt::format("is the file of another run, {}", record.id)};
    if (is_over(record.status)) return {outcome_of(record), "", provenance_text(record, "blas_kernels")};
  } catch (const RunFileError& error) {
    return {{}, fmt::format("cannot be read: {}", error.what())};
  }
  return {};
}

void keep_changes(const std::filesystem::path& folder) try {
  const std::filesystem::path file = folder / changes_file_name();
  if (build_info().changes.empty() || std::filesystem::exists(file)) return;
  make_folder(folder);
  replace_file(file, build_info().changes, Wait::no);
} catch (const std::exception&) {  // the errors of the runs say why nothing can be written there
}

std::string set_aside(const std::filesystem::path& file, const std::string& why) {
  const std::filesystem::path aside = fmt::format("{}.{}.bad", file.string(), unique_token());
  std::filesystem::rename(file, aside);
  return fmt::format("{} {}; the file is set aside as {}, and the run is computed again", file.string(), why,
                     aside.filename().string());
}

void adopt_finished(const RunPlace& place) {
  for (const std::filesystem::path& part : unfinished_files(place.folder)) try {
      if (seal_of(part) != Seal::whole) continue;
      const RunRecord record = read_run(part);
      if (record.id == place.id && is_over(record.status)) publish(part, place.file);
    } catch (const RunFileError&) {  // a file that cannot be read cannot be adopted
    }
}

void find_checkpoint(RunPlace& place) {
  place.saved = read_checkpoint(place.folder, place.id);
  if (!place.saved) return;
  std::vector<std::filesystem::path> files = unfinished_files(place.folder);
  files.push_back(place.file);
  for (const std::filesystem::path& file : files) try {
      if (!std::filesystem::exists(file)) continue;
      const RunRecord record = read_checked(file);
      if (record.id != place.id || record.frames < place.saved->frames) continue;
      place.earlier = {file, place.saved->frames};
      return;
    } catch (const RunFileError& error) {
      place.lost = error.what();
    }
  place.saved.reset();
}

}  // namespace bendlab
