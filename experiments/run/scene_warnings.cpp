// Warnings about the scene.
#include "experiments/run/warning_messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bendlab/effects/effect.hpp"
#include "bendlab/mesh/connected_parts.hpp"
#include "bendlab/mesh/half_edges.hpp"
#include "bendlab/scene/fabrics.hpp"
#include "bendlab/scene/gravity.hpp"
#include "bendlab/scene/inside.hpp"
#include "bendlab/settings/median.hpp"
#include "experiments/config/settings_by_pointer.hpp"

namespace bendlab {

// ---- piece_without_pin

Message piece_without_pin(const WarningInput& input) {
  const RestMesh& rest = input.scene.rest;
  if (input.scene.pins.all.empty()) return std::nullopt;
  std::size_t loose = 0;
  int first = 0;
  for (const std::vector<int>& part : connected_parts(rest.one_ring())) {
    if (std::ranges::any_of(part, [&](int v) { return input.scene.pins.pinned(v); })) continue;
    if (loose == 0) first = part.front();
    loose += part.size();
  }
  if (loose == 0) return std::nullopt;
  return fmt::format(
      "pieces of the mesh without a pin will fall away: these pieces have {} of the {} vertices of the mesh "
      "(the first is vertex {}). Pin each piece, or join the pieces ('bendlab mesh FILE' counts them)",
      loose, rest.vertex_count(), first);
}

// ---- effect_without_pins

Message effect_without_pins(const WarningInput& input) {
  if (!input.scene.pins.all.empty()) return std::nullopt;
  for (std::size_t index = 0; index < input.scene.effects.size(); ++index)
    if (const Effect& effect = input.scene.effects[index]; effect.kind().needs_pins)
      return fmt::format(
          "/effects/{} ({}) does nothing, because no vertex is pinned. Name pins in /pins/vertices or "
          "/pins/indices, or remove the effect",
          index, effect.name());
  return std::nullopt;
}

// ---- friction_without_obstacle

Message friction_without_obstacle(const WarningInput& input) {
  const std::vector<Effect>& effects = input.scene.effects;
  const auto friction =
      std::ranges::find_if(effects, [](const Effect& effect) { return effect.kind().uses_contacts; });
  if (friction == effects.end() || has_obstacle(input.scene)) return std::nullopt;
  return fmt::format("/effects/{} ({}) does nothing, because it acts on obstacles and there is no obstacle",
                     friction - effects.begin(), friction->name());
}

// ---- mixed_sides

Message mixed_sides(const WarningInput& input) {
  std::string who;
  if (const BendingKind& model = input.config.scene().bending.model.kind(); model.uses_sides)
    who = fmt::format("the bending model {}", model.name);
  for (std::size_t index = 0; index < input.scene.effects.size(); ++index)
    if (const Effect& effect = input.scene.effects[index]; effect.kind().uses_sides)
      who = fmt::format("/effects/{} ({})", index, effect.name());
  if (who.empty()) return std::nullopt;
  const Triangles& triangles = input.scene.rest.triangles();
  std::size_t shared = 0, mixed = 0;
  for_each_edge(half_edges(triangles), [&](std::span<const HalfEdge<int>> sides) {
    if (sides.size() != 2) return;
    ++shared;
    if (triangles(sides[0].triangle(), sides[0].corner()) ==
        triangles(sides[1].triangle(), sides[1].corner()))
      ++mixed;
  });
  if (mixed == 0) return std::nullopt;
  const double share = static_cast<double>(mixed) / static_cast<double>(shared);
  return WarningText(
      fmt::format(
          "{} needs triangles that all face the same side, but those at {} of {} edges face different sides. "
          "Set /mesh/bad_triangles to repair, which turns triangles so that all "
          "face the same side, or turn their normals in an editor",
          who, mixed, shared),
      share, fmt::format("{:.0f} %", 100 * share));
}

// ---- doubtful_effect

// Effects check their own settings in this scene (EffectKind::doubt). The largest doubt becomes the warning.
Message doubtful_effect(const WarningInput& input) {
  const SimulationInput& scene = input.scene.input;
  const std::vector<double>& areas = input.scene.rest.areas();
  std::optional<Doubt> largest;
  for (std::size_t index = 0; index < input.scene.effects.size(); ++index) {
    const Effect& effect = input.scene.effects[index];
    if (effect.kind().doubt == nullptr) continue;
    std::optional<Doubt> doubt = effect.kind().doubt(
        effect.settings(),
        {.rest = input.scene.rest,
         .pins = input.scene.pins,
         .density = std::accumulate(scene.mass.begin(), scene.mass.end(), 0.0) /
                    std::accumulate(areas.begin(), areas.end(), 0.0),
         .gravity = gravity_of(input.scene.effects).norm(),
         .substep = scene.method.kind().has_motion ? scene.settings.dt / scene.settings.substeps : 0,
         .substeps = scene.settings.substeps,
         .where = fmt::format("/effects/{} ({})", index, effect.name())});
    if (doubt && (!largest || doubt->size > largest->size)) largest = std::move(doubt);
  }
  if (!largest) return std::nullopt;
  return WarningText(largest->text, largest->size, largest->shown);
}

// ---- starts_inside

Message starts_inside(const WarningInput& input) {
  for (std::size_t index = 0; index < input.scene.effects.size(); ++index) {
    const std::optional<Inside> inside = inside_at_start(input.scene, index);
    if (!inside || inside->count == 0) continue;
    return WarningText(
        fmt::format(
            "{} of {} vertices start inside /effects/{} ({}), and vertex {} is {:.3g} m deep: the first step "
            "throws these vertices out. Move the obstacle, or move the cloth by /mesh/offset",
            inside->count, input.scene.rest.vertex_count(), index, input.scene.effects[index].name(),
            inside->deepest, inside->depth),
        inside->depth, fmt::format("{:.3g} m", inside->depth));
  }
  return std::nullopt;
}

// ---- far_vertex

namespace {

// If parts of a mesh are finer than others, edge lengths differ by a factor of at most some tens. A vertex
// that was moved by a slip of the mouse or a wrong digit is much farther away.
constexpr double far = 200;  // times the median edge

}  // namespace

Message far_vertex(const WarningInput& input) {
  const RestMesh& rest = input.scene.rest;
  const auto& positions = rest.positions();
  std::vector<double> lengths;
  const Adjacency& neighbours = rest.one_ring();
  const auto length = [&](int from, int to) { return (positions.row(from) - positions.row(to)).norm(); };
  double longest = 0;
  int vertex = -1, other = -1;
  for (int from = 0; from < rest.vertex_count(); ++from)
    for (const int to : neighbours[static_cast<std::size_t>(from)])
      if (from < to) {
        lengths.push_back(length(from, to));
        if (lengths.back() > longest) longest = lengths.back(), vertex = from, other = to;
      }
  if (lengths.empty()) return std::nullopt;
  const double median = upper_median(lengths);
  if (!(longest > far * median)) return std::nullopt;
  // The warning names the vertex that is farther from the centre.
  const auto from_centre = [&](int v) { return (positions.row(v).transpose() - rest.centre()).norm(); };
  if (from_centre(other) > from_centre(vertex)) std::swap(vertex, other);
  return fmt::format(
      "vertex {} lies {:.3g} m from its neighbour {}, which is {:.2g} times the median length of an edge: is "
      "the vertex where it should be? 'bendlab mesh FILE' describes the mesh",
      vertex, longest, other, longest / median);
}

// ---- all_pinned

Message all_pinned(const WarningInput& input) {
  const auto vertices = static_cast<std::size_t>(input.scene.rest.vertex_count());
  if (input.scene.pins.all.size() != vertices) return std::nullopt;
  return fmt::format(
      "all {} vertices are pinned, so nothing can move. /pins/vertices names places in the x-y plane of the "
      "mesh's box. If the mesh stands upright, choose other places, or use /pins/indices. A smaller "
      "/pins/ring or /pins/distance pins fewer vertices",
      vertices);
}

// ---- other_extent

// Whole rows of equilateral triangles do not fill every rectangle. For a shell, whose material is stated, one
// percent of the length is three percent of a deflection.
Message other_extent(const WarningInput& input) {
  const Scene& scene = input.config.scene();
  const Mesh& mesh = scene.mesh;
  if (mesh.file || mesh.given || mesh.generator != Generator::equilateral || mesh.surface.is_given() ||
      !scene.material.youngs_modulus)
    return std::nullopt;
  const Positions& rest = input.scene.rest.positions();
  const Eigen::RowVector3d extent = rest.colwise().maxCoeff() - rest.colwise().minCoeff();
  const double width = mesh.scale * mesh.width, height = mesh.scale * mesh.height,
               off = std::max(std::abs(extent.x() / width - 1), std::abs(extent.y() / height - 1));
  constexpr double seen = 0.005;
  if (!(off > seen)) return std::nullopt;
  return WarningText(
      fmt::format("the sheet is {:.4g} m by {:.4g} m instead of {:.4g} m by {:.4g} m, because whole "
                  "equilateral triangles do not fill the stated extents. State extents that suit the rows, "
                  "use more cells, or set /mesh/generator to grid",
                  extent.x(), extent.y(), width, height),
      off, fmt::format("{:.2g} %", 100 * off));
}

// ---- no_symmetry_plane

namespace {

// Whether both ends of a border edge keep the coordinate along an axis that lies in the sheet and points
// across the border, as on a plane of symmetry, and the sheet can turn about the edge. It cannot if the third
// vertex of the triangle is pinned.
bool held_across(const RestMesh& rest, const Pins& pins, const HalfEdge<int>& side, int axis) {
  const auto corners = rest.triangles().row(side.triangle());
  const int c = side.corner(), a = corners(c), b = corners((c + 1) % 3), top = corners((c + 2) % 3);
  const auto held = [&](int v) {
    const auto at = static_cast<std::size_t>(v);
    const int turning = pins.held[at] & ~(pins.symmetric.empty() ? 0 : pins.symmetric[at]);
    return !pins.pinned(v) && (turning & (1 << axis)) != 0;
  };
  if (!held(a) || !held(b) || pins.pinned(top)) return false;
  const Vector3 edge = (rest.position(b) - rest.position(a)).normalized();
  const Vector3 offset = rest.position(top) - rest.position(a);
  const Vector3 across = (offset - offset.dot(edge) * edge).normalized();
  constexpr double along_axis = 0.99;  // cosine
  return std::abs(across[axis]) > along_axis;
}

}  // namespace

Message no_symmetry_plane(const WarningInput& input) {
  const BuiltScene& scene = input.scene;
  if (scene.pins.held.empty() || !input.config.scene().bending.model.kind().bends) return std::nullopt;
  std::array<int, 3> edges{};
  for_each_edge(half_edges(scene.rest.triangles()), [&](std::span<const HalfEdge<int>> sides) {
    if (sides.size() != 1) return;
    for (int axis = 0; axis < 3; ++axis)
      edges[static_cast<std::size_t>(axis)] += held_across(scene.rest, scene.pins, sides.front(), axis);
  });
  const auto most = std::ranges::max_element(edges);
  if (*most == 0) return std::nullopt;
  const std::string axis(1, static_cast<char>('x' + (most - edges.begin())));
  return WarningText(
      fmt::format(
          "/pins/hold_{0} keeps the coordinate {0} of {1} border edges, and the sheet turns freely about "
          "these "
          "edges. So they do not lie on a plane of symmetry, where the sheet would keep its slope. For a "
          "plane of symmetry, choose the bending model dkt and add \"{0}\" to /pins/symmetry, or simulate "
          "both halves",
          axis, *most),
      *most, fmt::format("{} edges", *most));
}

// ---- units

namespace {

// Under gravity a cloth of length L falls and swings within a time of √(L / g): 0.03 s for 1 cm, 0.8 s for 6
// m. Clothes and curtains are longer than 1 cm and shorter than 6 m; a mesh in mm or cm that is read in m is
// longer. Gravity weaker than the Earth's is a choice, and says nothing about units.
constexpr double shortest_time = 0.03, longest_time = 0.8;      // s
constexpr double weakest_gravity = 9, strongest_gravity = 100;  // m/s²; Earth's in cm/s² is 981
// kg/m²: gauze has 0.02, a heavy carpet 4, a plastic film 1 µm thick 0.001.
constexpr double lightest = 0.001, heaviest = 10;
// A membrane that its own weight stretches to twice its length is no cloth; rubber 0.1 mm thick has 100 N/m.
constexpr double most_strain = 1;
// Bending length divided by extent. A sheet that would sag only if it were five times as long is a board.
// Paper 0.2 m long has a ratio of 0.5; a steel sheet 1 mm thick and 1 m long has 0.6.
constexpr double longest_bending_length = 5;
constexpr double shortest_bending_length = 5e-4;  // m; our softest fabric has 0.01 m
constexpr double largest_friction = 600;          // HB/B, 1/m: ten times the largest that was measured

// The warning about a stiffness that does not fit the weight of the cloth. `load`: weight per area, N/m².
std::optional<std::string> odd_stiffness(const WarningInput& input, double load, double extent) {
  const StrainStiffness& strain = input.scene.input.strain_stiffness;
  const double softest = input.scene.input.softest_membrane();
  const double weight_strain = strain.kind == StiffnessKind::compliance ? softest * load * extent : 0;
  if (weight_strain > most_strain)
    return fmt::format(
        "the cloth's own weight stretches a membrane of {:.3g} N/m to {:.2g} times its length: is "
        "/material/strain in other units? A thin cotton has about 1e4 N/m",
        1 / softest, 1 + weight_strain);
  const Bending& bending = input.config.scene().bending;
  if (bending.stiffness != Stiffness::physical || !bending.flexural_rigidity) return std::nullopt;
  const double rigidity = *bending.flexural_rigidity, length = std::cbrt(rigidity / load);
  if (bending.hysteresis.hb && *bending.hysteresis.hb > largest_friction * rigidity)
    return fmt::format(
        "with HB = {:.3g} N a sheet may keep a curvature of {:.2g} /m: is hb in other units? The "
        "fabrics that we know keep 18 to 53 /m; 1 gf cm/cm is 9.8e-3 N",
        *bending.hysteresis.hb, *bending.hysteresis.hb / rigidity);
  if (rigidity > 0 && length < shortest_bending_length)
    return fmt::format(
        "with a flexural rigidity of {:.3g} N m, a strip longer than {:.2g} mm hangs down: is the "
        "rigidity in other units? A light cotton has 1e-5 N m; 1 gf cm²/cm is 9.8e-5 N m",
        rigidity, 1e3 * length);
  if (!(length > longest_bending_length * extent)) return std::nullopt;
  return fmt::format(
      "with a flexural rigidity of {:.3g} N m, gravity cannot bend this sheet: the sheet would sag only if "
      "it were about {:.2g} m long, but it is only {:.2g} m long. Is the rigidity in other units? A light "
      "cotton has 1e-5 N m; 1 gf cm²/cm is 9.8e-5 N m",
      rigidity, length, extent);
}

}  // namespace

Message units(const WarningInput& input) {
  const RestMesh& rest = input.scene.rest;
  const double g = gravity_of(input.scene.effects).norm();
  const double extent = (rest.box_max() - rest.box_min()).maxCoeff();
  const double density = input.config.scene().material.density;
  if (density > heaviest)
    return fmt::format(
        "a density of {:.3g} kg/m² is more than any cloth has: is it in g/m²? 200 g/m² is 0.2 kg/m²",
        density);
  if (density < lightest)
    return fmt::format(
        "a density of {:.3g} kg/m² is less than any cloth has: is it in g/cm²? 0.02 g/cm² is 0.2 kg/m²",
        density);
  const double time = std::sqrt(extent / g);
  if (g > strongest_gravity && time < shortest_time)
    return fmt::format(
        "a gravity of {:.4g} m/s² is {:.0f} times that of the Earth, 9.81 m/s²: is it in mm/s² or cm/s²?", g,
        g / 9.81);
  if (!(g >= weakest_gravity)) return std::nullopt;
  if (time < shortest_time || time > longest_time)
    return fmt::format(
        "the cloth is {:.3g} m long ({}), and gravity is {:.3g} m/s²: is the mesh in other units? "
        "/mesh/scale converts lengths to metres (0.001 for millimetres, 0.01 for centimetres)",
        extent,
        time > longest_time ? "as long as a theatre's curtain, or longer" : "shorter than a fingertip", g);
  return odd_stiffness(input, density * g, extent);
}

// ---- fabric_without_friction

Message fabric_without_friction(const WarningInput& input) {
  const Scene& scene = input.config.scene();
  const Fabric* const fabric = scene.material.fabric ? find_fabric(*scene.material.fabric) : nullptr;
  if (fabric == nullptr) return std::nullopt;
  if (scene.bending.stiffness != Stiffness::physical)
    return WarningText(
        fmt::format("the run takes the density of {}, but not its rigidity: /bending/stiffness is "
                    "not physical. Set /bending/stiffness to physical to have the rigidity",
                    fabric->name),
        0, "");
  const BendingKind& model = scene.bending.model.kind();
  const bool rubs = fabric->friction > 0 && !scene.bending.hysteresis.is_given(),
             softens = fabric->half_at > 0 && !scene.bending.softening.is_given();
  if (!rubs && !softens) return std::nullopt;
  const double size = rubs ? fabric->friction / (0.5 * (fabric->warp + fabric->weft)) : fabric->half_at;
  const bool has_motion = scene.solver.method.kind().has_motion;
  const std::string reason =
      !(rubs ? model.yields : model.softens)
          ? fmt::format("{} cannot have it: choose mid_edge or discrete_shells", model.name)
      : rubs && !has_motion ? fmt::format("{} has no motion: choose quasi_newton", scene.solver.method.name())
      : rubs                ? std::string(
                                  "a hinge has friction only if its measure is theta: set "
                                                 "/bending/discrete_shells/measure to theta")
             : std::string(
                   "the config states folds that stay (/bending/plasticity), and a sheet "
                   "cannot have both");
  return WarningText(
      fmt::format("the run leaves out the {} = {:.3g} /m of {}, because {}",
                  rubs ? "internal friction HB/B" : "softening κ½", size, fabric->name, reason),
      size, fmt::format("{:.3g} /m", size));
}

}  // namespace bendlab
