// Settings of obstacles and loose vertices, for the tests of obstacles and friction.
#pragma once

#include <utility>
#include <vector>

#include "tests/support.hpp"

namespace bendlab::test {

using Settings = Changes;

inline std::vector<double> list(const Vector3& v) {
  return {v.x(), v.y(), v.z()};
}

/// Adds an effect with settings to the passes of a scene.
template <class Real>
void add_effect(std::vector<Pass<Real>>& passes, std::string_view name, const RestMesh& rest,
                const Settings& settings, bool contacts_used = true) {
  const Pins none = make_pins(rest, {}, 0);
  for (Pass<Real>& pass :
       bendlab::passes_of<Real>(effect_of(name, settings), {rest, none, {}, contacts_used}))
    passes.push_back(std::move(pass));
}

/// Vertices of 1 kg that no constraint joins, at rest at the origin.
inline RestMesh vertices(int count) {
  return RestMesh({Positions::Zero(count, 3), Triangles(0, 3), {}});
}

inline SimulationInput loose(const RestMesh& rest) {
  SimulationInput input{.method = Pbd{}};
  input.positions = rest.positions();
  input.origin = Vector3::Zero();
  input.size = 10;  // m
  input.mass.assign(static_cast<std::size_t>(rest.vertex_count()), 1);
  input.is_pinned.assign(input.mass.size(), 0);
  return input;
}

}  // namespace bendlab::test
