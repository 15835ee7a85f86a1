// Warnings about what is simulated.
#include "experiments/run/warning_messages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

#include "bendlab/effects/effect.hpp"
#include "bendlab/mesh/connected_parts.hpp"
#include "experiments/config/config_tables.hpp"
#include "experiments/config/defaults.hpp"
#include "experiments/config/pointers.hpp"
#include "experiments/config/stiffness_settings.hpp"
#include "experiments/scene/gravity.hpp"
#include "experiments/scene/inside.hpp"

namespace bendlab {

// ---- inert_seed

namespace {

// null is the default, and chooses nothing.
bool gives(const Json& settings, const std::string& pointer) {
  const Json* const value = value_at(settings, pointer);
  return value != nullptr && !value->is_null();
}

// Whether the config gives a value for `pointer`: sets it, or sweeps it or an object that holds it.
bool is_chosen(const WarningInput& input, const std::string& pointer) {
  if (gives(input.experiment.settings, pointer)) return true;
  for (const auto& [swept, value] : input.config.point) {
    if (swept == pointer && !value.is_null()) return true;
    if (lies_within(pointer, swept) && gives(value, pointer.substr(swept.size()))) return true;
  }
  return false;
}

// Whether other runs follow from this one's settings, which may use what this one does not.
bool has_derived_runs(const RunConfig& config) {
  const ParameterValues& accuracy = config.section("/accuracy");
  return config.section("/initial").has("after") || accuracy.has("solver") || accuracy.has("physical");
}

}  // namespace

Message inert_seed(const WarningInput& input) {
  if (has_derived_runs(input.config)) return std::nullopt;
  const ParameterValues initial = input.config.section("/initial"), mesh = input.config.section("/mesh");
  const bool initial_used = initial.number("perturbation") > 0 || initial.number("random") > 0,
             mesh_used = input.config.mesh_file().empty() && mesh.text("generator") == "delaunay";
  std::string inert;
  if (!initial_used && is_chosen(input, "/initial/seed")) inert = "/initial/seed";
  if (!mesh_used && is_chosen(input, "/mesh/seed")) inert = "/mesh/seed";
  if (inert.empty()) return std::nullopt;
  return fmt::format(
      "{} changes nothing here: runs that differ in it alone are equal, and their spread is 0. {}", inert,
      inert == "/mesh/seed" ? "Only /mesh/generator: delaunay uses it"
                            : "Set /initial/perturbation, to 1e-6 for example, or remove the seed");
}

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
      "pieces of the mesh with {} of its {} vertices (the first is vertex {}) have no pin, while others "
      "have: they will fall away. Pin each piece, or join them ('bendlab mesh FILE' counts the pieces)",
      loose, rest.vertex_count(), first);
}

// ---- effect_without_pins

// Tethers are a default, and then nobody has asked for them.
Message effect_without_pins(const WarningInput& input) {
  if (!input.scene.pins.all.empty()) return std::nullopt;
  const Json* const effects = value_at(input.experiment.settings, "/effects");
  const bool by_default = effects == nullptr || *effects == default_effects(input.experiment.settings);
  for (std::size_t index = 0; index < input.scene.effects.size(); ++index) {
    const std::string& type = input.scene.effects[index].type;
    if (type == "moving_pins" || (type == "tethers" && !by_default))
      return fmt::format(
          "/effects/{} ({}) does nothing, because no vertex is pinned. Name pins in /pins/vertices or "
          "/pins/indices, or remove the effect",
          index, type);
  }
  return std::nullopt;
}

// ---- friction_without_obstacle

Message friction_without_obstacle(const WarningInput& input) {
  const std::vector<EffectSettings>& effects = input.scene.effects;
  const auto friction = std::ranges::find(effects, "friction", &EffectSettings::type);
  if (friction == effects.end() || has_obstacle(input.scene)) return std::nullopt;
  return fmt::format("/effects/{} (friction) does nothing, because it acts on obstacles and there is none",
                     friction - effects.begin());
}

// ---- kinetic_above_static

Message kinetic_above_static(const WarningInput& input) {
  for (std::size_t index = 0; index < input.scene.effects.size(); ++index) {
    const EffectSettings& effect = input.scene.effects[index];
    if (effect.type != "friction" || effect.values.number("kinetic") <= effect.values.number("static"))
      continue;
    return fmt::format(
        "/effects/{} (friction): kinetic, {:.3g}, is above static, {:.3g}, so that what slides is held more "
        "than what rests. Set static to at least {:.3g}",
        index, effect.values.number("kinetic"), effect.values.number("static"),
        effect.values.number("kinetic"));
  }
  return std::nullopt;
}

// ---- coarse_wind

// The wind takes no more than the speed that a substep has, so that cloth does not fly up against it. Cloth
// at the speed u with respect to the air is slowed within τ = ρ / (½ ρ_air C_D u): a substep h of more than τ
// cuts the force, and a sheet that falls at its terminal speed (τ = u/g) falls faster, by 23 % at h = 1.2 τ.
Message coarse_wind(const WarningInput& input) {
  const std::vector<EffectSettings>& effects = input.scene.effects;
  const auto wind = std::ranges::find(effects, "wind", &EffectSettings::type);
  if (wind == effects.end() || !input.scene.input.method->has_motion) return std::nullopt;
  const SimulationInput& scene = input.scene.input;
  const std::vector<double>& areas = input.scene.rest.areas();
  const double density = std::accumulate(scene.mass.begin(), scene.mass.end(), 0.0) /
                         std::accumulate(areas.begin(), areas.end(), 0.0),
               drag = 0.5 * wind->values.number("air_density") * wind->values.number("drag_coefficient"),
               falling = gravity_of(effects).norm(), terminal = std::sqrt(density * falling / drag),
               blowing = Vector3(wind->values.numbers("velocity").data()).norm(),
               substep = scene.settings.dt / scene.settings.substeps;
  if (!(drag > 0)) return std::nullopt;
  const double slowed_within = density / (drag * std::max(blowing, terminal));  // s
  if (!(substep > slowed_within)) return std::nullopt;
  constexpr double wanted = 0.5;  // substeps
  return fmt::format(
      "a substep of {:.2g} s is long for the wind, which brings this cloth to its own speed within {:.2g} s: "
      "its force is cut. Take about {} /solver/substeps",
      substep, slowed_within,
      static_cast<long>(std::ceil(scene.settings.substeps * substep / (wanted * slowed_within))));
}

// ---- starts_inside

Message starts_inside(const WarningInput& input) {
  for (std::size_t index = 0; index < input.scene.effects.size(); ++index) {
    const std::optional<Inside> inside = inside_at_start(input.scene, index);
    if (!inside || inside->count == 0) continue;
    return fmt::format(
        "{} of {} vertices start inside /effects/{} ({}), vertex {} by {:.3g} m: the first step throws them "
        "out. Move the obstacle, or the cloth by /mesh/offset",
        inside->count, input.scene.rest.vertex_count(), index, input.scene.effects[index].type,
        inside->deepest, inside->depth);
  }
  return std::nullopt;
}

// ---- thick_cloth

// Each element is near all that lie within the thickness, and is compared with them in each substep.
Message thick_cloth(const WarningInput& input) {
  const std::vector<EffectSettings>& effects = input.scene.effects;
  const auto collision = std::ranges::find(effects, "self_collision", &EffectSettings::type);
  if (collision == effects.end()) return std::nullopt;
  constexpr double most = 2;  // edges
  const double thickness = collision->values.number("thickness"), edge = input.scene.rest.mean_edge_length();
  if (!(thickness > most * edge)) return std::nullopt;
  return fmt::format(
      "/effects/{} (self_collision): a thickness of {:.3g} m is {:.2g} times the mean edge, so that each "
      "triangle is compared with many others in every step (with 2.3 edges a sheet took 4 times as long as "
      "with 0.6). Set thickness to about {:.2g} m, half an edge, or take fewer cells",
      collision - effects.begin(), thickness, thickness / edge, 0.5 * edge);
}

// ---- far_vertex

namespace {

// Edges of cloth that was made finer in places differ by some tens; a vertex that a slip of the mouse or a
// wrong digit moved away is much farther.
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
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::ranges::nth_element(lengths, middle);
  if (!(longest > far * *middle)) return std::nullopt;
  // Of the two the one that is farther from all.
  const auto from_centre = [&](int v) { return (positions.row(v).transpose() - rest.centre()).norm(); };
  if (from_centre(other) > from_centre(vertex)) std::swap(vertex, other);
  return fmt::format(
      "vertex {} lies {:.3g} m from its neighbour {}, {:.2g} times as far as the median edge is long: is it "
      "where it should be? 'bendlab mesh FILE' tells about the mesh",
      vertex, longest, other, longest / *middle);
}

// ---- all_pinned

Message all_pinned(const WarningInput& input) {
  const auto vertices = static_cast<std::size_t>(input.scene.rest.vertex_count());
  if (input.scene.pins.all.size() != vertices) return std::nullopt;
  return fmt::format(
      "all {} vertices are pinned, so that nothing can move. /pins/vertices names places in the x-y plane of "
      "the mesh's box: for a mesh that stands upright choose others, or use /pins/indices. A smaller "
      "/pins/ring or /pins/distance pins fewer",
      vertices);
}

// ---- inert_stiffness

// A number that the config's kind of stiffness does not use.
Message inert_stiffness(const WarningInput& input) {
  if (has_derived_runs(input.config)) return std::nullopt;
  for (const StiffnessSetting& setting : stiffness_settings) {
    const auto chooses_the_kind = [&](const auto& axis) {  // other runs of the sweep may use the number
      return lies_within(setting.stiffness, axis.first);
    };
    const Json* const kind = value_at(input.config.resolved(), std::string(setting.stiffness));
    if (kind == nullptr || !kind->is_string() || std::ranges::any_of(input.experiment.axes, chooses_the_kind))
      continue;
    const auto& name = kind->get_ref<const std::string&>();
    if (!setting.used_by(name) && is_chosen(input, std::string(setting.pointer)))
      return fmt::format("{} changes nothing here, because {} is {}. Set that to {}, or remove the number",
                         setting.pointer, setting.stiffness, name, setting.kinds_text());
  }
  return std::nullopt;
}

// ---- inert_setting

namespace {

// Settings of a generated mesh that only some generators read. (A seed has its own warning.)
struct GeneratorSetting {
  std::string_view name;
  std::array<std::string_view, 4> readers;
};
constexpr std::array generator_settings = {
    GeneratorSetting{"width", {"grid", "equilateral", "delaunay"}},
    GeneratorSetting{"height", {"grid", "equilateral", "delaunay", "tube"}},
    GeneratorSetting{"diagonal", {"grid"}},
    GeneratorSetting{"rows", {"equilateral"}},
    GeneratorSetting{"radius", {"disc", "tube", "sphere"}},
    GeneratorSetting{"radius_top", {"tube"}},
};

// Those that the config gives to a generator which does not read them, unless generators are swept.
std::vector<std::string> unread_of_generator(const WarningInput& input) {
  std::vector<std::string> pointers;
  const bool swept = std::ranges::any_of(input.experiment.axes, [](const Axis& axis) {
    return lies_within("/mesh/generator", axis.first) || axis.first == "/mesh/file";
  });
  if (swept || !input.config.mesh_file().empty()) return pointers;
  const std::string& generator = input.config.section("/mesh").text("generator");
  for (const GeneratorSetting& setting : generator_settings)
    if (std::string pointer = child_pointer("/mesh", setting.name);
        is_chosen(input, pointer) && std::ranges::find(setting.readers, generator) == setting.readers.end())
      pointers.push_back(std::move(pointer));
  return pointers;
}

}  // namespace

// Settings of another method or model are left out of the resolved config. Where the choice is swept, other
// runs may use them.
Message inert_setting(const WarningInput& input) {
  if (has_derived_runs(input.config)) return std::nullopt;
  const Json& resolved = input.config.resolved();
  const auto unread = [&](std::string_view in, std::string_view chosen_by) {
    std::vector<std::string> pointers;
    if (std::ranges::any_of(input.experiment.axes,
                            [&](const Axis& axis) { return lies_within(chosen_by, axis.first); }))
      return pointers;
    for (const ConfigSection& section : config_sections())
      if (lies_within(section.pointer, in))
        for (const Parameter& row : section.parameters)
          if (std::string pointer = child_pointer(section.pointer, row.name);
              is_chosen(input, pointer) && value_at(resolved, pointer) == nullptr &&
              std::ranges::find(stiffness_settings, pointer, &StiffnessSetting::pointer) ==
                  stiffness_settings.end())
            pointers.push_back(std::move(pointer));
    return pointers;
  };
  const auto text = [](const std::vector<std::string>& pointers, const std::string& because) {
    const bool one = pointers.size() == 1;
    return fmt::format("{} change{} nothing here, because {}. Remove {}, or choose another ",
                       fmt::join(pointers, ", "), one ? "s" : "", because, one ? "it" : "them");
  };
  const std::string& method = input.config.section("/solver").text("method");
  std::vector<std::string> of_methods = unread("/solver", "/solver/method");
  std::ranges::move(unread("/material/strain", "/solver/method"), std::back_inserter(of_methods));
  if (!of_methods.empty())
    return text(of_methods,
                fmt::format("the method {} does not read {} ('bendlab methods' says what each reads)", method,
                            of_methods.size() == 1 ? "it" : "them")) +
           "/solver/method";
  if (const std::vector<std::string> of_generators = unread_of_generator(input); !of_generators.empty())
    return text(of_generators, fmt::format("the generator {} does not read {}",
                                           input.config.section("/mesh").text("generator"),
                                           of_generators.size() == 1 ? "it" : "them")) +
           "/mesh/generator";
  std::vector<std::string> of_models;
  for (const ConfigSection* section : child_sections("/bending"))
    std::ranges::move(unread(section->pointer, "/bending/model"), std::back_inserter(of_models));
  if (of_models.empty()) return std::nullopt;
  return text(of_models, fmt::format("/bending/model is {}", input.config.bending_model())) +
         "/bending/model";
}

// ---- replaced_setting

// A swept object takes the place of the config's own. Told where another value than the stated one is in
// force.
Message replaced_setting(const WarningInput& input) {
  std::vector<std::string> lost;
  std::string by;
  const auto look = [&](const auto& self, const std::string& pointer, const Json& stated,
                        const Json& value) -> void {
    for (const auto& [key, setting] : stated.items()) {
      const std::string place = child_pointer(pointer, key);
      const auto found = value.find(key);
      const Json* const now = value_at(input.config.resolved(), place);
      if (found == value.end() && now != nullptr && *now != setting)
        lost.push_back(place);
      else if (found != value.end() && setting.is_object() && found->is_object())
        self(self, place, setting, *found);
    }
  };
  for (const auto& [pointer, value] : input.config.point) {
    const Json* const stated = value_at(input.experiment.settings, pointer);
    const std::size_t before = lost.size();
    const bool of_no_model = pointer == "/bending" && input.config.bending_model() == "none";
    if (stated != nullptr && stated->is_object() && value.is_object() && !of_no_model)
      look(look, pointer, *stated, value);
    if (lost.size() > before) by = pointer;
  }
  // A later axis may state it again.
  std::erase_if(lost, [&](const std::string& pointer) {
    return std::ranges::any_of(input.config.point, [&](const auto& axis) {
      return lies_within(pointer, axis.first) && axis.first != by;
    });
  });
  if (lost.empty()) return std::nullopt;
  return fmt::format(
      "the config states {}, and the sweep of {} replaces the whole object. State it in each "
      "swept object, or sweep single settings",
      fmt::join(lost, ", "), by);
}

// ---- units

namespace {

// Under gravity a cloth of length L falls and swings within a time of √(L / g): 0.03 s for 1 cm, 0.8 s for
// 6 m. Clothes and curtains lie between; a mesh in mm or cm that is read in m does not. Gravity weaker than
// the Earth's is a choice, and says nothing about units.
constexpr double shortest_time = 0.03, longest_time = 0.8;  // s
constexpr double weakest_gravity = 9;                       // m/s²

}  // namespace

Message units(const WarningInput& input) {
  const RestMesh& rest = input.scene.rest;
  const double g = gravity_of(input.scene.effects).norm();
  const double extent = (rest.box_max() - rest.box_min()).maxCoeff();
  // kg/m²: gauze has 0.02, a heavy carpet 4.
  constexpr double heaviest = 10;
  if (const double density = input.config.section("/material").number("density"); density > heaviest)
    return fmt::format(
        "a density of {:.3g} kg/m² is more than any cloth has: is it in g/m²? 200 g/m² is 0.2 kg/m²",
        density);
  if (!(g >= weakest_gravity)) return std::nullopt;
  const double time = std::sqrt(extent / g);
  if (time >= shortest_time && time <= longest_time) return std::nullopt;
  return fmt::format(
      "the cloth is {:.3g} m long, {}, under a gravity of {:.3g} m/s²: is the mesh in other units? "
      "/mesh/scale converts them to metres (0.001 for millimetres, 0.01 for centimetres)",
      extent, time > longest_time ? "as much as a theatre's curtain or more" : "less than a fingertip", g);
}

}  // namespace bendlab
