// The LOD levels of the paper (Kim, eqs. 6-8): m for free vertices and n for pinned vertices, from the mesh.
// A vertex's level is the farthest ring that its springs reach.
#pragma once

#include <array>

#include "bendlab/bending/model.hpp"

namespace bendlab {

/// How m becomes an integer.
enum class Rounding { floor, round, ceil };
inline constexpr std::array<std::string_view, 3> rounding_names = {"floor", "round", "ceil"};

/// The settings of models that have LOD levels.
struct LevelSettings {
  Rounding m_rounding = Rounding::floor;
  int m_min = 1;
  int n_multiplier = 1;
  bool pinned_ring_is_pinned = true;
  double radius = 0;  ///< m; 0: m follows from eq. 6
  bool pin_zone = true;
};

struct Levels {
  double m_unrounded = 0;  ///< Ω / e_avg · 0.1 + 1, or radius / e_avg
  int m = 1;               ///< level of free vertices
  int n = 3;               ///< level of pinned vertices
};

/// Ω = |AABB_max - AABB_min| / 2 · 0.5, m = max(Ω / e_avg · 0.1 + 1, m_min) as an integer, and
/// n = (2 m + 1) · n_multiplier. Given a radius, m is radius / e_avg, rounded to the nearest integer. Without
/// a denser zone at pins, n = m.
Levels adaptive_levels(const BendingInput& input, const LevelSettings& settings);

/// The levels from the diagonal of the rest box, `size`, and the mean edge length, `mean_edge`, in m.
Levels adaptive_levels(double size, double mean_edge, const LevelSettings& settings);

/// #V: `pinned_level` where the vertex counts as pinned, `free_level` elsewhere.
std::vector<int> level_of_vertices(const RestMesh& rest, const Pins& pins, const LevelSettings& settings,
                                   int free_level, int pinned_level);

std::vector<BendingFact> facts_of(const Levels& levels);

template <class Settings>
inline constexpr std::array level_fields = {
    field<&Settings::m_rounding, Settings>(
        {.name = "m_rounding",
         .meaning = "how m is rounded to an integer; this matters, because eq. 6 gives values just below "
                    "integers on usual grids",
         .choices = rounding_names}),
    field<&Settings::m_min, Settings>(
        {.name = "m_min",
         .unit = "1",
         .meaning = "lower bound on m (1 in eq. 6; the bound in the paper is not legible in the scan). With "
                    "m = 1 free vertices have no springs beyond the mesh's edges",
         .minimum = 1,
         .maximum = 1000}),
    field<&Settings::n_multiplier, Settings>(
        {.name = "n_multiplier",
         .unit = "1",
         .meaning = "factor on n = 2 m + 1, by which the paper controls the material (Fig. 7)",
         .minimum = 1,
         .maximum = 100}),
    field<&Settings::pinned_ring_is_pinned, Settings>(
        {.name = "pinned_ring_is_pinned",
         .meaning = "whether vertices that are pinned because they lie in a pin's rings also have the level "
                    "n; false: only the pin itself has it"}),
    field<&Settings::radius, Settings>({.name = "radius",
                                        .unit = "m",
                                        .meaning = "physical length of the springs: m is radius / mean edge, "
                                                   "rounded to the nearest integer; 0: m follows from eq. 6",
                                        .minimum = 0}),
    field<&Settings::pin_zone, Settings>(
        {.name = "pin_zone",
         .meaning = "whether pinned vertices have the level n = 2 m + 1 (times n_multiplier); false: they "
                    "have the level m, as all other vertices do"}),
};

}  // namespace bendlab
