// `bendlab export`: writes a run for other programs.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bendlab/scene/counted.hpp"
#include "bendlab/scene/json_text.hpp"
#include "bendlab/settings/names.hpp"
#include "experiments/cli/commands.hpp"
#include "experiments/cli/find_run.hpp"
#include "experiments/export/format.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/run/needs.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/signals.hpp"

namespace bendlab {
namespace {

Json to_json(const RunRecord& run, const Format& format, const Exported& exported) {
  return {{"id", run.id},
          {"name", run.name},
          {"file", run.file.string()},
          {"format", format.name},
          {"to", exported.to.string()},
          {"files", exported.files},
          {"bytes", exported.bytes},
          {"frames", exported.frames.size()},
          {"first_frame", exported.frames.front().number},
          {"last_frame", exported.frames.back().number},
          {"surfaces", exported.surfaces},
          {"notes", exported.notes}};
}

void print_exported(const RunRecord& run, const Exported& exported) {
  print_text("{}: {}, {}\n{}  {}  {}: {} to {}\n", exported.to.string(), counted(exported.files, "file"),
             bytes_text(static_cast<double>(exported.bytes)), run.id, run.name,
             counted(exported.frames.size(), "frame"), exported.frames.front().number,
             exported.frames.back().number);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> export_formats() {
  std::vector<std::pair<std::string, std::string>> names;
  for (const Format* format : formats()) names.emplace_back(format->name, format->summary);
  return names;
}

int export_command(const ExportArguments& arguments, bool json) {
  const Format& format = *find_format(arguments.format);
  const RunRecord run = find_run(arguments.run, arguments.folder);
  ExportOptions options{
      .frames = arguments.frames, .to = arguments.to, .force = arguments.force, .stop = &stop_flag()};
  if (!arguments.up.empty()) options.up = named<UpAxis>(arguments.up, up_axis_names);
  catch_stop_signals();
  try {
    const Exported exported = export_run(run, format, options);
    for (const std::string& note : exported.notes) print_text(stderr, "bendlab: {}\n", note);
    if (json)
      print_text("{}\n", json_text(to_json(run, format, exported)));
    else
      print_exported(run, exported);
    return exit_ok;
  } catch (const ExportStopped&) {
    print_text(stderr, "bendlab: stopped; nothing was written\n");
    return stop_exit_code();
  }
}

}  // namespace bendlab
