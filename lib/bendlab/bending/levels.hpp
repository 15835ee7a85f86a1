// The levels of the paper: m for free vertices, n for pinned ones, from the mesh (Kim, eqs. 6-8).
#pragma once

#include <array>

#include "bendlab/bending/model.hpp"

namespace bendlab {

/// How m becomes an integer.
enum class Rounding { floor, round, ceil };
inline constexpr std::array<std::string_view, 3> rounding_names = {"floor", "round", "ceil"};

/// The settings of models that have levels.
struct LevelSettings {
  Rounding m_rounding = Rounding::floor;
  int m_min = 1;
  int n_multiplier = 1;
  bool pinned_ring_is_pinned = true;
  double radius = 0;  ///< m; 0: eq. 6
  bool pin_zone = true;
};

struct Levels {
  double m_unrounded = 0;  ///< Ω / e_avg · 0.1 + 1, or radius / e_avg
  int m = 1;               ///< of free vertices
  int n = 3;               ///< of pinned vertices
};

/// Ω = |AABB_max - AABB_min| / 2 · 0.5, m = max(Ω / e_avg · 0.1 + 1, 1), n = 2 m + 1, times the multiplier.
/// Given a radius, m is the nearest whole number of edges in it; without a denser zone at pins n = m.
Levels adaptive_levels(const BendingInput& input, const LevelSettings& settings);

/// The same from the diagonal of the rest box and the mean edge, m.
Levels adaptive_levels(double size, double mean_edge, const LevelSettings& settings);

/// #V: `pinned_level` where the vertex counts as pinned, `free_level` elsewhere.
std::vector<int> level_of_vertices(const RestMesh& rest, const Pins& pins, const LevelSettings& settings,
                                   int free_level, int pinned_level);

std::vector<BendingFact> facts_of(const Levels& levels);

template <class Settings>
inline constexpr std::array level_fields = {
    field<&Settings::m_rounding, Settings>(
        {.name = "m_rounding",
         .meaning =
             "how m becomes an integer; it matters, because eq. 6 lands just under integers on usual grids",
         .choices = rounding_names}),
    field<&Settings::m_min, Settings>(
        {.name = "m_min",
         .unit = "1",
         .meaning =
             "lower bound on m (eq. 6 says 1; the paper's own bound was lost in the scan). With m = 1 free "
             "vertices have no springs beyond the mesh's edges",
         .minimum = 1,
         .maximum = 1000}),
    field<&Settings::n_multiplier, Settings>(
        {.name = "n_multiplier",
         .unit = "1",
         .meaning = "scales n = 2 m + 1; the paper's material control (Fig. 7)",
         .minimum = 1,
         .maximum = 100}),
    field<&Settings::pinned_ring_is_pinned, Settings>(
        {.name = "pinned_ring_is_pinned",
         .meaning = "vertices pinned with a pin's rings count as pinned for n, or only the pin itself"}),
    field<&Settings::radius, Settings>(
        {.name = "radius",
         .unit = "m",
         .meaning =
             "physical length of the springs: m = radius / mean edge, rounded to the nearest, instead of "
             "eq. 6; 0: eq. 6",
         .minimum = 0}),
    field<&Settings::pin_zone, Settings>(
        {.name = "pin_zone",
         .meaning = "pinned vertices have the level n = 2 m + 1 (times n_multiplier), or m as all others"}),
};

}  // namespace bendlab
