// Moving pins: pinned vertices follow keyframes.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include "bendlab/effects/effects.hpp"
#include "bendlab/settings/names.hpp"

namespace bendlab {
namespace moving_pins_effect {

constexpr std::array<std::string_view, 2> interpolations = {"linear", "smooth"};

constexpr std::array fields = {
    field<&MovingPins::vertices>(
        {.name = "vertices",
         .meaning =
             "which pinned vertices move, by the names of /pins/vertices; the pinned rings around a vertex "
             "move with the vertex. If vertices and indices are empty, all pinned vertices move",
         .choices = place_names}),
    field<&MovingPins::indices>({.name = "indices",
                                 .unit = "1",
                                 .meaning = "pinned vertices that move, by index, in addition to the named "
                                            "vertices",
                                 .minimum = 0}),
    field<&MovingPins::times>(
        {.name = "times",
         .unit = "s",
         .meaning = "times of the keyframes, in growing order; the first keyframe also applies before the "
                    "first time, and the last keyframe after the last time"}),
    field<&MovingPins::offsets>({.name = "offsets",
                                 .unit = "m",
                                 .meaning = "displacement from the vertices' first positions, three numbers "
                                            "per keyframe; empty: no displacement"}),
    field<&MovingPins::angles>({.name = "angles",
                                .unit = "degrees",
                                .meaning = "angle of the turn about the axis, one per keyframe; the turn is "
                                           "applied before the offset; empty: no turn"}),
    field<&MovingPins::axis>(
        {.name = "axis",
         .unit = "1",
         .meaning = "direction of the axis of the turn, right-handed; any length except zero"}),
    field<&MovingPins::centre>({.name = "centre", .unit = "m", .meaning = "a point on the axis of the turn"}),
    field<&MovingPins::interpolation>({.name = "interpolation",
                                       .meaning = "how to interpolate between keyframes: linear, or smooth "
                                                  "(by 3 s² - 2 s³; the motion stops at every keyframe)",
                                       .choices = interpolations}),
};

struct Pose {
  Vector3 offset = Vector3::Zero();  // m
  double angle = 0;                  // rad
};

// Poses at growing times. Throws std::invalid_argument if the lists' lengths do not match or times do not
// grow.
class Keyframes {
 public:
  explicit Keyframes(const MovingPins& settings)
      : times_(settings.times), smooth_(settings.interpolation == MovingPins::Interpolation::smooth) {
    const std::vector<double>&offsets = settings.offsets, &angles = settings.angles;
    check("offsets", offsets.size(), 3), check("angles", angles.size(), 1);
    if (times_.empty()) throw std::invalid_argument("times is empty: list at least one keyframe");
    for (std::size_t k = 0; k < times_.size(); ++k) {
      if (k > 0 && !(times_[k] > times_[k - 1]))
        throw std::invalid_argument(
            fmt::format("times must grow, but {} s comes after {} s", times_[k], times_[k - 1]));
      Pose pose;
      if (!offsets.empty()) pose.offset = Vector3(offsets.data() + 3 * k);
      if (!angles.empty()) pose.angle = angles[k] * std::numbers::pi / 180;
      poses_.push_back(pose);
    }
  }

  bool all_at_the_start() const {
    return std::ranges::all_of(poses_, [](const Pose& p) { return p.angle == 0 && p.offset.isZero(0); });
  }

  // At the time of a keyframe the result equals the keyframe's pose in every bit.
  Pose at(double time) const {
    const auto next = std::ranges::upper_bound(times_, time);
    const auto k = static_cast<std::size_t>(next - times_.begin());
    if (k == 0) return poses_.front();
    const Pose& from = poses_[k - 1];
    if (k == times_.size()) return from;
    const double x = (time - times_[k - 1]) / (times_[k] - times_[k - 1]);
    const double s = smooth_ ? x * x * (3 - 2 * x) : x;
    const Pose& to = poses_[k];
    return {from.offset + s * (to.offset - from.offset), from.angle + s * (to.angle - from.angle)};
  }

 private:
  void check(const char* name, std::size_t given, std::size_t per_key) const {
    if (given != 0 && given != per_key * times_.size())
      throw std::invalid_argument(
          fmt::format("{} has {} numbers, expected {} (each of the {} keyframes needs {}) or none", name,
                      given, per_key * times_.size(), times_.size(), per_key));
  }

  std::vector<double> times_;
  std::vector<Pose> poses_;
  bool smooth_;
};

// #V: for each pinned vertex, the vertex that the scene names in /pins and to which the pin belongs: the
// pinned vertex itself, or the nearest named vertex along pinned vertices. -1 for free vertices.
std::vector<int> seeds_of_pins(const RestMesh& rest, const Pins& pins) {
  std::vector<int> seed(static_cast<std::size_t>(rest.vertex_count()), -1), queue = pins.seeds;
  for (const int vertex : queue) seed[static_cast<std::size_t>(vertex)] = vertex;
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (const int next : rest.one_ring()[queue[i]])
      if (int& own = seed[static_cast<std::size_t>(next)]; pins.pinned(next) && own < 0)
        own = seed[static_cast<std::size_t>(queue[i])], queue.push_back(next);
  return seed;
}

// The vertices that the settings name, or all pinned vertices if the settings name no vertex. Throws
// std::invalid_argument if a named vertex is not in the mesh or not pinned.
std::set<int> named_vertices(const MovingPins& settings, const EffectInput& input) {
  std::set<int> named;
  const auto add = [&](int vertex, const std::string& setting) {
    if (!input.pins.pinned(vertex))
      throw std::invalid_argument(
          fmt::format("{}: vertex {} is not pinned: add it to /pins, or remove it here", setting, vertex));
    named.insert(vertex);
  };
  for (const Place place : settings.vertices)
    for (const int vertex : select_vertices(input.rest, place))
      add(vertex, fmt::format("vertices, {}", name_in(place_names, place)));
  for (const int index : settings.indices) {
    if (index >= input.rest.vertex_count())
      throw std::invalid_argument(fmt::format("indices: {} is not a vertex; the mesh has vertices 0 to {}",
                                              index, input.rest.vertex_count() - 1));
    add(index, "indices");
  }
  if (named.empty()) named.insert(input.pins.all.begin(), input.pins.all.end());
  return named;
}

// The pinned vertices that move, permuted.
std::vector<std::size_t> moving_vertices(const MovingPins& settings, const EffectInput& input) {
  const std::set<int> named = named_vertices(settings, input);
  const std::vector<int> seed = seeds_of_pins(input.rest, input.pins);
  std::vector<std::size_t> vertices;
  for (const int vertex : input.pins.all)
    if (named.contains(vertex) || named.contains(seed[static_cast<std::size_t>(vertex)]))
      vertices.push_back(input.permuted(vertex));
  return vertices;
}

// A turn about an axis, then an offset. Without angles the result is exactly start + offset.
class Motion {
 public:
  explicit Motion(const MovingPins& settings)
      : keyframes_(settings),
        turns_(!settings.angles.empty()),
        axis_(settings.axis),
        centre_(settings.centre) {
    if (turns_ && !(axis_.norm() > 0))
      throw std::invalid_argument("axis has no length: choose a vector that is not zero");
    axis_.normalize();
  }

  bool stands_still() const { return keyframes_.all_at_the_start(); }

  // Calls visit(i, position) for each starts[i]. Coordinates are relative to `origin`.
  template <class Visit>
  void at(double time, const std::vector<Vector3>& starts, const Vector3& origin, const Visit& visit) const {
    const Pose pose = keyframes_.at(time);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(pose.angle, axis_).toRotationMatrix();
    const Vector3 centre = centre_ - origin;
    for (std::size_t i = 0; i < starts.size(); ++i)
      visit(i, turns_ ? Vector3(centre + turn * (starts[i] - centre) + pose.offset)
                      : Vector3(starts[i] + pose.offset));
  }

 private:
  Keyframes keyframes_;
  bool turns_;
  Vector3 axis_, centre_;
};

// Sets the predicted positions of pinned vertices to their positions at context.time + h, the end of the
// substep. No projection moves pinned vertices. The step's pass `update` also computes the velocities of
// pinned vertices, for functions that need the velocity of a pin.
template <class Real>
std::vector<Pass<Real>> compile(const MovingPins& settings, const EffectInput& input) {
  const Motion motion(settings);
  std::vector<std::size_t> vertices = moving_vertices(settings, input);
  if (vertices.empty() || motion.stands_still()) return {};
  const auto starts = std::make_shared<std::vector<Vector3>>();
  return {{"moving_pins", Stage::predicted,
           [motion, vertices = std::move(vertices), starts](PassContext<Real>& context) {
             State<Real>& state = context.state;
             if (starts->empty())
               for (const std::size_t v : vertices)
                 starts->push_back(state.previous[v].vector().template cast<double>());
             const double end = context.time + static_cast<double>(context.substep);
             motion.at(end, *starts, state.origin, [&](std::size_t i, const Vector3& position) {
               const Vector3Of<Real> now = position.template cast<Real>();
               context.acted += now != state.previous[vertices[i]].vector();
               state.position[vertices[i]].set(now);
             });
           },
           [starts](Archive& state) { state(*starts); }}};
}

bool idle(const MovingPins& settings) {
  const auto zero = [](double x) { return x == 0; };
  return std::ranges::all_of(settings.offsets, zero) && std::ranges::all_of(settings.angles, zero);
}

bool drives(const MovingPins&) {
  return true;
}

}  // namespace moving_pins_effect

constinit const EffectKind MovingPins::kind{
    .name = "moving_pins",
    .summary =
        "pinned vertices follow keyframes exactly; if several effects of this kind move a vertex, the last "
        "effect counts",
    .source = "prescribed motion: start + offset, after a turn about an axis if angles are given",
    .settings = table_of<MovingPins>(moving_pins_effect::fields),
    .needs_projection = true,
    .acts_in_iterations = true,
    .repeatable = true,
    .needs_pins = true,
    .moves_pins = true,
    .compile_float = erased<moving_pins_effect::compile<float>>,
    .compile_double = erased<moving_pins_effect::compile<double>>,
    .idle = erased<moving_pins_effect::idle>,
    .drives = erased<moving_pins_effect::drives>,
};
}  // namespace bendlab
