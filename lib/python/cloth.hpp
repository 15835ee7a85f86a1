// The cloth of the Python package. Its arrays stay in the same memory; only one thread at a time may use it.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bendlab/bendlab.hpp"
#include "hand.hpp"

namespace bendlab {

class PythonCloth {
 public:
  /// Reads a scene from JSON. `mesh` replaces the mesh that the scene describes. Throws ConfigError for a
  /// wrong scene, and the exceptions of simulate().
  PythonCloth(const std::string& scene, const std::string& folder, std::optional<TriangleMesh> mesh);

  /// One time step, without the GIL. Throws std::runtime_error if the cloth diverged, or if another call is
  /// using the cloth. Passes on an exception that a Python model or effect raises; the cloth is then as it
  /// was before the step.
  void step();
  /// Steps until `seconds` are over. Handles Python's signals between steps. `progress` (or None) is called a
  /// few times per second with the finished share.
  void run(double seconds, const pybind11::object& progress);

  double time() const { return cloth_.time(); }  ///< s
  bool settled() { return cloth_.simulation().settled(); }
  /// (V, 3), m and m/s: read-only views. Every call writes the present state into the same memory, and
  /// returns a view of this memory. Views keep the memory alive.
  pybind11::array positions();
  pybind11::array velocities();
  pybind11::array triangles() const;  ///< (T, 3)
  pybind11::array masses() const;     ///< (V), kg
  pybind11::array pinned() const;     ///< (P): which vertices are pinned
  /// (P, 3), m: where the pinned vertices are at the end of the next step. Every call returns the same
  /// memory, and Python may write to it. Throws std::invalid_argument for a method that does not move pins.
  pybind11::array pins();
  /// (code, text) of each warning about the scene, as `bendlab run` prints it.
  std::vector<std::pair<std::string, std::string>> warnings() const { return warnings_; }

  /// Energies, J: "kinetic", "weight", "strain", and each kind of bending constraint. Constraints whose
  /// stiffness is given as k have no energy and are left out.
  pybind11::dict energies();
  /// Forces, (V, 3), N, for each kind of constraint; 0 at pinned vertices. Forces of effects are left out.
  pybind11::dict forces();

 private:
  struct Arrays;
  class Use;

  void step_once();

  Cloth cloth_;
  bool has_python_parts_ = false;
  std::vector<std::pair<std::string, std::string>> warnings_;
  std::shared_ptr<HandMotion> hand_;  // null until pins() was called
  std::shared_ptr<Arrays> arrays_;
  std::atomic<bool> in_use_{false};
};

}  // namespace bendlab
