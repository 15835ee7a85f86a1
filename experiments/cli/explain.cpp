// `bendlab run --explain`: the passes (parts) of a scene's step, and the effects that changed nothing.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bendlab/effects/effect.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/cli/report.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

// Parts of a run that take time outside of the steps.
constexpr std::array around_the_steps = {
    MethodPass{"set_up", "mesh, constraints, colouring; once"},
    MethodPass{"recording", "/output: metrics and the run file"},
};

// Whether a pass belongs to the effect `name`, as "plane 2" and "self_collision: candidates" do.
bool belongs(const std::string& pass, const std::string& name) {
  return pass == name || pass.starts_with(name + ":");
}

std::string reason_of(const std::string& pass, const RunConfig& config, const std::vector<Effect>& effects) {
  for (std::size_t index = 0; index < effects.size(); ++index)
    if (belongs(pass, pass_name(effects, index)))
      return fmt::format("/effects/{}: {}", index, effects[index].kind().summary);
  if (pass == "yield") return "/bending/hysteresis, /bending/plasticity: bends beyond the yield stay";
  if (pass == "bending") return fmt::format("/bending/model: {}", config.scene().bending.model.name());
  const MethodKind& method = config.scene().solver.method.kind();
  for (const std::span<const MethodPass> passes :
       {method.passes, std::span<const MethodPass>(around_the_steps)})
    if (const auto found = std::ranges::find(passes, pass, &MethodPass::name); found != passes.end())
      return std::string(found->why);
  return "";
}

// Lists the effects that changed nothing: effects without a pass, and effects whose passes never acted.
std::string ineffective_text(const RunOutcome& outcome, const std::vector<Effect>& effects) {
  std::string text;
  for (std::size_t index = 0; index < effects.size(); ++index) {
    std::uint64_t acted = 0;
    bool has_pass = false;
    for (const PassTime& pass : outcome.passes)
      if (belongs(pass.name, pass_name(effects, index))) has_pass = true, acted += pass.acted;
    if (acted > 0) continue;
    text += fmt::format("  /effects/{} {}: {}\n", index, effects[index].name(),
                        has_pass ? "ran and changed nothing" : "has no pass in this scene");
  }
  return text.empty() ? "every listed effect did something in this run\n"
                      : "did nothing in this run and can be removed from the config:\n" + text;
}

}  // namespace

std::string explain_text(const CampaignRun& run) {
  if (!run.outcome) return run_text(run) + ": no run to explain\n";
  const std::vector<Effect>& effects = run.config->scene().effects;
  double all = 0;
  for (const PassTime& pass : run.outcome->passes) all += pass.seconds;
  Table table({"pass", "why it is there", "calls", "changed", "ms", "share"});
  for (const PassTime& pass : run.outcome->passes)
    table.add_row({pass.name, reason_of(pass.name, *run.config, effects), std::to_string(pass.calls),
                   pass.acted > 0 ? format_number(static_cast<double>(pass.acted)) : "",
                   fmt::format("{:.1f}", 1e3 * pass.seconds),
                   fmt::format("{:.1f} %", all > 0 ? 100 * pass.seconds / all : 0.0)});
  return fmt::format("step plan of {}\n\n{}\n{}", run_text(run), table.text(),
                     ineffective_text(*run.outcome, effects));
}

}  // namespace bendlab
