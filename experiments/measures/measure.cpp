#include "experiments/measures/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "bendlab/settings/family.hpp"
#include "bendlab/settings/median.hpp"
#include "experiments/config/config_tables.hpp"

namespace bendlab {

namespace measure {
extern const Measure motion, stretch, drop, quality, stability, effective_stiffness, stiffness, drape,
    step_residual, accuracy, energy, keyframes;
}

namespace {

constexpr std::array listed = {&measure::motion,    &measure::stretch,   &measure::drop,
                               &measure::quality,   &measure::stability, &measure::effective_stiffness,
                               &measure::stiffness, &measure::drape,     &measure::step_residual,
                               &measure::accuracy,  &measure::energy,    &measure::keyframes};

std::size_t index_of(std::span<const Column> columns, std::string_view name) {
  const auto column = std::ranges::find(columns, name, &Column::name);
  if (column == columns.end())
    throw std::logic_error("no measure of this run has the metric " + std::string(name));
  return static_cast<std::size_t>(column - columns.begin());
}

const std::vector<Column>& facts() {
  static const std::vector<Column> rows = {
      {"size", "m", "diagonal of the box around the rest shape"},
      {"edge_length", "m", "mean length of an edge at rest"},
      {"vertices", "1", "number of vertices of the mesh"},
      {"triangles", "1", "number of triangles of the mesh"},
      {"springs", "1", "springs that resist bending"},
      {"bending_constraints", "1", "springs and other elements that resist bending"},
      {"springs_beyond_ring_1", "1", "springs between vertices that no edge joins"},
      {"pinned_vertices", "1", "number of pinned vertices, including those in the rings around pins"},
      {"projections", "1", "how many constraints the solver projected"},
      {"substeps", "1", "how many substeps the solver made"},
      {"memory_bytes", "B",
       "memory of the solver's arrays: points, constraints, multipliers, matrix and factor"},
      {"unbalanced", "1",
       "unbalanced forces at the end divided by the loads; only for methods that find an equilibrium"},
      {"membrane_softness", "1",
       "compliance of the membrane divided by the stated compliance, if the method softened the membrane"},
      {"settled_at", "s", "time since which the cloth was slower than /settled_speed, which ended the run"}};
  return rows;
}

Registry<Measure>& registry() {
  static Registry<Measure> all("measure", listed);
  return all;
}

// Throws if an existing metric has the same name as a metric of `measure`. Checks the metrics in one member
// of Measure, `rows`: columns, fields or gives.
void check_names(const Measure& measure, std::function<std::vector<Column>()> Measure::*rows) {
  std::set<std::string, std::less<>> taken = {"time"};  // of a frame
  for (const Column& fact : facts()) taken.insert(fact.name);
  for (const Measure* other : registry().all())
    for (const Column& row : (other->*rows)()) taken.insert(row.name);
  for (const Column& row : (measure.*rows)())
    if (!taken.insert(row.name).second)
      throw std::invalid_argument(
          fmt::format("the measure '{}' cannot be registered: there is a metric '{}' already; choose another "
                      "name for the new metric (`bendlab measures` lists all names)",
                      measure.name, row.name));
}

std::vector<std::string_view> names_on_request() {
  std::vector<std::string_view> names;
  for (const Measure* measure : measures())
    if (!measure->applies) names.push_back(measure->name);
  return names;
}

}  // namespace

const std::vector<PrincipalStretches>& MeasuredFrame::stretches() const {
  if (!stretches_) stretches_ = meter_.measure(positions_);
  return *stretches_;
}

const StretchSummary& MeasuredFrame::stretch() const {
  if (!stretch_) stretch_ = meter_.summarise(stretches());
  return *stretch_;
}

double MeasuredFrame::value(std::string_view column) const {
  return values_[index_of(columns_, column)];
}

double FrameHistory::last(std::string_view column) const {
  return rows_.back()[index_of(columns_, column)];
}

double FrameHistory::largest(std::string_view column) const {
  const std::size_t index = index_of(columns_, column);
  double largest = 0;
  for (const std::vector<double>& row : rows_) largest = std::max(largest, row[index]);
  return largest;
}

double FrameHistory::last_second_median(std::string_view column) const {
  if (!has_motion_) return last(column);
  constexpr double rounding = 1e-9;  // s; a frame exactly one second before the end is left out
  const auto first = std::ranges::upper_bound(times_, times_.back() - 1 + rounding);
  return median(column, static_cast<std::size_t>(first - times_.begin()));
}

double FrameHistory::median(std::string_view column, std::size_t first) const {
  const std::size_t index = index_of(columns_, column);
  std::vector<double> values;
  for (std::size_t f = first; f < rows_.size(); ++f) values.push_back(rows_[f][index]);
  if (std::ranges::any_of(values, [](double v) { return std::isnan(v); }))
    return std::numeric_limits<double>::quiet_NaN();
  return bendlab::median(std::move(values));
}

std::span<const Measure* const> measures() {
  return registry().all();
}

void register_measure(const Measure& measure) {
  if (!measure.begin)
    throw std::invalid_argument(
        fmt::format("the measure '{}' cannot be registered: it has no begin()", measure.name));
  check_names(measure, &Measure::columns), check_names(measure, &Measure::fields);
  check_names(measure, &Measure::gives);
  registry().add(measure);
}

void remove_measure(std::string_view name) {
  registry().remove(name);
}

std::span<const Measure* const> added_measures() {
  return registry().added();
}

std::span<const std::string_view> measures_on_request() {
  return made_of_kinds<names_on_request>();
}

std::span<const Column> numbers_of_scene() {
  return facts();
}

bool is_asked_for(const Measure& measure, const RunConfig& config) {
  const std::vector<std::string>& asked = config.settings().output.measures;
  return std::ranges::find(asked, measure.name) != asked.end();
}

bool applies(const Measure& measure, const RunConfig& config, const BuiltScene& scene) {
  return measure.applies ? measure.applies(config, scene) : is_asked_for(measure, config);
}

bool always(const RunConfig&, const BuiltScene&) {
  return true;
}

}  // namespace bendlab
