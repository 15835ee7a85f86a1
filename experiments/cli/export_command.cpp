// `bendlab export`: writes a run for other programs.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bendlab/scene/counted.hpp"
#include "bendlab/scene/json_text.hpp"
#include "bendlab/settings/names.hpp"
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

struct ExportCommand : Command {
  RunArgument asked{*this};
  std::string format, up;
  ExportOptions wanted;

  ExportCommand() {
    std::vector<std::string_view> names;
    more = "Formats:\n";
    for (const Format* known : formats()) {
      names.push_back(known->name);
      more += fmt::format("  {:<5} {}\n", known->name, known->summary);
    }
    more +=
        "Every format except csv also has the obstacles. In Houdini, Maya and the defaults of Blender's\nOBJ "
        "importer the y axis is up: give --up y, or choose forward axis Y and up axis Z in Blender.\n";
    add(format, fmt::format("--format! {}", fmt::join(names, "|")), "Format of the files, see below");
    add(wanted.to, "--to PATH",
        "Folder to write into, or the file for a format that needs only one file (default: "
        "export/FORMAT beside the run file)");
    add(wanted.frames, "--frames FIRST:LAST:STEP",
        "Which frames to write, such as 10:20, ::5 or -1; the first frame is 0, the last is -1 "
        "(default: all)");
    add(up, fmt::format("--up {}", fmt::join(up_axis_names, "|")),
        "Turn the run so that this axis points up (default: do not turn the run; the file states y or z "
        "as up, by the direction of gravity)");
    add(wanted.force, "--force", "Replace the files of an earlier export");
    add(json, "--json", "Print one JSON object");
  }

  int run() override {
    const Format& chosen = *find_format(format);
    const RunRecord record = asked.found();
    ExportOptions options = wanted;
    options.stop = &stop_flag();
    if (!up.empty()) options.up = named<UpAxis>(up, up_axis_names);
    catch_stop_signals();
    try {
      const Exported exported = export_run(record, chosen, options);
      for (const std::string& note : exported.notes) print_text(stderr, "bendlab: {}\n", note);
      if (json)
        print_text("{}\n", json_text(to_json(record, chosen, exported)));
      else
        print_exported(record, exported);
      return exit_ok;
    } catch (const ExportStopped&) {
      print_text(stderr, "bendlab: stopped; nothing was written\n");
      return stop_exit_code();
    }
  }
};

}  // namespace

extern const CommandKind export_command{
    "export", "Write a run for Blender, Houdini, a spreadsheet or other programs",
    "bendlab export results/first/cells=16 --format usda --to first.usda", make<ExportCommand>};

}  // namespace bendlab
