// Pairs of elements of a cloth (a vertex and a triangle, or two edges) that may touch within a substep.
#pragma once

#include <array>
#include <vector>

#include "bendlab/constraints/state.hpp"
#include "bendlab/effects/effect.hpp"
#include "bendlab/mesh/box_tree.hpp"
#include "bendlab/mesh/proximity.hpp"

namespace bendlab {

struct NearPair {
  std::array<int, 4> vertices;  ///< permuted: indices in State's arrays, ordered as in Corners
  Pairing pairing;
  double start;    ///< m, length of the gap at the start of the substep
  Vector3 normal;  ///< the unit vector along this gap
  double target;   ///< m, wanted distance: the thickness, or half of the distance at rest if less

  void archive(Archive& state) { state(vertices, pairing, start, normal, target); }
};

/// Finds the pairs whose distance may become smaller than a given part of their target during a substep. A
/// vertex is assumed to move along a straight path, from its position at the start of the substep to a point
/// within a margin of its present position. The search finds all such pairs, and only few other pairs:
///
/// * A tree stores boxes around each triangle's path. The cost is n log n at most, and n if the cloth is
///   smooth. The motion that all vertices share is subtracted, so that cloth in free fall has short paths.
/// * Each vertex and each edge belongs to one triangle, so every pair is tested once (Curtis et al. 2008).
/// * Two elements are no pair if an axis, or the normal of their gap, separates the elements by more than
///   their target at the start and at the end of the substep.
///
/// The target is at most half of the distance at rest, because a chord of a half circle is at least 2/π of
/// its arc. So a pair is pushed only if the cloth is folded to a diameter smaller than the thickness, and
/// neighbours at rest are never pushed. Elements that share a vertex or touch at rest (a seam) are no pair.
///
/// The order of the pairs depends on the mesh alone.
template <class Real>
class NearPairs {
 public:
  NearPairs(const EffectInput& input, double thickness);

  /// Begins a substep. Repeats the search if the pairs of the last search do not cover the paths of all
  /// vertices.
  void begin(const State<Real>& state, double margin);
  void find(const State<Real>& state, double part_of_target, double margin);
  /// Whether every vertex is within its margin around its last search, apart from motion that all share.
  bool cover(const Points<Real>& points) const;

  const std::vector<NearPair>& pairs() const { return pairs_; }
  /// The data that one substep keeps for the next substep.
  void archive(Archive& state) { state(part_of_target_, margin_, found_at_, pairs_); }

 private:
  struct Triangle {
    std::array<int, 3> vertices;                 // permuted
    std::array<bool, 3> owns_vertex, owns_edge;  // edge i is from corner i to the next corner
  };

  // Boxes around an element at the start and at the end of the substep. Each box is enlarged by half of the
  // distance at which two elements count as near.
  struct Way {
    Box start, end;
    void include(const Way& other) { start.include(other.start), end.include(other.end); }
    /// Whether the boxes of two elements may overlap by `depth` (m) during the substep.
    bool meets(const Way& other, float depth = 0) const;
  };

  void measure_start(const State<Real>& state, NearPair& pair) const;
  void set_boxes(const State<Real>& state);
  bool may_come_near(Pairing pairing, const std::array<int, 4>& vertices, const Way& first,
                     const Way& second) const;
  void look_at(const State<Real>& state, std::size_t first, std::size_t second);
  void add(const State<Real>& state, Pairing pairing, const std::array<int, 4>& vertices);
  Way edge_way(const Triangle& t, std::size_t edge) const;

  double thickness_;
  bool thick_;  // whether the thickness is large compared with the mesh's edges
  std::vector<Triangle> triangles_;
  std::vector<Vector3> rest_;  // m, permuted
  BoxTree tree_;

  double part_of_target_ = 0, margin_ = 0;  // of the last call of find()
  Points<Real> found_at_;
  std::vector<Way> vertex_ways_, triangle_ways_;
  std::vector<Box> boxes_;  // around the triangles' paths, without the motion that all vertices share
  std::vector<NearPair> pairs_;
};

/// The positions of a pair's vertices.
template <class Real>
Corners corners_of(const NearPair& pair, const Points<Real>& points) {
  Corners corners;
  for (std::size_t i = 0; i < 4; ++i)
    corners[i] = points[static_cast<std::size_t>(pair.vertices[i])].vector().template cast<double>();
  return corners;
}

}  // namespace bendlab
