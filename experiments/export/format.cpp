#include "experiments/export/format.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bendlab/settings/names.hpp"
#include "experiments/run/errors.hpp"

namespace bendlab {

namespace format {
extern const Format csv, obj, ply, pc2, usda, xdmf;
}

namespace {

namespace fs = std::filesystem;

constexpr std::array all = {&format::csv, &format::obj,  &format::ply,
                            &format::pc2, &format::usda, &format::xdmf};

// Throws UsageError if the format does not fit the file that --to names.
void check_file(const ExportedRun& run, const Format& format, const fs::path& to) {
  const std::string extension = to.extension().string();
  const bool is_file = extension == fmt::format(".{}", format.name);
  const auto refuse = [&](const std::string& why) {
    throw UsageError(fmt::format("--to {}: {}", to.string(), why));
  };
  if (!is_file && !extension.empty() && find_format(std::string_view(extension).substr(1)))
    refuse(fmt::format("is a file of another format than {}", format.name));
  if (!is_file && fs::exists(to) && !fs::is_directory(to))
    refuse(fmt::format("is a file, but its extension is not .{}; name a folder", format.name));
  if (is_file && format.in_one_file == InOneFile::nothing)
    refuse(fmt::format("{} writes several files; name a folder", format.name));
  if (is_file && format.in_one_file == InOneFile::a_frame && run.frames.size() > 1)
    refuse(
        fmt::format("{} writes a file for each of the {} frames; name a folder, or one frame with --frames",
                    format.name, run.frames.size()));
}

// Adds a note if the format has no times and the run's frames are not evenly spaced.
void note_uneven_times(ExportedRun& run, const Format& format) {
  constexpr double visible = 1e-3;  // of a frame
  const auto uneven = [&](const ExportedFrame& frame) {
    return std::abs(run.time_code(frame) - static_cast<double>(frame.number)) > visible;
  };
  const auto frame = std::ranges::find_if(run.frames, uneven);
  if (!format.has_times && frame != run.frames.end())
    run.notes.push_back(
        fmt::format("{} has no times, but the run's frames are not all 1/{} s apart: frame {} is at {:.6g} "
                    "s. The formats csv and usda have the times",
                    format.name, run.frames_per_second, frame->number, frame->time));
}

// Adds a note if positions are written relative to an origin.
void note_origin(ExportedRun& run, const Format& format) {
  if (format.states_origin && !run.origin.isZero(0))
    run.notes.push_back(fmt::format(
        "{} has single precision, which would round this run's edges, so positions are relative to ({}, {}, "
        "{}) m, as a comment in the OBJ file says. The formats obj and ply have the run's own positions",
        format.name, run.origin.x(), run.origin.y(), run.origin.z()));
}

}  // namespace

std::span<const Format* const> formats() {
  return all;
}

const Format* find_format(std::string_view name) {
  const auto format = std::ranges::find(all, name, &Format::name);
  return format == all.end() ? nullptr : *format;
}

std::string description_of(const ExportedRun& run) {
  std::string text = fmt::format("bendlab {}, run {} of {}; metres, {} is up", run.version, run.record.id,
                                 run.record.name, name_in(up_axis_names, run.up));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' '; }, ' ');
  return text;
}

Exported export_run(const RunRecord& record, const Format& format, const ExportOptions& options) {
  ExportedRun run = open_for_export(record, options.frames, options.up);
  const fs::path to =
      options.to.empty() ? record.file.parent_path() / "export" / std::string(format.name) : options.to;
  check_file(run, format, to);
  note_uneven_times(run, format);
  note_origin(run, format);
  Output output({to, format.name, options.force, options.stop});
  format.write(run, output);
  output.publish();
  Exported exported{.to = to, .frames = run.frames, .files = output.file_count(), .bytes = output.bytes()};
  for (const Surface& surface : run.surfaces) exported.surfaces.push_back(surface.name);
  exported.notes = std::move(run.notes);
  return exported;
}

}  // namespace bendlab
