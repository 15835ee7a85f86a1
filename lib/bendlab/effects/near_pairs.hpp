// The parts of a cloth that may touch each other within a substep: pairs of vertex and triangle, pairs of
// edges.
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
  double start;    ///< m, its gap's length at the start of the substep
  Vector3 normal;  ///< the unit vector of that gap
  double target;   ///< m, how far apart it should be: the thickness, or half of the rest distance if less

  void archive(Archive& state) { state(vertices, pairing, start, normal, target); }
};

/// Finds the pairs that can come nearer than a part of their target while each vertex goes straight from
/// where the substep started to a point within a margin of where it is now. It finds all of them, and few
/// others:
///
/// * A tree holds boxes around each triangle's way: n log n at most, n if the cloth is smooth. The motion
///   that all vertices share is left out: cloth in free fall sweeps no space.
/// * Each vertex and each edge belongs to one triangle, so every pair is tested once (Curtis et al. 2008).
/// * Two elements are apart all the way if some axis or their gap's normal separates them both at the start
///   and at the end, by more than their target.
///
/// Why half of the rest distance: a chord of a half circle is at least 2/π of its arc, so cloth may be folded
/// to a diameter of the thickness before a pair is pushed, and neighbours at rest never are. Elements that
/// have a common vertex or touch at rest (a seam) are no pair.
///
/// The order of the pairs depends on the mesh alone.
template <class Real>
class NearPairs {
 public:
  NearPairs(const EffectInput& input, double thickness);

  /// Begins a substep. Pairs found before are kept where they still cover the whole way.
  void begin(const State<Real>& state, double margin);
  void find(const State<Real>& state, double part_of_target, double margin);
  /// True while no vertex has left its margin since the pairs were found, apart from motion that all share.
  bool cover(const Points<Real>& points) const;

  const std::vector<NearPair>& pairs() const { return pairs_; }
  /// What one substep keeps for the next.
  void archive(Archive& state) { state(part_of_target_, margin_, found_at_, pairs_); }

 private:
  struct Triangle {
    std::array<int, 3> vertices;                 // permuted
    std::array<bool, 3> owns_vertex, owns_edge;  // edge i from corner i to the next
  };

  // Boxes around an element at start and end, each grown by half of the distance at which two elements
  // matter.
  struct Way {
    Box start, end;
    void include(const Way& other) { start.include(other.start), end.include(other.end); }
    /// Whether two elements may come so near each other that the boxes overlap by `depth`, m.
    bool meets(const Way& other, float depth = 0) const;
  };

  void measure_start(const State<Real>& state, NearPair& pair) const;
  void set_boxes(const State<Real>& state);
  bool may_come_near(Pairing pairing, const std::array<int, 4>& vertices, const Way& one,
                     const Way& other) const;
  void look_at(const State<Real>& state, std::size_t first, std::size_t second);
  void add(const State<Real>& state, Pairing pairing, const std::array<int, 4>& vertices);
  Way edge_way(const Triangle& t, std::size_t edge) const;

  double thickness_;
  bool thick_;  // compared with the mesh's edges
  std::vector<Triangle> triangles_;
  std::vector<Vector3> rest_;  // m, permuted
  BoxTree tree_;

  double part_of_target_ = 0, margin_ = 0;  // of the last find
  Points<Real> found_at_;
  std::vector<Way> vertex_ways_, triangle_ways_;
  std::vector<Box> boxes_;  // of the triangles' ways, without the motion that all share
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
