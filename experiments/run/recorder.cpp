#include "experiments/run/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bendlab/metrics/motion.hpp"

namespace bendlab {
namespace {

// The columns before the mesh quality, in order.
enum Metric : std::size_t {
  kinetic_energy,
  linear_momentum,
  angular_momentum,
  mean_strain,
  max_stretch,
  pin_max_stretch,
  pin_region_stretch,
  drop,
  degenerate_triangles,
  needles,
  caps,
  collinear,
  small_angles,
  first_quality
};

const Column columns[first_quality] = {
    {"kinetic_energy", "J", "of all vertices as point masses"},
    {"linear_momentum", "kg m/s", "its magnitude"},
    {"angular_momentum", "kg m²/s", "its magnitude, about the centre of mass"},
    {"mean_strain", "1", "mean over triangles of max(|σ₁ - 1|, |σ₂ - 1|), σ the principal stretches"},
    {"max_stretch", "1", "largest σ₁"},
    {"pin_max_stretch", "1", "largest σ₁ over triangles that touch a pinned vertex"},
    {"pin_region_stretch", "1", "largest σ₁ within 0.1 sizes of a pin that the scene names"},
    {"drop", "m",
     "how far the lowest vertex hangs below the highest pin (without pins: below where it started)"},
    {"degenerate_triangles", "1", "needles, caps, collinear and non-finite triangles"},
    {"needles", "1", "longest edge at least needle_ratio times the shortest"},
    {"caps", "1", "an angle of at least cap_angle"},
    {"collinear", "1", "three points exactly on a line"},
    {"small_angles", "1", "an angle below small_angle"},
};

struct Statistic {
  const char* name;
  double MeasureSummary::*value;
};
constexpr Statistic statistics[] = {{"minimum", &MeasureSummary::minimum},
                                    {"percentile_1", &MeasureSummary::percentile_1},
                                    {"median", &MeasureSummary::median},
                                    {"percentile_99", &MeasureSummary::percentile_99},
                                    {"maximum", &MeasureSummary::maximum}};

// Calls visit(measure index, statistic, name) for every column of mesh quality.
template <class Visit>
void for_quality_columns(Visit visit) {
  for (std::size_t m = 0; m < quality_measures().size(); ++m)
    for (const Statistic& statistic : statistics)
      visit(m, statistic, fmt::format("{}_{}", quality_measures()[m].name, statistic.name));
}

double highest_level(const Scene& scene) {
  const Positions& start = scene.input.positions;
  double highest = std::numeric_limits<double>::infinity();  // along `down`: the smallest
  for (const int seed : scene.pins.seeds) highest = std::min(highest, start.row(seed).dot(scene.down));
  return scene.pins.seeds.empty() ? (start * scene.down).maxCoeff() : highest;
}

}  // namespace

Recorder::Recorder(const Scene& scene)
    : scene_(scene), stretch_(scene.rest, scene.pins), pin_level_(highest_level(scene)) {}

std::vector<Column> Recorder::metrics() const {
  std::vector<Column> all(std::begin(columns), std::end(columns));
  for_quality_columns([&](std::size_t m, const Statistic& statistic, const std::string& name) {
    const QualityMeasure& measure = quality_measures()[m];
    all.push_back({name, std::string(measure.unit),
                   fmt::format("{} over triangles: {}", statistic.name, measure.meaning)});
  });
  return all;
}

std::vector<Column> Recorder::cell_fields() const {
  return {{"max_stretch", "1", "larger principal stretch σ₁"},
          {"min_stretch", "1", "smaller principal stretch σ₂"}};
}

Frame Recorder::capture(const Simulation& simulation) const {
  const Positions positions = simulation.positions();
  const Motion motion = motion_of(scene_.input.mass, positions, simulation.velocities());
  Frame frame;
  frame.time = simulation.time();
  frame.positions.assign(positions.data(), positions.data() + positions.size());
  frame.metrics = {motion.kinetic_energy, motion.linear_momentum.norm(), motion.angular_momentum.norm()};
  return frame;
}

double Recorder::kinetic_energy_of(const Frame& frame) {
  return frame.metrics[kinetic_energy];
}

void Recorder::show(const Frame& frame, Plausibility& plausibility) const {
  plausibility.look_at_stretch(frame.time, frame.metrics[mean_strain], frame.cell_fields[0],
                               as_rows(frame.positions));
}

void Recorder::complete(Frame& frame) {
  const Positions positions = as_rows(frame.positions);
  const std::vector<PrincipalStretches> stretches = stretch_.measure(positions);
  const StretchSummary stretch = stretch_.summarise(stretches);
  const MeshQuality quality = measure_quality(positions, scene_.rest.triangles(), scene_.thresholds);
  frame.metrics.resize(first_quality);
  frame.metrics[mean_strain] = stretch.mean_strain;
  frame.metrics[max_stretch] = stretch.max_stretch;
  frame.metrics[pin_max_stretch] = stretch.pin_max_stretch;
  frame.metrics[pin_region_stretch] = stretch.pin_region_stretch;
  frame.metrics[drop] = drop_below(pin_level_, positions, scene_.down);
  frame.metrics[degenerate_triangles] = quality.degenerate_triangles;
  frame.metrics[needles] = quality.needles;
  frame.metrics[caps] = quality.caps;
  frame.metrics[collinear] = quality.collinear;
  frame.metrics[small_angles] = quality.small_angles;
  for_quality_columns([&](std::size_t m, const Statistic& statistic, const std::string&) {
    frame.metrics.push_back(quality.measures[m].*statistic.value);
  });
  frame.cell_fields.assign(2, {});
  for (const PrincipalStretches& s : stretches) {
    frame.cell_fields[0].push_back(static_cast<float>(s.largest));
    frame.cell_fields[1].push_back(static_cast<float>(s.smallest));
  }
  times_.push_back(frame.time);
  rows_.push_back(frame.metrics);
}

double Recorder::last_second_median(std::size_t column) const {
  constexpr double rounding = 1e-9;  // s; a frame exactly one second before the end is not in it
  std::vector<double> values;
  for (std::size_t f = 0; f < times_.size(); ++f)
    if (times_[f] > times_.back() - 1 + rounding || times_.size() == 1) values.push_back(rows_[f][column]);
  if (std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); }))
    return std::numeric_limits<double>::quiet_NaN();
  const std::size_t middle = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(middle), values.end());
  if (values.size() % 2 == 1) return values[middle];
  return 0.5 * (values[middle] +
                *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(middle)));
}

std::map<std::string, double> Recorder::summary(const Simulation& simulation) const {
  std::map<std::string, double> summary = {
      {"size", scene_.rest.size()},
      {"vertices", scene_.rest.vertex_count()},
      {"triangles", scene_.rest.triangle_count()},
      {"springs", static_cast<double>(scene_.input.distance.size())},
      {"bending_constraints",
       static_cast<double>(scene_.input.distance.size() + element_count(scene_.input.elements))},
      {"springs_beyond_ring_1", scene_.springs_beyond_ring_1},
      {"pinned_vertices", static_cast<double>(scene_.pins.all.size())},
      {"projections", static_cast<double>(simulation.projections())},
      {"substeps", static_cast<double>(simulation.substeps())},
      {"memory_bytes", static_cast<double>(simulation.memory_bytes())},
  };
  if (const std::optional<double> unbalanced = simulation.unbalanced()) summary["unbalanced"] = *unbalanced;
  for (const BendingFact& fact : scene_.bending_facts) summary["model_" + fact.name] = fact.value;
  if (rows_.empty()) return summary;
  for (const Metric metric :
       {mean_strain, max_stretch, pin_max_stretch, pin_region_stretch, drop, kinetic_energy}) {
    summary[columns[metric].name] = last_second_median(metric);
    summary[columns[metric].name + "_last"] = rows_.back()[metric];
  }
  summary["degenerate_triangles"] = rows_.back()[degenerate_triangles];
  summary["degenerate_triangles_median"] = last_second_median(degenerate_triangles);
  double worst = 0, most_degenerate = 0;
  for (const std::vector<double>& row : rows_) {
    worst = std::max(worst, row[max_stretch]);
    most_degenerate = std::max(most_degenerate, row[degenerate_triangles]);
  }
  summary["worst_stretch"] = worst;
  summary["degenerate_triangles_worst"] = most_degenerate;

  const MeshQuality rest =
      measure_quality(scene_.rest.positions(), scene_.rest.triangles(), scene_.thresholds);
  summary["rest_degenerate_triangles"] = rest.degenerate_triangles;
  for_quality_columns([&](std::size_t m, const Statistic& statistic, const std::string& name) {
    summary["rest_" + name] = rest.measures[m].*statistic.value;
  });
  // A pin metric of a cloth without pins is not a number, and is left out.
  std::erase_if(summary, [](const auto& entry) { return std::isnan(entry.second); });
  return summary;
}

}  // namespace bendlab
