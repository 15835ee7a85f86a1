// A scene in motion, from a few lines of C++.
#pragma once

#include <memory>
#include <vector>

#include "bendlab/scene/built_scene.hpp"

namespace bendlab {

/// A cloth that moves: a built scene and its simulation. May be moved, not copied.
class Cloth {
 public:
  explicit Cloth(BuiltScene scene);

  /// One time step Solver::dt. Throws std::runtime_error if the cloth diverged, with where and when.
  void step();
  /// Steps until that many seconds are over, or further steps would change nothing.
  void run(double seconds);

  double time() const { return simulation_->time(); }                      ///< s
  Positions positions() const { return simulation_->positions(); }         ///< #V by 3, m
  Positions velocities() const { return simulation_->velocities(); }       ///< #V by 3, m/s
  const Triangles& triangles() const { return scene_->rest.triangles(); }  ///< #T by 3
  const BuiltScene& scene() const { return *scene_; }
  Simulation& simulation() { return *simulation_; }

 private:
  std::unique_ptr<BuiltScene> scene_;  // on the heap, because the simulation may refer to it
  std::unique_ptr<Simulation> simulation_;
};

/// Builds a scene and starts it: defaults that depend on other settings are filled in, and Initial::after is
/// simulated. Throws ConfigError with everything that is wrong (values out of range, unread settings,
/// settings that contradict each other), and what build_scene() throws.
Cloth simulate(Scene scene);

}  // namespace bendlab
