#include "experiments/warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "experiments/energy.hpp"
#include "experiments/pointers.hpp"

namespace bendlab {
namespace {

using Message = std::optional<std::string>;

// ---- unconverged

// Of the mean strain of a membrane that does not stretch, over the last second. Measured on the paper's sheet, on 16 cells and 32:
// see the table in warnings.md of the tests… (filled in below)
constexpr double unconverged_strain = 0.05;

Message unconverged(const WarningInput& input) {
  const StrainStiffness& strain = input.scene.input.strain_stiffness;
  const bool rigid = strain.kind == StiffnessKind::compliance
                         ? strain.compliance == 0
                         : strain.warp == 1 && strain.weft == 1;
  const auto found = input.summary->find("mean_strain");
  if (!rigid || input.scene.input.settings.method != Method::pbd || found == input.summary->end() ||
      !(found->second > unconverged_strain))
    return std::nullopt;
  return fmt::format("mean strain {:.2g} of a membrane that does not stretch: {} substeps × {} iterations leave it "
                     "unconverged. More /solver/substeps with fewer iterations each, and the effect tethers, help",
                     found->second, input.scene.input.settings.substeps,
                     input.scene.input.settings.iterations);
}

// ---- inert_seed

bool gives(const Json& settings, const std::string& pointer) {
  return value_at(settings, pointer) != nullptr;
}

// Whether somebody chose this seed: wrote it down, or swept it or what it is in.
bool is_chosen(const WarningInput& input, const std::string& pointer) {
  if (gives(input.experiment.settings, pointer)) return true;
  for (const auto& [swept, value] : input.config.point) {
    if (swept == pointer) return true;
    if (lies_within(pointer, swept) && gives(value, pointer.substr(swept.size()))) return true;
  }
  return false;
}

Message inert_seed(const WarningInput& input) {
  const ParameterValues initial = input.config.section("/initial"), mesh = input.config.section("/mesh");
  const bool initial_used = initial.number("perturbation") > 0 || initial.number("random") > 0,
             mesh_used = input.config.mesh_file.empty() && mesh.text("generator") == "delaunay";
  std::string inert;
  if (!initial_used && is_chosen(input, "/initial/seed")) inert = "/initial/seed";
  if (!mesh_used && is_chosen(input, "/mesh/seed")) inert = "/mesh/seed";
  if (inert.empty()) return std::nullopt;
  return fmt::format("{} changes nothing here: runs that differ in it alone are equal, and their spread is 0. {}", inert,
                     inert == "/mesh/seed" ? "Only /mesh/generator: delaunay uses it"
                                           : "Give /initial/perturbation a value, 1e-6 for example, or leave it out");
}

// ---- piece_without_pin

Message piece_without_pin(const WarningInput& input) {
  const RestMesh& rest = input.scene.rest;
  if (input.scene.pins.all.empty()) return std::nullopt;
  std::vector<char> held(static_cast<std::size_t>(rest.vertex_count()), 0);
  std::vector<int> stack = input.scene.pins.all;
  for (const int v : stack) held[static_cast<std::size_t>(v)] = 1;
  while (!stack.empty()) {
    const int v = stack.back();
    stack.pop_back();
    for (const int neighbour : rest.one_ring()[v])
      if (char& seen = held[static_cast<std::size_t>(neighbour)]; !seen) seen = 1, stack.push_back(neighbour);
  }
  const auto loose = std::ranges::count(held, 0);
  if (loose == 0) return std::nullopt;
  const auto first = std::ranges::find(held, 0) - held.begin();
  return fmt::format("{} of {} vertices, vertex {} the first, are in pieces of the mesh without a pin, while others have "
                     "some: they fall away. Pin each piece, or unite them ('bendlab mesh' lists pieces)",
                     loose, rest.vertex_count(), first);
}

// ---- units

// Under gravity a length L has a time √(L / g) in which it falls and swings: 0.03 s for 1 cm, 0.8 s for 6 m. Cloth of people
// lies between; a mesh in mm or cm read as m does not.
constexpr double shortest_time = 0.03, longest_time = 0.8;  // s

Message units(const WarningInput& input) {
  const RestMesh& rest = input.scene.rest;
  const double g = gravity_of(input.scene.effects).norm();
  const double extent = (rest.box_max() - rest.box_min()).maxCoeff();
  if (!(g > 0)) return std::nullopt;
  const double time = std::sqrt(extent / g);
  if (time >= shortest_time && time <= longest_time) return std::nullopt;
  return fmt::format("the cloth is {:.3g} m long, {} under a gravity of {:.3g} m/s²: is the mesh in other units? "
                     "/mesh/scale makes metres of them (0.001 of millimetres, 0.01 of centimetres)",
                     extent, time > longest_time ? "a hall's curtain or more" : "less than a fingertip", g);
}

constexpr std::array kinds = {
    WarningKind{"inert_seed", "a seed is set or swept that nothing uses", true, inert_seed},
    WarningKind{"piece_without_pin", "a piece of the mesh has no pin while others have some", true,
                piece_without_pin},
    WarningKind{"units", "the extent of the mesh, under gravity, looks like other units", true, units},
    WarningKind{"unconverged", "iterations leave a membrane stretched that does not stretch", false,
                unconverged},
};

}  // namespace

std::span<const WarningKind> warning_kinds() {
  return kinds;
}

std::vector<Warning> warnings_of(const WarningInput& input) {
  std::vector<Warning> warnings;
  for (const WarningKind& kind : kinds) {
    if (!kind.before && input.summary == nullptr) continue;
    if (Message message = kind.message(input))
      warnings.push_back({std::string(kind.code), *std::move(message)});
  }
  return warnings;
}

std::vector<Warning> warnings_before(const Experiment& experiment, const RunConfig& config) try {
  RunConfig bare = config;
  bare.resolved["bending"] = {{"model", "none"}, {"stiffness", "k"}, {"k", 0.0}, {"compliance", 0.0}};
  const Scene scene = build_scene(bare);
  return warnings_of(WarningInput{experiment, config, scene});
} catch (const std::exception&) {
  return {};
}

std::string text_of_what_warns_before(const RunConfig& config) {
  Json settings = config.resolved;
  for (const char* unused : {"output", "accuracy", "quality"}) settings.erase(unused);
  for (const char* seeded : {"initial", "mesh"}) settings[seeded].erase("seed");
  return settings.dump();
}

Json to_json(const std::vector<Warning>& warnings) {
  Json json = Json::array();
  for (const Warning& warning : warnings)
    json.push_back({{"code", warning.code}, {"message", warning.message}});
  return json;
}

std::vector<Warning> warnings_of(const Json& json) {
  std::vector<Warning> warnings;
  if (!json.is_array()) return warnings;
  for (const Json& each : json)
    if (each.is_object() && each.contains("code") && each.contains("message") && each["code"].is_string() &&
        each["message"].is_string())
      warnings.push_back({each["code"], each["message"]});
  return warnings;
}

}  // namespace bendlab
