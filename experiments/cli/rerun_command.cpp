// `bendlab rerun`: computes a run again from its file.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <stdlib.h>

#include <filesystem>
#include <optional>

#include "bendlab/scene/json_text.hpp"
#include "experiments/campaign/rerun.hpp"
#include "experiments/cli/find_run.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/signals.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

// A temporary folder, removed by the destructor.
class ScratchFolder {
 public:
  ScratchFolder() : path_((fs::temp_directory_path() / "bendlab-rerun-XXXXXX").string()) {
    if (!mkdtemp(path_.data()))
      throw RunFileError(
          fmt::format("no folder can be made in '{}'; name a folder for the new run with --out",
                      fs::temp_directory_path().string()));
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

Json to_json(const RunRecord& run, const Repetition& repetition) {
  Json changed = Json::object();
  for (const auto& [name, texts] : repetition.changed)
    changed[name] = {{"then", texts.first}, {"now", texts.second}};
  return {{"run", run.id},
          {"file", run.file.string()},
          {"repeated", repetition.outcome.file.string()},
          {"status", to_string(repetition.outcome.status)},
          {"same_bits", repetition.differing_parts.empty()},
          {"differing_parts", repetition.differing_parts},
          {"changed", changed}};
}

void print(const RunRecord& run, const Repetition& repetition) {
  print_text("{}  {}\n", run.id, run.file.string());
  if (repetition.differing_parts.empty())
    print_text("repeated: the same bits in every frame and metric\n");
  else
    print_text("repeated: DIFFERENT BITS in {}\n", fmt::join(repetition.differing_parts, ", "));
  if (repetition.changed.empty()) {
    print_text("by the same program, on the same machine, with the same libraries as before\n");
    return;
  }
  Table table({"changed since", "then", "now"});
  for (const auto& [name, texts] : repetition.changed) table.add_row({name, texts.first, texts.second});
  print_text("\n{}", table.text());
}

struct RerunCommand : Command {
  RunArgument asked{*this};
  fs::path out;  // empty: the new run is not kept

  RerunCommand() {
    add(out, "--out", "Keep the new run in this folder (default: the new run is not kept)");
    add(json, "--json", "Print one JSON object");
  }

  int run() override {
    const RunRecord run = asked.found();
    if (!is_over(run.status))
      throw UsageError(fmt::format("'{}' is {}: only a run that has ended can be repeated", run.file.string(),
                                   to_string(run.status)));
    catch_stop_signals();
    std::optional<ScratchFolder> scratch;
    if (out.empty()) scratch.emplace();
    const Repetition repetition =
        repeat(run, scratch ? fs::path(scratch->path()) : out, {.stop = &stop_flag()});
    if (stop_exit_code() != 0) return stop_exit_code();
    if (json)
      print_text("{}\n", json_text(to_json(run, repetition)));
    else
      print(run, repetition);
    return repetition.differing_parts.empty() ? exit_ok : exit_failed;
  }
};

}  // namespace

extern const CommandKind rerun_command{"rerun",
                                       "Compute a run again from its file, and say whether the bits agree",
                                       "bendlab rerun results/first/cells=16", make<RerunCommand>};

}  // namespace bendlab
