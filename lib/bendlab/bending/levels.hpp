// The levels of the paper: m for free vertices, n for pinned ones, from the mesh (Kim, eqs. 6-8).
#pragma once

#include <array>

#include "bendlab/bending/model.hpp"

namespace bendlab {

/// How m becomes an integer.
enum class Rounding { floor, round, ceil };
inline constexpr std::array<std::string_view, 3> rounding_names = {"floor", "round", "ceil"};

struct Levels {
  double m_unrounded = 0;  ///< Ω / e_avg · 0.1 + 1, or radius / e_avg
  int m = 1;               ///< of free vertices
  int n = 3;               ///< of pinned vertices
};

/// Ω = |AABB_max - AABB_min| / 2 · 0.5, m = max(Ω / e_avg · 0.1 + 1, 1), n = 2 m + 1, times the multiplier.
/// Given a radius, m is the nearest whole number of edges in it; without a denser zone at pins n = m.
Levels adaptive_levels(const RestMesh& rest, const ParameterValues& values);

/// The same from the diagonal of the rest box and the mean edge, m.
Levels adaptive_levels(double size, double mean_edge, const ParameterValues& values);

/// #V: `pinned_level` where the vertex counts as pinned, `free_level` elsewhere.
std::vector<int> level_of_vertices(const RestMesh& rest, const Pins& pins, const ParameterValues& values,
                                   int free_level, int pinned_level);

std::vector<BendingFact> facts_of(const Levels& levels);

/// The settings that both functions read.
inline constexpr std::array level_parameters = {
    Parameter{
        .name = "m_rounding",
        .type = ParameterType::text,
        .default_value = "floor",
        .meaning =
            "how m becomes an integer; it matters, because eq. 6 lands just under integers on usual grids",
        .choices = rounding_names},
    Parameter{
        .name = "m_min",
        .type = ParameterType::integer,
        .unit = "1",
        .default_value = 1,
        .meaning =
            "lower bound on m (eq. 6 says 1; the paper's own bound was lost in the scan). With m = 1 free "
            "vertices have no springs beyond the mesh's edges",
        .minimum = 1,
        .maximum = 1000},
    Parameter{.name = "n_multiplier",
              .type = ParameterType::integer,
              .unit = "1",
              .default_value = 1,
              .meaning = "scales n = 2 m + 1; the paper's material control (Fig. 7)",
              .minimum = 1,
              .maximum = 100},
    Parameter{.name = "pinned_ring_is_pinned",
              .type = ParameterType::boolean,
              .default_value = true,
              .meaning = "vertices pinned with a pin's rings count as pinned for n, or only the pin itself"},
    Parameter{
        .name = "radius",
        .type = ParameterType::number,
        .unit = "m",
        .default_value = 0.0,
        .meaning =
            "physical length of the springs: m = radius / mean edge, rounded to the nearest, instead of "
            "eq. 6; 0: eq. 6",
        .minimum = 0},
    Parameter{
        .name = "pin_zone",
        .type = ParameterType::boolean,
        .default_value = true,
        .meaning = "pinned vertices have the level n = 2 m + 1 (times n_multiplier), or m as all others"},
};

}  // namespace bendlab
