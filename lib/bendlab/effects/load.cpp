// A dead or follower load on vertices, along an edge or over an area.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <span>

#include "bendlab/constraints/build.hpp"
#include "bendlab/effects/effects.hpp"
#include "bendlab/effects/named_vertices.hpp"

namespace bendlab {
namespace load_effect {

constexpr std::array<std::string_view, 3> spreads = {"equal", "length", "area"};

constexpr std::array own_fields = {
    field<&Load::vertices>({.name = "vertices",
                            .meaning = "vertices on which the load acts, by the names of /pins/vertices. If "
                                       "vertices and indices are empty, the load acts on all free vertices",
                            .choices = place_names}),
    field<&Load::indices>({.name = "indices",
                           .unit = "1",
                           .meaning = "vertices on which the load acts, by index, in addition to the named "
                                      "vertices",
                           .minimum = 0}),
    field<&Load::force>({.name = "force", .unit = "N", .meaning = "the sum of the forces on all vertices"}),
    field<&Load::spread>({.name = "spread",
                          .meaning =
                              "how the force is divided. equal: each vertex has the same share; length: "
                              "by the length of the edges between the listed vertices at rest, as a "
                              "uniform load along a line; area: by the area around each vertex at rest",
                          .choices = spreads}),
    field<&Load::follows>({.name = "follows",
                           .meaning = "whether the force turns with the cloth at its vertex. If false, the "
                                      "force keeps its direction (a dead load)"}),
};
constexpr auto fields = joined(own_fields, load_fields<Load>);

// The share of the force at each of the vertices.
std::vector<double> shares(const Load& settings, const std::vector<int>& vertices, const RestMesh& rest) {
  std::vector<double> share(vertices.size(), 0);
  if (settings.spread == Load::Spread::area) {
    const std::vector<double> areas = lumped_masses(rest, 1);
    for (std::size_t i = 0; i < share.size(); ++i) share[i] = areas[static_cast<std::size_t>(vertices[i])];
  } else if (settings.spread == Load::Spread::length) {
    for (const auto edge : rest.edges().rowwise()) {
      const auto a = std::ranges::lower_bound(vertices, edge(0)),
                 b = std::ranges::lower_bound(vertices, edge(1));
      if (a == vertices.end() || *a != edge(0) || b == vertices.end() || *b != edge(1)) continue;
      const double half = 0.5 * (rest.position(edge(0)) - rest.position(edge(1))).norm();
      share[static_cast<std::size_t>(a - vertices.begin())] += half;
      share[static_cast<std::size_t>(b - vertices.begin())] += half;
    }
  } else {
    share.assign(share.size(), 1);
  }
  double sum = 0;
  for (const double s : share) sum += s;
  if (!(sum > 0))
    throw std::invalid_argument(
        "spread: no edge joins two of the load's vertices, so that the load has no length: choose \"equal\"");
  for (double& s : share) s /= sum;
  return share;
}

// A triangle at a loaded vertex, which says how the cloth there has turned.
struct Frame {
  std::array<std::size_t, 3> corner;  // permuted
  Eigen::Matrix3d rest;               // columns: the first edge, the normal, and the direction across both
};

Eigen::Matrix3d frame_of(const Vector3& a, const Vector3& b, const Vector3& c) {
  Eigen::Matrix3d frame;
  frame.col(0) = (b - a).normalized();
  frame.col(1) = (b - a).cross(c - a).normalized();
  frame.col(2) = frame.col(0).cross(frame.col(1));
  return frame;
}

template <class Real>
class Loading {
 public:
  Loading(const Load& settings, const EffectInput& input) : force_(settings.force), growth_(settings) {
    check_schedule(settings);
    const std::vector<int> vertices =
        loaded_vertices(input.rest, input.pins, settings.vertices, settings.indices);
    share_ = shares(settings, vertices, input.rest);
    for (const int v : vertices) at_.push_back(input.permuted(v));
    if (!settings.follows) return;
    frames_.resize(vertices.size());
    const RestMesh& rest = input.rest;
    for (int t = 0; t < rest.triangle_count(); ++t) {
      const auto row = rest.triangles().row(t);
      for (int c = 0; c < 3; ++c) {
        const auto found = std::ranges::lower_bound(vertices, row(c));
        if (found == vertices.end() || *found != row(c)) continue;
        frames_[static_cast<std::size_t>(found - vertices.begin())].push_back(
            {{input.permuted(row(0)), input.permuted(row(1)), input.permuted(row(2))},
             frame_of(rest.position(row(0)), rest.position(row(1)), rest.position(row(2)))});
      }
    }
  }

  void operator()(PassContext<Real>& context) const {
    State<Real>& state = context.state;
    const double share = share_of_load(growth_, context.time + static_cast<double>(context.substep));
    for (std::size_t i = 0; i < at_.size(); ++i) {
      const Real w = state.position[at_[i]].w;
      if (!(w > 0)) continue;
      Vector3 force = share * share_[i] * force_;
      if (!frames_.empty()) force = turned(state, frames_[i], force);
      state.accelerate(at_[i], context.substep * w * force.template cast<Real>());
      ++context.acted;
    }
  }

 private:
  // The mean of the force turned with each triangle, in its full length.
  static Vector3 turned(const State<Real>& state, const std::vector<Frame>& frames, const Vector3& force) {
    Vector3 sum = Vector3::Zero();
    for (const Frame& frame : frames) {
      const auto p = [&](std::size_t c) -> Vector3 {
        return state.position[frame.corner[c]].vector().template cast<double>();
      };
      sum += frame_of(p(0), p(1), p(2)) * (frame.rest.transpose() * force);
    }
    return sum.norm() > 0 ? Vector3(force.norm() * sum.normalized()) : force;
  }

  Vector3 force_;
  GrowingLoad growth_;
  std::vector<std::size_t> at_;
  std::vector<double> share_;
  std::vector<std::vector<Frame>> frames_;  // of each vertex; empty: a dead load
};

template <class Real>
std::vector<Pass<Real>> compile(const Load& settings, const EffectInput& input) {
  if (settings.force.isZero(0)) return {};
  return {{"load", Stage::force, Loading<Real>(settings, input)}};
}

bool idle(const Load& settings) {
  return settings.force.isZero(0);
}

bool drives(const Load& settings) {
  return !idle(settings);
}

double largest_force(const Load& settings, double) {
  return settings.largest() * settings.force.norm();
}

// A pinned vertex takes its share of the force to the pin.
std::optional<Doubt> doubt(const Load& settings, const DoubtInput& input) {
  if (idle(settings)) return std::nullopt;
  const std::vector<int> vertices =
      loaded_vertices(input.rest, input.pins, settings.vertices, settings.indices);
  const std::vector<double> share = shares(settings, vertices, input.rest);
  double lost = 0;
  int pinned = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (input.pins.pinned(vertices[i])) lost += share[i], ++pinned;
  constexpr double seen = 0.01;
  if (!(lost > seen)) return std::nullopt;
  return Doubt{
      fmt::format("{}: {} of the {} vertices of the load are pinned, so {:.2g} % of the force moves nothing. "
                  "Name vertices without pins if the cloth should bear the whole force",
                  input.where, pinned, vertices.size(), 100 * lost),
      lost, fmt::format("{:.2g} %", 100 * lost)};
}

}  // namespace load_effect

constinit const EffectKind Load::kind{
    .name = "load",
    .summary =
        "forces on vertices, along an edge or over an area, with a fixed direction or turning with the "
        "cloth",
    .source = "v += h w f",
    .settings = table_of<Load>(load_effect::fields),
    .repeatable = true,
    .force_follows_pose = true,
    .compile_float = erased<load_effect::compile<float>>,
    .compile_double = erased<load_effect::compile<double>>,
    .idle = erased<load_effect::idle>,
    .drives = erased<load_effect::drives>,
    .largest_force = erased<load_effect::largest_force>,
    .doubt = erased<load_effect::doubt>,
};
}  // namespace bendlab
