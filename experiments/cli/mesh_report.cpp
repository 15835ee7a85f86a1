#include "experiments/cli/mesh_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bendlab/bending/levels.hpp"
#include "bendlab/mesh/connected_parts.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

using Json = nlohmann::ordered_json;

struct Topology {
  int edges = 0, boundary_edges = 0, pieces = 0, euler_number = 0;
};

Topology topology_of(const RestMesh& rest) {
  Topology topology;
  topology.edges = static_cast<int>(rest.edges().rows());
  topology.boundary_edges = topology.edges - static_cast<int>(rest.hinges().size());
  topology.pieces = static_cast<int>(connected_parts(rest.one_ring()).size());
  topology.euler_number = rest.vertex_count() - topology.edges + rest.triangle_count();
  return topology;
}

// Ω of the paper (eqs. 6-8), m.
double omega_of(const RestMesh& rest) {
  return rest.size() / 2 * 0.5;
}

Levels levels_of(const RestMesh& rest) {
  return adaptive_levels(rest.size(), rest.mean_edge_length(), LevelSettings{});
}

struct Count {
  std::string_view name;
  int value;
  std::string meaning;
};

std::vector<Count> counts_of(const MeshQuality& quality, const QualityThresholds& thresholds) {
  return {{"needles", quality.needles,
           fmt::format("longest edge at least {} times the shortest", thresholds.needle_ratio)},
          {"caps", quality.caps, fmt::format("an angle of at least {}°", thresholds.cap_angle)},
          {"collinear", quality.collinear, "the three points lie exactly on one line"},
          {"degenerate_triangles", quality.degenerate_triangles, "needle, cap or collinear"},
          {"small_angles", quality.small_angles, fmt::format("an angle below {}°", thresholds.small_angle)}};
}

std::string topology_text(const RestMesh& rest) {
  const Topology topology = topology_of(rest);
  const Vector3 size = rest.box_max() - rest.box_min();
  return fmt::format(
      "  vertices {}, triangles {}, edges {} ({} on the boundary)\n"
      "  pieces {}, Euler number {}\n"
      "  size {} × {} × {} m, mean edge {} m\n",
      rest.vertex_count(), rest.triangle_count(), topology.edges, topology.boundary_edges, topology.pieces,
      topology.euler_number, format_number(size.x()), format_number(size.y()), format_number(size.z()),
      format_number(rest.mean_edge_length()));
}

std::string quality_text(const MeshQuality& quality, const QualityThresholds& thresholds) {
  Table measures({"measure", "min", "1 %", "median", "99 %", "max", ""});
  for (std::size_t m = 0; m < quality.measures.size(); ++m) {
    const MeasureSummary& s = quality.measures[m];
    const QualityMeasure& measure = quality_measures()[m];
    measures.add_row({std::string(measure.name), format_number(s.minimum), format_number(s.percentile_1),
                      format_number(s.median), format_number(s.percentile_99), format_number(s.maximum),
                      measure.unit == "1" ? "" : std::string(measure.unit)});
  }
  Table counts({"bad triangles", "count", "which"});
  for (const Count& count : counts_of(quality, thresholds))
    counts.add_row({std::string(count.name), fmt::format("{}", count.value), count.meaning});
  return measures.text() + "\n" + counts.text();
}

Json number_or_text(double value) {
  return std::isfinite(value) ? Json(value) : Json("infinity");
}

Json quality_json(const MeshQuality& quality) {
  Json json = Json::object();
  for (std::size_t m = 0; m < quality.measures.size(); ++m) {
    const MeasureSummary& s = quality.measures[m];
    const QualityMeasure& measure = quality_measures()[m];
    json[std::string(measure.name)] = {{"unit", measure.unit},
                                       {"minimum", number_or_text(s.minimum)},
                                       {"percentile_1", number_or_text(s.percentile_1)},
                                       {"median", number_or_text(s.median)},
                                       {"percentile_99", number_or_text(s.percentile_99)},
                                       {"maximum", number_or_text(s.maximum)}};
  }
  return json;
}

}  // namespace

std::string mesh_report(const TriangleMesh& mesh, std::string_view name,
                        const QualityThresholds& thresholds) {
  const RestMesh rest(mesh);
  const Levels levels = levels_of(rest);
  return fmt::format(
      "{}\n{}"
      "  the paper's levels (eqs. 6-8): Ω {} m, unrounded m {:.3f}, m = {}, n = {}\n\n{}",
      name, topology_text(rest), format_number(omega_of(rest)), levels.m_unrounded, levels.m, levels.n,
      quality_text(measure_quality(mesh.positions, mesh.triangles, thresholds), thresholds));
}

nlohmann::ordered_json mesh_report_json(const TriangleMesh& mesh, std::string_view name,
                                        const QualityThresholds& thresholds) {
  const RestMesh rest(mesh);
  const Topology topology = topology_of(rest);
  const Levels levels = levels_of(rest);
  const Vector3 size = rest.box_max() - rest.box_min();
  const MeshQuality quality = measure_quality(mesh.positions, mesh.triangles, thresholds);
  Json counts = Json::object();
  for (const Count& count : counts_of(quality, thresholds)) counts[std::string(count.name)] = count.value;
  return {
      {"name", name},
      {"vertices", rest.vertex_count()},
      {"triangles", rest.triangle_count()},
      {"edges", topology.edges},
      {"boundary_edges", topology.boundary_edges},
      {"pieces", topology.pieces},
      {"euler_number", topology.euler_number},
      {"size_m", {size.x(), size.y(), size.z()}},
      {"mean_edge_length_m", rest.mean_edge_length()},
      {"levels",
       {{"omega_m", omega_of(rest)}, {"m_unrounded", levels.m_unrounded}, {"m", levels.m}, {"n", levels.n}}},
      {"quality", quality_json(quality)},
      {"counts", counts},
      {"thresholds",
       {{"needle_ratio", thresholds.needle_ratio},
        {"cap_angle", thresholds.cap_angle},
        {"small_angle", thresholds.small_angle}}}};
}

}  // namespace bendlab
