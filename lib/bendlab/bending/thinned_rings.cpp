#include "bendlab/bending/thinned_rings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "bendlab/mesh/orientation.hpp"
#include "bendlab/mesh/rings.hpp"
#include "bendlab/settings/random_numbers.hpp"

namespace bendlab {
namespace {

constexpr double pi = std::numbers::pi;

// Directions in the tangent plane of a vertex, as angles from an arbitrary axis, which each vertex has.
class TangentPlanes {
 public:
  explicit TangentPlanes(const RestMesh& rest)
      : rest_(rest), normal_(Positions::Zero(rest.vertex_count(), 3)) {
    const Orientation orientation = orientation_of(to_soup(rest.mesh()));
    for (int t = 0; t < rest.triangle_count(); ++t) {
      const auto corner = rest.triangles().row(t);
      Vector3 normal = (rest.position(corner(1)) - rest.position(corner(0)))
                           .cross(rest.position(corner(2)) - rest.position(corner(0)));
      if (orientation.turned[static_cast<std::size_t>(t)] != 0) normal = -normal;
      for (int c = 0; c < 3; ++c) {
        auto sum = normal_.row(corner(c));
        const bool against = orientation.seams > 0 && sum.dot(normal) < 0;  // across a seam of a Möbius band
        sum += (against ? -1 : 1) * normal.transpose();
      }
    }
    for (auto normal : normal_.rowwise())
      if (normal.isZero(0)) normal = Vector3::UnitZ();  // its triangles have no area: take any plane
  }

  double angle(int from, int to) const {
    const Vector3 normal = normal_.row(from).transpose();
    const Vector3 axis = normal.unitOrthogonal(), other = normal.normalized().cross(axis);
    const Vector3 offset = rest_.position(to) - rest_.position(from);
    return std::atan2(offset.dot(other), offset.dot(axis));
  }

 private:
  const RestMesh& rest_;
  Positions normal_;
};

// The angle of a vertex's first direction, as a share of a full turn in [0, 1). The angles are spread evenly
// over the vertices, so that a lattice has springs in all directions. SplitMix64 gives every machine the same
// angles.
double phase(int vertex) {
  return unit_interval(split_mix(static_cast<std::uint64_t>(vertex), 0));
}

// A spring's stiffness is ∝ cos⁸ φ = (35 + 56 cos 2φ + 28 cos 4φ + 8 cos 6φ + cos 8φ) / 128, where φ is the
// angle between the spring and the direction of bending. The harmonics are 128 times the middle three terms.
using Harmonics = Eigen::Matrix<double, 6, 1>;
Harmonics harmonics(double angle) {
  Harmonics h;
  h << 56 * std::cos(2 * angle), 56 * std::sin(2 * angle), 28 * std::cos(4 * angle), 28 * std::sin(4 * angle),
      8 * std::cos(6 * angle), 8 * std::sin(6 * angle);
  return h;
}

class Thinned {
 public:
  Thinned(const BendingInput& input, int per_vertex, int power)
      : rest_(input.rest),
        pins_(input.pins),
        planes_(input.rest),
        per_vertex_(per_vertex),
        power_(power),
        partners_(static_cast<std::size_t>(input.rest.vertex_count())) {
    springs = springs_at_rest_in(rest_.positions());
  }

  // Adds `per_vertex` springs from the vertex to vertices of the ring.
  void add(int vertex, std::span<const int> ring, double radius) {
    std::vector<Candidate> candidates;
    for (const int other : ring)
      if (!(pins_.pinned(vertex) && pins_.pinned(other)) && !joined_already(vertex, other))
        candidates.push_back({other, planes_.angle(vertex, other)});
    const double apart = pi / per_vertex_, first = 2 * pi * phase(vertex);
    for (int spring = 0; spring < per_vertex_ && !candidates.empty(); ++spring) {
      const double aim = first + apart * spring + (spring % 2 ? pi : 0);
      const auto chosen = choose(candidates, aim, apart);
      owed_ += harmonics(aim) - harmonics(chosen->angle);
      join(vertex, chosen->vertex, radius);
      candidates.erase(chosen);
    }
  }

  DistanceConstraints springs;

 private:
  struct Candidate {
    int vertex;
    double angle;
  };

  // A ring has only a few directions, and all rings of a lattice have the same directions. So choose() takes
  // the candidate near the angle `aim` that best compensates the errors of earlier choices. If the sheet has
  // no vertex near this angle, choose() takes a candidate on the opposite side.
  std::vector<Candidate>::iterator choose(std::vector<Candidate>& candidates, double aim,
                                          double reach) const {
    const Harmonics wanted = owed_ + harmonics(aim);
    for (const double period : {2 * pi, pi}) {
      const auto cost = [&](const Candidate& c) {
        const bool near = std::abs(std::remainder(c.angle - aim, period)) <= reach;
        return near ? (wanted - harmonics(c.angle)).squaredNorm() : std::numeric_limits<double>::infinity();
      };
      const auto best = std::min_element(candidates.begin(), candidates.end(),
                                         [&](auto& l, auto& r) { return cost(l) < cost(r); });
      if (std::isfinite(cost(*best))) return best;
    }
    return candidates.begin();
  }

  std::vector<int>& partners(int vertex) { return partners_[static_cast<std::size_t>(vertex)]; }

  bool joined_already(int a, int b) {
    return std::find(partners(a).begin(), partners(a).end(), b) != partners(a).end();
  }

  void join(int vertex, int other, double radius) {
    const double length = (rest_.position(vertex) - rest_.position(other)).norm();
    springs.vertices.push_back({vertex, other});
    springs.softness.push_back(std::pow(length / radius, power_));
    partners(other).push_back(vertex);
  }

  const RestMesh& rest_;
  const Pins& pins_;
  TangentPlanes planes_;
  int per_vertex_, power_;
  Harmonics owed_ = Harmonics::Zero();
  std::vector<std::vector<int>> partners_;  // of each vertex: the vertices whose own springs lead to it
};

}  // namespace

BendingConstraints thinned_rings(const ThinnedRingSettings& settings, const BendingInput& input, int power) {
  const Levels levels = adaptive_levels(input, settings);
  const int t = settings.t, least = settings.t_min;
  const std::vector<int> level_of = level_of_vertices(
      input.rest, input.pins, settings, std::max(least, t ? t : levels.m), std::max(least, t ? t : levels.n));
  Thinned thinned(input, settings.springs, power);
  RingWalker walker(input.rest.one_ring());
  for (int vertex = 0; vertex < input.rest.vertex_count(); ++vertex) {
    const int level = level_of[static_cast<std::size_t>(vertex)];
    walker.walk(vertex, level);
    thinned.add(vertex, walker.ring(level), level * input.rest.mean_edge_length());
  }
  BendingConstraints constraints;
  constraints.distance = std::move(thinned.springs);
  constraints.facts = facts_of(levels);
  constraints.facts.push_back(
      {"t", static_cast<double>(t),
       "LOD level of every vertex; 0 gives free vertices the level m, and pinned vertices the level n"});
  return constraints;
}

}  // namespace bendlab
