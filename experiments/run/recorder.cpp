#include "experiments/run/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "bendlab/solver/method.hpp"

namespace bendlab {

Recorder::Recorder(const RunConfig& config, const BuiltScene& scene)
    : stretch_(scene.rest, scene.pins), has_motion_(scene.input.method.kind().has_motion) {
  const auto append = [](std::vector<Column>& all, const std::function<std::vector<Column>()>& own) {
    const std::size_t before = all.size();
    for (Column& column : own()) all.push_back(std::move(column));
    return all.size() - before;
  };
  for (const Measure* measure : measures()) {
    if (!applies(*measure, config, scene)) continue;
    Active active{measure, measure->begin(config, scene), columns_.size(), 0, fields_.size(), 0};
    active.columns = append(columns_, measure->columns);
    active.fields = append(fields_, measure->fields);
    active_.push_back(std::move(active));
  }
}

void Recorder::step(const Simulation& simulation, const Moment& moment) {
  for (const Active& active : active_) active.measurement->step(simulation, moment);
}

Frame Recorder::capture(const Simulation& simulation) const {
  const Positions positions = simulation.positions();
  Frame frame;
  frame.time = simulation.time();
  frame.positions.assign(positions.data(), positions.data() + positions.size());
  frame.metrics.assign(columns_.size(), std::numeric_limits<double>::quiet_NaN());
  for (const Active& active : active_)
    active.measurement->capture(simulation, positions,
                                std::span(frame.metrics).subspan(active.column, active.columns));
  return frame;
}

void Recorder::complete(Frame& frame, Plausibility& plausibility) {
  const Positions positions = as_rows(frame.positions);
  frame.cell_fields.assign(fields_.size(), {});
  const MeasuredFrame measured(frame.time, positions, stretch_, columns_, frame.metrics);
  for (const Active& active : active_)
    active.measurement->complete(measured, std::span(frame.metrics).subspan(active.column, active.columns),
                                 std::span(frame.cell_fields).subspan(active.field, active.fields));
  plausibility.look_at_stretch(frame.time, measured.stretch().mean_strain, measured.stretches(), positions);
  times_.push_back(frame.time);
  rows_.push_back(frame.metrics);
}

void Recorder::archive(Archive& state) {
  for (const Active& active : active_) active.measurement->archive(state);
}

void Recorder::take_earlier(const EarlierFrames& earlier) {
  const std::vector<MetricRecord> metrics = read_metrics(earlier.file);
  const auto values_of = [&](const std::string& name) -> const std::vector<double>& {
    const auto metric = std::ranges::find(metrics, name, [](const MetricRecord& m) { return m.column.name; });
    if (metric == metrics.end() || metric->values.size() < earlier.frames)
      throw RunFileError(fmt::format("{}: it has fewer than {} values of '{}'", earlier.file.string(),
                                     earlier.frames, name));
    return metric->values;
  };
  const auto count = static_cast<std::ptrdiff_t>(earlier.frames);
  times_.assign(values_of("time").begin(), values_of("time").begin() + count);
  rows_.assign(earlier.frames, std::vector<double>(columns_.size()));
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const std::vector<double>& values = values_of(columns_[c].name);
    for (std::size_t f = 0; f < rows_.size(); ++f) rows_[f][c] = values[f];
  }
}

Findings Recorder::findings(const RunEnd& end, bool of_those_that_make_runs) {
  Findings findings;
  for (const Active& active : active_)
    if (active.measure->makes_runs == of_those_that_make_runs) active.measurement->finish(end, findings);
  return findings;
}

std::map<std::string, double> facts_of(const BuiltScene& scene, const Simulation& simulation) {
  std::map<std::string, double> facts = {
      {"size", scene.rest.size()},
      {"edge_length", scene.rest.mean_edge_length()},
      {"vertices", scene.rest.vertex_count()},
      {"triangles", scene.rest.triangle_count()},
      {"springs", static_cast<double>(scene.input.distance.size())},
      {"bending_constraints",
       static_cast<double>(scene.input.distance.size() + element_count(scene.input.elements) +
                           scene.input.own.size())},
      {"springs_beyond_ring_1", scene.springs_beyond_ring_1},
      {"pinned_vertices", static_cast<double>(scene.pins.all.size())},
      {"projections", static_cast<double>(simulation.projections())},
      {"substeps", static_cast<double>(simulation.substeps())},
      {"memory_bytes", static_cast<double>(simulation.memory_bytes())},
  };
  if (const std::optional<double> unbalanced = simulation.unbalanced()) facts["unbalanced"] = *unbalanced;
  if (const std::optional<double> softness = simulation.membrane_softness())
    facts["membrane_softness"] = *softness;
  for (const BendingFact& fact : scene.bending_facts)
    if (!std::isnan(fact.value)) facts["model_" + fact.name] = fact.value;
  return facts;
}

}  // namespace bendlab
