#include "bendlab/scene/pins_of.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <cmath>

#include "bendlab/scene/built_scene.hpp"
#include "bendlab/scene/strict_json.hpp"
#include "bendlab/settings/names.hpp"

namespace bendlab {
namespace {

// For an upright sheet, names such as `upper_left` assume that z is up. Refuses these names for a sheet in a
// plane x = const if gravity shows that y is up.
void require_up(const RestMesh& rest, const std::vector<Place>& names, const Vector3& down) {
  const NamedAxes axes = named_axes(rest);
  if (names.empty() || axes.front != 0 || std::abs(down.z()) >= std::abs(down.y())) return;
  throw ConfigError(
      "/pins/vertices",
      {{"/pins/vertices",
        fmt::format("'{}' is not clear for this sheet: for a sheet in a plane x = const, names assume that z "
                    "is up, but gravity acts along y. Turn the mesh into the x-y plane or so that z is up, "
                    "or use /pins/indices with \"vertices\": []",
                    name_in(place_names, names.front()))}});
}

// Holds vertices along an axis.
void hold(Pins& pins, const RestMesh& rest, int axis, const std::string& setting,
          const std::vector<Place>& places, const std::vector<int>& indices) {
  if (places.empty() && indices.empty()) return;
  pins.held.resize(pins.is_pinned.size(), 0);
  const auto add = [&](int v) { pins.held[static_cast<std::size_t>(v)] |= static_cast<char>(1 << axis); };
  for (const Place place : places) try {
      for (const int v : select_vertices(rest, place)) add(v);
    } catch (const std::invalid_argument& error) {
      throw ConfigError("/pins", {{"/pins/" + setting, error.what()}});
    }
  for (const int index : indices) {
    if (index >= rest.vertex_count())
      throw ConfigError("/pins", {{fmt::format("/pins/{}_indices", setting),
                                   fmt::format("vertex {} is not in the mesh, which has vertices 0 to {}",
                                               index, rest.vertex_count() - 1)}});
    add(index);
  }
}

// Marks the held vertices on planes of symmetry. A smooth sheet crosses such a plane at a right angle.
void mark_symmetry(Pins& pins, const RestMesh& rest, const std::vector<CoordinateAxis>& planes) {
  if (planes.empty()) return;
  const auto refuse = [](const std::string& problem) {
    throw ConfigError("/pins", {{"/pins/symmetry", problem}});
  };
  pins.symmetric.resize(pins.is_pinned.size(), 0);
  for (const CoordinateAxis plane : planes) {
    const int axis = static_cast<int>(plane);
    const std::string_view name = coordinate_axis_names[static_cast<std::size_t>(axis)];
    bool found = false;
    for (std::size_t v = 0; v < pins.held.size(); ++v)
      if ((pins.held[v] >> axis & 1) != 0) found = true, pins.symmetric[v] |= static_cast<char>(1 << axis);
    if (!found)
      refuse(
          fmt::format("no vertex is held along {0}: name the vertices on the plane of symmetry in "
                      "/pins/hold_{0}",
                      name));
    constexpr double steepest = 0.5;  // along the axis, of a unit normal; triangles are not smooth
    for (int t = 0; t < rest.triangle_count(); ++t) {
      const auto corner = rest.triangles().row(t);
      for (int c = 0; c < 3; ++c) {
        if ((pins.symmetric[static_cast<std::size_t>(corner(c))] >> axis & 1) == 0) continue;
        const Vector3 p = rest.position(corner(0)),
                      normal = (rest.position(corner(1)) - p).cross(rest.position(corner(2)) - p);
        if (std::abs(normal[axis]) > steepest * normal.norm())
          refuse(
              fmt::format("at vertex {0} the sheet does not cross a plane of constant {1} at a right angle, "
                          "so this is no plane of symmetry: name another axis, or remove the vertex from "
                          "/pins/hold_{1}",
                          corner(c), name));
      }
    }
  }
}

}  // namespace

Pins pins_of(const Scene& scene, const RestMesh& rest, const std::vector<std::string>& mesh_notes,
             bool renumbered, const Vector3& down) {
  const Pinning& pinning = scene.pins;
  require_up(rest, pinning.vertices, down);
  if (renumbered && !pinning.indices.empty())
    throw MeshError(fmt::format(
        "{}: {}; because of that change, /pins/indices would mean other vertices than in the given mesh. "
        "Repair the mesh file before the run, or pin by name with /pins/vertices",
        scene.mesh.file ? (scene.folder / *scene.mesh.file).string() : "mesh", fmt::join(mesh_notes, "; ")));
  std::vector<int> seeds;
  for (const Place place : pinning.vertices) try {
      for (const int vertex : select_vertices(rest, place)) seeds.push_back(vertex);
    } catch (const std::invalid_argument& error) {  // the mesh has no vertices with that name
      throw ConfigError("/pins/vertices", {{"/pins/vertices", error.what()}});
    }
  for (const int index : pinning.indices) {
    if (index >= rest.vertex_count())
      throw ConfigError("/pins/indices",
                        {{"/pins/indices", fmt::format("vertex {} is not in the mesh, which has vertices "
                                                       "0 to {}",
                                                       index, rest.vertex_count() - 1)}});
    seeds.push_back(index);
  }
  Pins pins = make_pins(rest, std::move(seeds), pinning.ring, pinning.distance);
  hold(pins, rest, 0, "hold_x", pinning.hold_x, pinning.hold_x_indices);
  hold(pins, rest, 1, "hold_y", pinning.hold_y, pinning.hold_y_indices);
  hold(pins, rest, 2, "hold_z", pinning.hold_z, pinning.hold_z_indices);
  mark_symmetry(pins, rest, pinning.symmetry);
  return pins;
}

}  // namespace bendlab
