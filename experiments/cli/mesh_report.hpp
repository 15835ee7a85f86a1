// The report of `bendlab mesh` about a mesh: counts, the paper's coarse levels, and the quality of the
// triangles.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "bendlab/mesh/quality.hpp"

namespace bendlab {

/// The report as text for a terminal. The mesh must have passed diagnose().
std::string mesh_report(const TriangleMesh& mesh, std::string_view name,
                        const QualityThresholds& thresholds = {});

/// The same report as JSON: {name, vertices, triangles, edges, boundary_edges, pieces, euler_number, size_m:
/// [x, y, z], mean_edge_length_m, levels: {omega_m, m_unrounded, m, n}, quality: {measure: {unit, minimum,
/// percentile_1, median, percentile_99, maximum}}, counts, thresholds}. JSON has no infinite numbers, so an
/// infinite value is written as the text "infinity".
nlohmann::ordered_json mesh_report_json(const TriangleMesh& mesh, std::string_view name,
                                        const QualityThresholds& thresholds = {});

}  // namespace bendlab
