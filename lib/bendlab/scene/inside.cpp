#include "bendlab/scene/inside.hpp"

#include "bendlab/effects/effect.hpp"

namespace bendlab {
namespace {

// The state at the start, with velocities 0. Pinned vertices cannot be moved.
State<double> state_of(const BuiltScene& scene) {
  const SimulationInput& input = scene.input;
  State<double> state;
  state.vertex_count = static_cast<int>(input.positions.rows());
  state.point_count = state.vertex_count;
  state.origin = input.origin;
  state.mass = input.mass;
  const auto count = static_cast<std::size_t>(state.vertex_count);
  state.position.resize(count + dummy_points), state.velocity.resize(count + dummy_points);
  for (std::size_t v = 0; v < count; ++v) {
    Point<double>& p = state.position[v];
    p.set(input.positions.row(static_cast<Eigen::Index>(v)).transpose() - input.origin);
    p.w = scene.pins.pinned(static_cast<int>(v)) ? 0 : 1 / input.mass[v];
  }
  state.previous = state.position;
  return state;
}

}  // namespace

std::optional<Inside> inside_at_start(const BuiltScene& scene, std::size_t index) {
  const Effect& effect = scene.effects[index];
  if (!effect.kind().is_obstacle()) return std::nullopt;
  State<double> state = state_of(scene);
  const Points<double> start = state.position;
  const Constraints<double> none;
  PassContext<double> context{state, none, scene.input.settings.dt / scene.input.settings.substeps};
  const std::vector<Pass<double>> passes =
      passes_of<double>(effect, {scene.rest, scene.pins, {}, false, scene.folder});
  for (const Stage stage : {Stage::predicted, Stage::project})
    for (const Pass<double>& pass : passes)
      if (pass.stage == stage) pass.run(context);
  constexpr double shallow = 0.01;  // of the size: more than the obstacle's thickness and rounding errors
  Inside inside{0, 0, 0};
  for (int v = 0; v < state.vertex_count; ++v) {
    const auto at = static_cast<std::size_t>(v);
    const double depth = (state.position[at].vector() - start[at].vector()).norm();
    if (depth > shallow * scene.rest.size()) ++inside.count;
    if (depth > inside.depth) inside.deepest = v, inside.depth = depth;
  }
  return inside;
}

}  // namespace bendlab
