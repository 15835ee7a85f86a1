// Springs from a vertex to the rings around it, for the models k_ring, adaptive and lod.
#pragma once

#include <array>
#include <functional>

#include "bendlab/bending/model.hpp"

namespace bendlab {

namespace choices {
inline constexpr std::array<std::string_view, 2> ring_distances = {"hops", "euclidean"};
inline constexpr std::array<std::string_view, 2> rest_lengths = {"euclidean", "path"};
inline constexpr std::array<std::string_view, 2> shared_pairs = {"once", "twice"};
inline constexpr std::array<std::string_view, 2> pinned_pairs = {"drop", "keep"};
}  // namespace choices

/// Which rings of a vertex with level L get springs.
enum class RingFill {
  all,           ///< rings 1 … L
  beyond_edges,  ///< rings 2 … L: ring 1 is the mesh's own edges
  last,          ///< ring L alone
  ends,          ///< rings 1 and L
};
inline constexpr std::array<std::string_view, 4> ring_fill_names = {"all", "beyond_edges", "last", "ends"};

/// The settings of models that join rings.
struct RingSettings {
  enum class Distance { hops, euclidean };
  enum class RestLength { euclidean, path };
  enum class SharedPairs { once, twice };
  enum class PinnedPairs { drop, keep };

  Distance distance = Distance::hops;
  RestLength rest_length = RestLength::euclidean;
  SharedPairs shared_pairs = SharedPairs::once;
  PinnedPairs pinned_pairs = PinnedPairs::drop;
};

struct RingRule {
  RingFill fill = RingFill::all;
  /// Ring r holds the vertices at a straight distance in (r - 1, r] mean edge lengths, instead of the
  /// vertices r edges away.
  bool euclidean_rings = false;
  bool path_rest_length = false;    ///< along mesh edges (the shortest of the paths with the fewest edges)
  bool shared_pairs_twice = false;  ///< a pair reached from both ends gives two springs
  bool keep_pinned_pairs = false;   ///< also join two pinned vertices, although this moves nothing
};

/// The springs from every vertex v to its rings, as `rule` says, with the LOD level `levels[v]` (0: no
/// springs). Ordered by vertex, then breadth-first.
DistanceConstraints ring_springs(const BendingInput& input, const std::vector<int>& levels,
                                 const RingRule& rule);

/// About how many of these springs there are per vertex, if most vertices have this level.
double springs_per_vertex(const RingRule& rule, int level);

template <class Settings>
inline constexpr std::array ring_rule_fields = {
    field<&Settings::distance, Settings>(
        {.name = "distance",
         .meaning = "how the rings around a vertex are counted: edges away (breadth-first), or straight "
                    "distance in mean edge lengths",
         .choices = choices::ring_distances}),
    field<&Settings::rest_length, Settings>(
        {.name = "rest_length",
         .meaning = "a spring's rest length: the straight distance in the rest shape, or the length of the "
                    "path along mesh edges",
         .choices = choices::rest_lengths}),
    field<&Settings::shared_pairs, Settings>(
        {.name = "shared_pairs",
         .meaning = "whether two vertices that reach each other get one spring or two",
         .choices = choices::shared_pairs}),
    field<&Settings::pinned_pairs, Settings>(
        {.name = "pinned_pairs",
         .meaning =
             "whether to drop or keep springs between two pinned vertices; such springs cannot move anything",
         .choices = choices::pinned_pairs}),
};
RingRule ring_rule(const RingSettings& settings, RingFill fill);

template <class Settings>
inline constexpr std::array ring_fill_field = {field<&Settings::rings, Settings>(
    {.name = "rings",
     .meaning = "which rings of a vertex of level L get springs: 1 … L, 2 … L (ring 1 is the mesh's "
                "own edges), L alone, or the ends 1 and L",
     .choices = ring_fill_names})};
}  // namespace bendlab
