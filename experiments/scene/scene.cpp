#include "experiments/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bendlab/bending/calibration.hpp"
#include "bendlab/bending/push_bound.hpp"
#include "bendlab/constraints/build.hpp"
#include "bendlab/effects/effect.hpp"
#include "bendlab/io/run_file.hpp"
#include "bendlab/mesh/delaunay.hpp"
#include "bendlab/mesh/files.hpp"
#include "bendlab/mesh/flaws.hpp"
#include "bendlab/mesh/generators.hpp"
#include "bendlab/mesh/numbering.hpp"
#include "bendlab/mesh/refined.hpp"
#include "bendlab/parameters/names.hpp"
#include "bendlab/solver/method.hpp"
#include "bendlab/solver/order_from_pins.hpp"
#include "experiments/scene/gravity.hpp"
#include "experiments/scene/initial_pose.hpp"
#include "experiments/scene/membrane.hpp"

namespace bendlab {
namespace {

// As many as make the cells of a grid squares; more than a mesh may have are as many as an int holds.
int rows_of_squares(double width, double height, int cells) {
  constexpr double most = std::numeric_limits<int>::max();
  return static_cast<int>(std::clamp(std::round(cells * height / width), 1.0, most));
}

TriangleMesh generate(const ParameterValues& mesh) {
  const double width = mesh.number("width"), height = mesh.number("height");
  const int cells = static_cast<int>(mesh.integer("cells"));
  const double radius = mesh.number("radius");
  switch (named<Generator>(mesh.text("generator"), generator_names)) {
    case Generator::grid:
      return grid(width, height, cells, rows_of_squares(width, height, cells),
                  named<Diagonal>(mesh.text("diagonal"), diagonal_names));
    case Generator::equilateral:
      return equilateral(width, height, cells, named<Rows>(mesh.text("rows"), rows_names));
    case Generator::delaunay:
      return delaunay(width, height, cells, static_cast<std::uint64_t>(mesh.integer("seed")));
    case Generator::disc:
      return disc(radius, cells);
    case Generator::tube:
      return tube(radius, mesh.has("radius_top") ? mesh.number("radius_top") : radius, height, cells);
    case Generator::sphere:
      return sphere(radius, cells);
  }
  throw std::logic_error("generate: unknown generator");
}

// A cone whose tip is far smaller than its base, for example, has triangles that count as having no area.
void require_areas(const TriangleMesh& mesh) {
  const std::vector<char> without = triangles_without_area(mesh);
  if (const auto count = std::ranges::count_if(without, [](char each) { return each != 0; }); count > 0)
    throw std::invalid_argument(fmt::format(
        "with these lengths {} of {} triangles have no area (they are thinner than {:.0e} of the mesh); "
        "choose lengths that differ less",
        count, without.size(), zero_area_thickness));
}

// A generated mesh is sound unless /mesh/flaw puts a defect into it.
AcceptedMesh generated_mesh(const ParameterValues& mesh, BadTriangles policy) {
  TriangleMesh generated;
  try {
    generated = generate(mesh);
    if (mesh.has("shuffle"))
      generated = shuffled(generated, static_cast<std::uint64_t>(mesh.integer("shuffle")));
    require_areas(generated);
  } catch (const std::invalid_argument& error) {  // settings that are fine one by one but not together
    throw ConfigError("mesh generator", {{"/mesh", error.what()}});
  }
  const std::string& flaw = mesh.text("flaw");
  if (flaw == "none") return {.mesh = std::move(generated)};
  try {
    return accept(to_soup(with_flaw(std::move(generated), flaw)), policy);
  } catch (const std::invalid_argument& error) {
    throw MeshError(fmt::format("mesh with the flaw {}: {}", flaw, error.what()));
  }
}

[[noreturn]] void rethrow(const MeshFileError& error) {
  if (error.kind() == MeshFileError::Kind::refused) throw MeshError(error.what());
  throw RunFileError(error.what());
}

BadTriangles policy_for_bad_triangles(const ParameterValues& mesh) {
  return named<BadTriangles>(mesh.text("bad_triangles"), bad_triangles_names);
}

AcceptedMesh mesh_from_file(const std::filesystem::path& file, BadTriangles policy) {
  try {
    return read_mesh(file, policy);
  } catch (const MeshFileError& error) {
    rethrow(error);
  }
}

// Names take z for up in a sheet that stands; in a plane x = const gravity may say that it is y.
void require_up(const RestMesh& rest, const std::vector<std::string>& names, const Vector3& down) {
  const NamedAxes axes = named_axes(rest);
  if (names.empty() || axes.front != 0 || std::abs(down.z()) >= std::abs(down.y())) return;
  throw ConfigError(
      "/pins/vertices",
      {{"/pins/vertices",
        fmt::format("'{}' is not known of this sheet: it stands in a plane x = const, where names take z for "
                    "up, but gravity pulls along y. Turn the mesh so that it lies in the x-y plane or that z "
                    "is up, or pin by /pins/indices, with \"vertices\": []",
                    names.front())}});
}

// The mesh refined and jittered, as far as the config asks for it.
TriangleMesh altered(TriangleMesh mesh, const ParameterValues& values) {
  const char* setting = "/mesh/refine";
  try {
    if (values.has("refine")) mesh = refined(mesh, static_cast<int>(values.integer("refine")));
    setting = "/mesh/jitter";
    if (values.has("jitter"))
      mesh = jittered(mesh, values.number("jitter"), static_cast<std::uint64_t>(values.integer("seed")));
  } catch (const std::invalid_argument& error) {
    throw ConfigError(setting, {{setting, error.what()}});
  }
  return mesh;
}

Pins pins_of(const RunConfig& config, const RestMesh& rest, const std::vector<std::string>& mesh_notes,
             bool renumbered, const Vector3& down) {
  const ParameterValues values = config.section("/pins");
  require_up(rest, values.texts("vertices"), down);
  if (renumbered && !values.numbers("indices").empty())
    throw MeshError(fmt::format(
        "{}: {}; /pins/indices would then mean other vertices than in the original mesh. Repair the file "
        "itself, or pin by name with /pins/vertices",
        config.mesh_file().empty() ? "mesh" : config.mesh_file().string(), fmt::join(mesh_notes, "; ")));
  std::vector<int> seeds;
  for (const std::string& name : values.texts("vertices")) try {
      for (const int vertex : select_vertices(rest, name)) seeds.push_back(vertex);
    } catch (const std::invalid_argument& error) {  // a name that this mesh has no place for
      throw ConfigError("/pins/vertices", {{"/pins/vertices", error.what()}});
    }
  for (const double index : values.numbers("indices")) {
    if (index >= rest.vertex_count())
      throw ConfigError("/pins/indices",
                        {{"/pins/indices", fmt::format("vertex {} is not in the mesh, which has vertices "
                                                       "0 to {}",
                                                       index, rest.vertex_count() - 1)}});
    seeds.push_back(static_cast<int>(index));
  }
  return make_pins(rest, std::move(seeds), static_cast<int>(values.integer("ring")),
                   values.number("distance"));
}

// Areas and their inverses have to stay within single precision. An offset rounds coordinates, by less than
// the height of a triangle that counts as one without area.
void require_numbers_hold(const TriangleMesh& mesh, bool has_offset) {
  constexpr double smallest = 1e-18, largest = 1e18, epsilon = std::numeric_limits<double>::epsilon();
  const double size = (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).norm(),
               farthest = mesh.positions.cwiseAbs().maxCoeff();
  if (!(size >= smallest && size <= largest))
    throw MeshError(
        fmt::format("mesh: can't be simulated: it is {:.3g} m large, and the numbers of a simulation hold "
                    "sizes from {} to {} m; check its extent and /mesh/scale",
                    size, smallest, largest));
  if (has_offset && !(farthest * epsilon <= zero_area_thickness * size))
    throw MeshError(
        fmt::format("mesh: can't be simulated: {:.3g} m from the origin coordinates are rounded to {:.2g} m, "
                    "too coarse for a mesh of {:.3g} m; choose a smaller /mesh/offset",
                    farthest, farthest * epsilon, size));
}

StiffnessKind stiffness_kind(const std::string& name) {
  return named<StiffnessKind>(name, stiffness_kind_names);
}

StrainStiffness strain_stiffness(const ParameterValues& values) {
  const bool physical = values.text("stiffness") == "physical";
  return {.form = named<StrainForm>(values.text("form"), strain_form_names),
          .kind = physical ? StiffnessKind::compliance : stiffness_kind(values.text("stiffness")),
          .warp = values.number("warp"),
          .weft = values.number("weft"),
          .shear = values.number("shear"),
          .area = values.number("area"),
          .compliance = physical ? 1 / values.number("membrane_stiffness") : values.number("compliance")};
}

// A physical stiffness is in each constraint's own softness, at a compliance of 1.
BendingStiffness bending_stiffness(const ParameterValues& values) {
  if (values.text("stiffness") == "physical")
    return {.kind = StiffnessKind::compliance, .k = values.number("k"), .compliance = 1};
  return {.kind = stiffness_kind(values.text("stiffness")),
          .k = values.number("k"),
          .compliance = values.number("compliance")};
}

// The model's constraints, calibrated if the config states a physical stiffness.
BendingConstraints bending_constraints(const RunConfig& config, const RestMesh& rest, const Pins& pins) {
  const ParameterValues parameters = config.bending_parameters(), values = config.section("/bending");
  BendingConstraints constraints =
      find_bending_model(config.bending_model())->build({rest, pins, parameters});
  if (values.text("stiffness") != "physical") {
    const bool by_k = stiffness_kind(values.text("stiffness")) != StiffnessKind::compliance;
    if (const auto why = unknown_to_k(*find_bending_model(config.bending_model()), constraints); by_k && why)
      throw ConfigError("bending stiffness", {{"/bending/stiffness", *why}});
    return constraints;
  }
  const auto given = [&](std::string_view name) {
    return values.has(name) ? std::optional(values.number(name)) : std::nullopt;
  };
  try {
    calibrate(constraints, rest, pins,
              {given("flexural_rigidity"), given("quartic_coefficient"), given("at_curvature"),
               values.has("deflection") ? named<Deflection>(values.text("deflection"), deflection_names)
                                        : Deflection::large});
  } catch (const std::invalid_argument& error) {  // a target that does not suit this mesh or this model
    throw ConfigError("physical stiffness", {{"/bending/stiffness", error.what()}});
  }
  return constraints;
}

SolverSettings solver_settings(const ParameterValues& values, const Method& method) {
  // A default is for the methods that read it.
  const auto count = [&](std::string_view name) {
    return method.reads(name) ? static_cast<int>(values.integer(name)) : 1;
  };
  SolverSettings settings{.dt = values.number("dt"),
                          .substeps = count("substeps"),
                          .iterations = count("iterations"),
                          .sweep = named<Sweep>(values.text("sweep"), sweep_names),
                          .order = named<ConstraintOrder>(values.text("order"), constraint_order_names),
                          .first = named<FirstConstraint>(values.text("first"), first_constraint_names),
                          .threads = static_cast<int>(values.integer("threads"))};
  for (const Parameter& row : method.parameters) settings.own.set(row.name, values.value(row.name));
  return settings;
}

// Lumped masses; beyond the middle along x the cloth is `density_ratio` times as heavy.
std::vector<double> masses_of(const ParameterValues& material, const RestMesh& rest) {
  const double density = material.number("density"), ratio = material.number("density_ratio");
  std::vector<double> mass = lumped_masses(rest, density);
  for (int t = 0; ratio != 1 && t < rest.triangle_count(); ++t) {
    const auto corner = rest.triangles().row(t);
    const double x = (rest.position(corner(0)) + rest.position(corner(1)) + rest.position(corner(2))).x() / 3;
    if (x <= rest.centre().x()) continue;
    for (const int v : corner)
      mass[static_cast<std::size_t>(v)] +=
          (ratio - 1) * density * rest.areas()[static_cast<std::size_t>(t)] / 3;
  }
  return mass;
}

std::vector<InverseRest> material_coordinates(const ParameterValues& material, const TriangleMesh& mesh,
                                              const std::vector<std::string>& mesh_notes) {
  if (named<MaterialCoordinates>(material.text("coordinates"), material_coordinates_names) ==
      MaterialCoordinates::warp) {
    const std::vector<double>& warp = material.numbers("warp_direction");
    return inverse_rest_from_warp(mesh, {warp[0], warp[1], warp[2]});
  }
  try {
    return inverse_rest_from_texture(mesh);
  } catch (const std::invalid_argument& error) {
    throw MeshError(fmt::format("/material/coordinates: {}{}", error.what(),
                                mesh_notes.empty() ? "" : fmt::format(" ({})", fmt::join(mesh_notes, "; "))));
  }
}

int count_beyond_ring_1(const RestMesh& rest, const DistanceConstraints& springs) {
  return static_cast<int>(
      std::count_if(springs.vertices.begin(), springs.vertices.end(), [&](const auto& pair) {
        const auto ring = rest.one_ring()[pair[0]];
        return !std::binary_search(ring.begin(), ring.end(), pair[1]);
      }));
}

QualityThresholds quality_thresholds(const ParameterValues& values) {
  return {.needle_ratio = values.number("needle_ratio"),
          .cap_angle = values.number("cap_angle"),
          .small_angle = values.number("small_angle")};
}

// The compiled passes of the effect at `index`, under its name. Throws ConfigError for settings that do not
// go together, or not with this mesh.
template <class Real>
std::vector<Pass<Real>> passes_of(const Scene& scene, std::size_t index) {
  const EffectSettings& settings = scene.effects[index];
  const Effect& effect = *find_effect(settings.type);
  if (!scene.input.method->takes_effect(effect.name, effect.needs_projection)) return {};
  if (effect.helps_projection && membrane_needs_no_tethers(scene)) return {};
  const bool contacts_used =  // implicit steps tell obstacles from layers of cloth by them
      !scene.input.method->projects || std::ranges::any_of(scene.effects, [](const EffectSettings& each) {
        return find_effect(each.type)->uses_contacts;
      });
  std::vector<Pass<Real>> passes;
  try {
    passes = effect.compile<Real>(
        {settings.values, scene.rest, scene.pins, scene.input.permutation, contacts_used});
  } catch (const MeshFileError& error) {
    rethrow(error);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(settings.type, {{fmt::format("/effects/{}", index), error.what()}});
  }
  const std::string name = pass_name(scene.effects, index);
  for (Pass<Real>& pass : passes) pass.name = name + pass.name.substr(settings.type.size());
  return passes;
}

Precision precision_of(const Scene& scene, const std::string& asked) {
  if (scene.input.method->make_float == nullptr) return Precision::double_precision;
  if (asked != "auto") return named<Precision>(asked, precision_names);
  return single_suffices(scene) ? Precision::single_precision : Precision::double_precision;
}

template <class Real>
std::unique_ptr<Simulation> simulation_in(const Scene& scene) {
  std::vector<Pass<Real>> passes;
  for (const bool first : {true, false})
    for (std::size_t index = 0; index < scene.effects.size(); ++index)
      if (find_effect(scene.effects[index].type)->acts_first == first)
        for (Pass<Real>& pass : passes_of<Real>(scene, index)) passes.push_back(std::move(pass));
  try {
    return make_simulation<Real>(scene.input, std::move(passes));
  } catch (const std::invalid_argument& error) {  // a method that does not suit this scene
    throw ConfigError("solver method", {{"/solver/method", error.what()}});
  }
}

}  // namespace

AcceptedMesh rest_mesh_of(const RunConfig& config) {
  const ParameterValues values = config.section("/mesh");
  const BadTriangles policy = policy_for_bad_triangles(values);
  AcceptedMesh accepted = config.mesh_file().empty() ? generated_mesh(values, policy)
                                                     : mesh_from_file(config.mesh_file(), policy);
  accepted.mesh = altered(std::move(accepted.mesh), values);
  const Eigen::RowVector3d offset(values.numbers("offset").data());
  accepted.mesh.positions *= values.number("scale");
  accepted.mesh.positions.rowwise() += offset;
  require_numbers_hold(accepted.mesh, !offset.isZero(0));
  return accepted;
}

Scene build_scene(const RunConfig& config) {
  AcceptedMesh accepted = rest_mesh_of(config);
  Scene scene{.rest = RestMesh(std::move(accepted.mesh)), .mesh_notes = std::move(accepted.notes)};
  const RestMesh& rest = scene.rest;
  const ParameterValues material = config.section("/material"), solver = config.section("/solver");
  scene.effects = config.effects();
  scene.down = direction_of_gravity(scene.effects);
  scene.pins = pins_of(config, rest, scene.mesh_notes, accepted.renumbered, scene.down);
  scene.thresholds = quality_thresholds(config.section("/quality"));

  SimulationInput& input = scene.input;
  input.positions = initial_positions(config.section("/initial"), rest, scene.pins);
  input.velocities = initial_velocities(config.section("/initial"), input.positions, rest.centre());
  input.rest = rest.positions();
  input.origin = rest.centre();
  input.size = rest.size();
  input.mass = masses_of(material, rest);
  input.is_pinned = scene.pins.is_pinned;
  input.method = find_method(solver.text("method"));
  if (!input.method->mesh_order) input.permutation = local_numbering(rest);
  input.settings = solver_settings(solver, *input.method);
  if (input.method->membrane == Membrane::edges)
    input.edges = edge_springs(rest, scene.pins);
  else
    input.strain =
        strain_constraints(rest, scene.pins, material_coordinates(material, rest.mesh(), scene.mesh_notes),
                           policy_for_bad_triangles(config.section("/mesh")) == BadTriangles::membrane_off
                               ? dispensable_triangles(rest)
                               : std::vector<char>{});
  input.strain_stiffness = strain_stiffness(config.section("/material/strain"));

  input.bending_stiffness = bending_stiffness(config.section("/bending"));
  BendingConstraints bending = bending_constraints(config, rest, scene.pins);
  const SolverSettings& settings = input.settings;
  if (input.method->projects && find_bending_model(config.bending_model())->prestressed &&
      config.section("/bending").text("stiffness") == "physical") {
    scene.push = bound_push(bending.distance, rest, input.mass, settings.dt / settings.substeps,
                            settings.projections_per_substep());
    if (scene.push) std::ranges::move(facts_of(*scene.push), std::back_inserter(bending.facts));
  }
  if (input.bending_stiffness.kind == StiffnessKind::compliance && input.bending_stiffness.compliance > 0 &&
      find_bending_model(config.bending_model())->prestressed)
    input.push_tension = push_tension(bending.distance, rest, input.bending_stiffness.compliance);
  scene.springs_beyond_ring_1 = count_beyond_ring_1(rest, bending.distance);
  scene.bending_facts = std::move(bending.facts);
  input.distance = std::move(bending.distance);
  input.elements = std::move(bending.elements);
  if (settings.order == ConstraintOrder::pins) order_from_pins(input, rest);
  input.moves_apart = !rounding_speed(scene).whole_suffices();
  scene.precision = precision_of(scene, solver.text("precision"));
  return scene;
}

std::string pass_name(const std::vector<EffectSettings>& effects, std::size_t index) {
  const auto same = [&](const EffectSettings& each) { return each.type == effects[index].type; };
  if (std::ranges::count_if(effects, same) == 1) return effects[index].type;
  const auto before = effects.begin() + static_cast<std::ptrdiff_t>(index);
  return fmt::format("{} {}", effects[index].type, 1 + std::count_if(effects.begin(), before, same));
}

std::vector<std::size_t> idle_effects(const Scene& scene) {
  std::vector<std::size_t> idle;
  for (std::size_t index = 0; index < scene.effects.size(); ++index) {
    const EffectSettings& settings = scene.effects[index];
    const Effect& effect = *find_effect(settings.type);
    if ((effect.idle && effect.idle(settings.values)) || passes_of<double>(scene, index).empty())
      idle.push_back(index);
  }
  return idle;
}

bool moves_vertices(const Scene& scene) {
  for (std::size_t index = 0; index < scene.effects.size(); ++index)
    for (const Pass<float>& pass : passes_of<float>(scene, index))
      if (pass.stage != Stage::force && pass.stage != Stage::damp) return true;
  return false;
}

std::unique_ptr<Simulation> simulation_of(const Scene& scene) {
  return scene.precision == Precision::double_precision ? simulation_in<double>(scene)
                                                        : simulation_in<float>(scene);
}

}  // namespace bendlab
