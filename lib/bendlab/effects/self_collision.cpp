// Self-collision: layers of cloth keep a distance, the thickness, and do not pass through each other.
//
// The gap of a pair (a vertex and a triangle, or two edges) is the vector between the two nearest points. The
// target of a pair is its smallest allowed distance: the thickness, or half of the distance at rest if less.
// Self-collision has two parts:
//
// * In each iteration a pair that is nearer than its target is moved apart along its gap, by Δx_i = -w_i λ n
//   (Müller et al. 2007, §4.3). A pair that met on the straight path from the start of the substep is moved
//   back to its side, along the gap at the moment of contact (Provot 1997; Bridson et al. 2002, §6). Linear
//   momentum is preserved to rounding. Angular momentum is preserved if the correction is along the present
//   gap; for a pair that met, angular momentum about the point of contact is preserved.
// * The iterations may end before all pairs are corrected. So at the end of the substep every pair is tested
//   again. Pairs that meet are moved back in the same way, for a few rounds. If a pair still meets after
//   these rounds, it forms an impact zone with all pairs that touch it, and the zone moves as one rigid body
//   (Provot 1997; Bridson et al. 2002, §7.4). Zones grow until no pair meets.
//
// Guaranteed: if the substep starts without an intersection, it ends without an intersection. This is true
// for any substep, speed and iterations, if pins do not push through each other. Not guaranteed:
//
// * the thickness itself, if iterations are few;
// * that intersections at the start disappear (each pair stays on its side);
// * that other constraints hold, and that vertices are outside obstacles, after the last test;
// * that a triangle does not turn over within its own plane, by collapsing to a line.
//
// The cost is about proportional to the number of vertices if layers move by less than a few edge lengths
// against each other in a substep. If layers move farther, the boxes around their paths overlap, and the cost
// grows faster. More substeps avoid this cost.
//
// Velocities follow from positions, so layers that meet do not bounce. A pair that starts nearer than its
// target moves apart slowly, because a large move in one substep would give the pair a large velocity.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bendlab/effects/effects.hpp"
#include "bendlab/effects/near_pairs.hpp"

namespace bendlab {
namespace self_collision_effect {

constexpr std::array fields = {
    field<&SelfCollision::thickness>({.name = "thickness",
                                      .unit = "m",
                                      .meaning = "distance that layers of cloth keep from each other; layers "
                                                 "that are near at rest keep half of their distance at rest",
                                      .minimum = 0,
                                      .above = true}),
};

// s: within this time, the distance of a pair that is nearer than its target grows by the target.
constexpr double recovery_time = 0.02;
// A pair has met if its distance is at most the smaller of two lengths: `meeting` times its target, and
// `meeting_of_start` times its distance at the start. So in a substep the distance of a pair that is already
// near decreases only a little. Otherwise a few substeps would reduce the distance to a rounding error.
constexpr double meeting = 0.05, meeting_of_start = 0.8;
// A pair that met is moved back to this part of its target, or to its distance at the start if that is
// smaller.
constexpr double moved_back = 0.5;
constexpr int rounds_before_zones = 8;
// The search for pairs is repeated after a vertex has moved by the smaller of these parts of the thickness
// and of the mean edge length. The edge length matters, because neighbours at rest must not become pairs.
constexpr double margin_per_thickness = 0.5, margin_per_edge = 0.125;

// Sets of vertices that move as one rigid body.
class Zones {
 public:
  bool joined(const NearPair& pair) {
    const auto zone = [&](std::size_t i) { return zone_of(pair.vertices[i]); };
    return zone(0) == zone(1) && zone(0) == zone(2) && zone(0) == zone(3);
  }
  void join(const NearPair& pair) {
    for (const int vertex : pair.vertices) {
      if (parent_.try_emplace(vertex, vertex).second) members_.push_back(vertex);
      parent_[zone_of(vertex)] = zone_of(pair.vertices[0]);
    }
  }
  /// The zones, in the order in which vertices were added.
  std::vector<std::vector<int>> all() {
    std::map<int, std::size_t> index;
    std::vector<std::vector<int>> zones;
    for (const int vertex : members_) {
      const auto [at, is_new] = index.try_emplace(zone_of(vertex), zones.size());
      if (is_new) zones.emplace_back();
      zones[at->second].push_back(vertex);
    }
    return zones;
  }

 private:
  int zone_of(int vertex) {
    auto at = parent_.find(vertex);
    if (at == parent_.end()) return vertex;
    while (at->second != at->first) {
      const auto above = parent_.find(at->second);
      at->second = above->second;
      at = above;
    }
    return at->first;
  }

  std::map<int, int> parent_;
  std::vector<int> members_;
};

// The rigid rotation about the centre that has the same angular momentum as displacements d of masses at r
// from the centre.
struct Turn {
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Vector3 moment = Vector3::Zero();

  void add(double mass, const Vector3& r, const Vector3& d) {
    inertia += mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
    moment += mass * r.cross(d);
  }
  // Vertices on a line do not rotate about this line.
  Eigen::Matrix3d rotation() const {
    constexpr double relative_rank = 1e-12;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(inertia);
    Vector3 angle = axes.eigenvectors().transpose() * moment;
    for (int i = 0; i < 3; ++i)
      angle(i) = axes.eigenvalues()(i) > relative_rank * axes.eigenvalues()(2)
                     ? angle(i) / axes.eigenvalues()(i)
                     : 0;
    const double size = angle.norm();
    if (!(size > 0)) return Eigen::Matrix3d::Identity();
    return Eigen::AngleAxisd(size, axes.eigenvectors() * angle / size).toRotationMatrix();
  }
};

template <class Real>
class Layers {
 public:
  Layers(const EffectInput& input, double thickness)
      : margin_(std::min(margin_per_thickness * thickness, margin_per_edge * input.rest.mean_edge_length())),
        near_(input, thickness) {}

  // Stage::project.
  void keep_apart(PassContext<Real>& context) {
    State<Real>& state = context.state;
    if (!std::exchange(begun_, true)) near_.begin(state, margin_);
    const double recovered = std::min(1.0, static_cast<double>(context.substep) / recovery_time);
    const auto move = [&](int vertex, const Vector3& to) {
      point(state, vertex).set(to.template cast<Real>());
    };
    for (const NearPair& pair : near_.pairs()) {
      const double target = std::min(pair.target, pair.start + recovered * pair.target);
      const std::optional<Gap> gap = gap_to_widen(state, pair, target);
      if (gap && widen(state, pair, *gap, target, move)) ++context.acted;
    }
  }

  // Stage::velocity.
  void let_nothing_through(PassContext<Real>& context) {
    State<Real>& state = context.state;
    const auto move = [&](int vertex, const Vector3& to) {
      Point<Real>& p = point(state, vertex);
      const Vector3Of<Real> old = p.vector();
      p.set(to.template cast<Real>());
      Point<Real>& velocity = state.velocity[static_cast<std::size_t>(vertex)];
      velocity.set(velocity.vector() + (p.vector() - old) / context.substep);
    };
    Zones zones;
    bool met_any = true;
    for (int round = 0; met_any; ++round) {
      if (!near_.cover(state.position)) near_.find(state, meeting, margin_);
      met_any = false;
      for (const NearPair& pair : near_.pairs()) {
        const std::optional<Gap> met = meeting_gap(state, pair, corners_of(pair, state.position));
        if (!met || zones.joined(pair)) continue;
        met_any = true;
        if (round < rounds_before_zones)
          context.acted += widen(state, pair, *met, std::min(moved_back * pair.target, pair.start), move);
        else
          zones.join(pair), ++context.acted;
      }
      if (met_any)  // nothing may move after the last test
        for (const std::vector<int>& zone : zones.all()) move_as_one(state, zone, move);
    }
    begun_ = false;
  }

  void archive(Archive& state) { near_.archive(state); }

 private:
  static Point<Real>& point(State<Real>& state, int vertex) {
    return state.position[static_cast<std::size_t>(vertex)];
  }

  // The gap at the moment when a pair met; empty if the pair has not met since the start of the substep.
  // `end` are the present positions of the pair's vertices.
  static std::optional<Gap> meeting_gap(const State<Real>& state, const NearPair& pair, const Corners& end) {
    const double separation = std::min(meeting * pair.target, meeting_of_start * pair.start);
    if (!(separation > 0)) return std::nullopt;
    if (separation_along(pair.normal, pair.pairing, end) >= separation) return std::nullopt;
    return first_contact(pair.pairing, corners_of(pair, state.previous), end, separation);
  }

  // The gap along which to move a pair to the distance `target`; empty if the pair is already that far apart.
  static std::optional<Gap> gap_to_widen(const State<Real>& state, const NearPair& pair, double target) {
    const Corners end = corners_of(pair, state.position);
    if (std::min(pair.start, separation_along(pair.normal, pair.pairing, end)) >= target) return std::nullopt;
    if (const std::optional<Gap> met = meeting_gap(state, pair, end)) return met;
    return shortest_gap(pair.pairing, end);
  }

  // Moves the two nearest points of a pair apart along the gap, to the distance `target`; false if not
  // needed.
  template <class Move>
  static bool widen(State<Real>& state, const NearPair& pair, const Gap& gap, double target,
                    const Move& move) {
    const Corners x = corners_of(pair, state.position);
    const Vector3 normal = gap.vector.normalized();
    std::array<double, 4> share;
    double missing = target, shares = 0, whole = 0, largest_w = 0, largest_share = 0, size = target;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto w = static_cast<double>(point(state, pair.vertices[i]).w);
      missing -= gap.weight[i] * normal.dot(x[i]);
      share[i] = w * gap.weight[i];
      shares += share[i] * gap.weight[i], whole += gap.weight[i] * gap.weight[i];
      largest_w = std::max(largest_w, w), largest_share = std::max(largest_share, std::abs(share[i]));
      for (std::size_t j = 0; j < i; ++j) size = std::max(size, (x[i] - x[j]).norm());
    }
    if (!(missing > 0 && shares > static_cast<double>(least_lever<Real>) * largest_w * whole)) return false;
    missing = std::min(missing, largest_move * size * shares / largest_share);  // no corner moves more
    for (std::size_t i = 0; i < 4; ++i)
      if (share[i] != 0) move(pair.vertices[i], x[i] + missing / shares * share[i] * normal);
    return true;
  }

  // Replaces the motion of a zone's vertices by a rigid motion with the same linear and angular momentum
  // (angular momentum to first order in the angle). Free vertices move with pinned vertices of the zone.
  template <class Move>
  static void move_as_one(State<Real>& state, const std::vector<int>& zone, const Move& move) {
    double mass = 0;
    Vector3 centre = Vector3::Zero(), shift = Vector3::Zero();
    bool held = false;
    for (const int vertex : zone) held |= point(state, vertex).w == 0;
    const auto for_deciding = [&](const auto& action) {
      for (const int vertex : zone) {
        const auto p = static_cast<std::size_t>(vertex);
        if (held && state.position[p].w != 0) continue;
        const Vector3 start = state.previous[p].vector().template cast<double>();
        action(state.mass[p], start, Vector3(state.position[p].vector().template cast<double>() - start));
      }
    };
    for_deciding([&](double m, const Vector3& start, const Vector3& d) {
      mass += m, centre += m * start, shift += m * d;
    });
    centre /= mass, shift /= mass;
    Turn turn;
    if (!held)
      for_deciding([&](double m, const Vector3& start, const Vector3& d) { turn.add(m, start - centre, d); });
    const Eigen::Matrix3d rotation = held ? Eigen::Matrix3d::Identity() : turn.rotation();
    for (const int vertex : zone) {
      if (point(state, vertex).w == 0) continue;
      const Vector3 start = state.previous[static_cast<std::size_t>(vertex)].vector().template cast<double>();
      move(vertex, centre + shift + rotation * (start - centre));
    }
  }

  double margin_;  // m
  NearPairs<Real> near_;
  bool begun_ = false;  // whether this substep has begun
};

template <class Real>
std::vector<Pass<Real>> compile(const SelfCollision& settings, const EffectInput& input) {
  const bool all_pinned = input.pins.all.size() == static_cast<std::size_t>(input.rest.vertex_count());
  if (input.rest.triangle_count() < 2 || all_pinned) return {};
  const auto collision = std::make_shared<Layers<Real>>(input, settings.thickness);
  return {{"self_collision", Stage::project, [collision](PassContext<Real>& c) { collision->keep_apart(c); }},
          {"self_collision", Stage::velocity,
           [collision](PassContext<Real>& c) { collision->let_nothing_through(c); },
           [collision](Archive& state) { collision->archive(state); }}};
}

// In each substep, every element is compared with all elements within the thickness.
std::optional<Doubt> doubt(const SelfCollision& settings, const DoubtInput& input) {
  constexpr double most = 2;  // edges
  const double edge = input.rest.mean_edge_length();
  if (!(settings.thickness > most * edge)) return std::nullopt;
  return Doubt{
      fmt::format(
          "{}: a thickness of {:.3g} m is {:.2g} times the mean edge length, so that each triangle is "
          "compared with many other triangles in every step (at 2.3 edge lengths a sheet took 4 times as "
          "long as at 0.6). Set thickness to about {:.2g} m (half an edge length), or use fewer cells",
          input.where, settings.thickness, settings.thickness / edge, 0.5 * edge),
      settings.thickness / edge, fmt::format("{:.2g} edges", settings.thickness / edge)};
}

}  // namespace self_collision_effect

constinit const EffectKind SelfCollision::kind{
    .name = "self_collision",
    .summary = "layers of cloth keep a distance from each other and never pass through each other",
    .source =
        "Müller et al. 2007, §4.3; Bridson, Fedkiw and Anderson 2002, §6-7; Li, Kaufman and Jiang 2021, §5",
    .settings = table_of<SelfCollision>(self_collision_effect::fields),
    .needs_projection = true,
    .acts_in_iterations = true,
    .compile_float = erased<self_collision_effect::compile<float>>,
    .compile_double = erased<self_collision_effect::compile<double>>,
    .doubt = erased<self_collision_effect::doubt>,
};
}  // namespace bendlab
