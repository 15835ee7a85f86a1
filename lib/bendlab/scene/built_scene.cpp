#include "bendlab/scene/built_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bendlab/bending/calibration.hpp"
#include "bendlab/bending/moment_laws.hpp"
#include "bendlab/bending/push_bound.hpp"
#include "bendlab/constraints/build.hpp"
#include "bendlab/effects/effect.hpp"
#include "bendlab/mesh/delaunay.hpp"
#include "bendlab/mesh/files.hpp"
#include "bendlab/mesh/flaws.hpp"
#include "bendlab/mesh/generators.hpp"
#include "bendlab/mesh/numbering.hpp"
#include "bendlab/mesh/refined.hpp"
#include "bendlab/scene/gravity.hpp"
#include "bendlab/scene/initial_pose.hpp"
#include "bendlab/scene/maps.hpp"
#include "bendlab/scene/membrane.hpp"
#include "bendlab/scene/pins_of.hpp"
#include "bendlab/scene/rules.hpp"
#include "bendlab/settings/names.hpp"
#include "bendlab/solver/method.hpp"

namespace bendlab {
namespace {

// The number of rows that makes the cells of a grid as square as possible. A number too large for an int
// becomes the largest int; the generator refuses so many rows anyway.
int rows_of_squares(double width, double height, int cells) {
  constexpr double most = std::numeric_limits<int>::max();
  return static_cast<int>(std::clamp(std::round(cells * height / width), 1.0, most));
}

// Whether /mesh/aspect stretches a generator's mesh.
bool stretches(Generator generator) {
  return generator == Generator::grid || generator == Generator::equilateral ||
         generator == Generator::delaunay;
}

TriangleMesh generate(const Mesh& stated) {
  Mesh mesh = stated;
  if (stretches(mesh.generator)) mesh.height /= mesh.aspect;  // generated_mesh() stretches the mesh
  switch (mesh.generator) {
    case Generator::grid:
      return grid(mesh.width, mesh.height, mesh.cells, rows_of_squares(mesh.width, mesh.height, mesh.cells),
                  mesh.diagonal);
    case Generator::equilateral:
      return equilateral(mesh.width, mesh.height, mesh.cells, mesh.rows.value_or(Rows::parallel));
    case Generator::delaunay:
      return delaunay(mesh.width, mesh.height, mesh.cells, mesh.seed);
    case Generator::disc:
      return disc(mesh.radius, mesh.cells);
    case Generator::tube:
      return tube(mesh.radius, mesh.radius_top.value_or(mesh.radius), stated.height, mesh.cells);
    case Generator::sphere:
      return sphere(mesh.radius, mesh.cells);
  }
  throw std::logic_error("generate: unknown generator");
}

// Refuses triangles of zero area, for example in a cone whose tip is much narrower than its base.
void require_areas(const TriangleMesh& mesh) {
  const std::vector<char> without = triangles_without_area(mesh);
  if (const auto count = std::ranges::count_if(without, [](char no_area) { return no_area != 0; }); count > 0)
    throw std::invalid_argument(fmt::format(
        "with these lengths {} of {} triangles have no area (their height is less than {:.0e} of the mesh's "
        "size); choose lengths that differ less",
        count, without.size(), zero_area_thickness));
}

// A generated mesh only has problems if /mesh/flaw puts a defect into the mesh.
AcceptedMesh generated_mesh(const Mesh& mesh) {
  TriangleMesh generated;
  try {
    generated = generate(mesh);
    if (stretches(mesh.generator)) generated.positions.col(1) *= mesh.aspect;
    if (mesh.shuffle) generated = shuffled(generated, *mesh.shuffle);
    require_areas(generated);
  } catch (const std::invalid_argument& error) {  // settings that are valid, but do not fit together
    throw ConfigError("mesh generator", {{"/mesh", error.what()}});
  }
  if (mesh.flaw == "none") return {.mesh = std::move(generated)};
  try {
    return accept(to_soup(with_flaw(std::move(generated), mesh.flaw)), mesh.bad_triangles);
  } catch (const std::invalid_argument& error) {
    throw MeshError(fmt::format("mesh with the flaw {}: {}", mesh.flaw, error.what()));
  }
}

AcceptedMesh mesh_from_file(const std::filesystem::path& file, BadTriangles policy) {
  try {
    return read_mesh(file, policy);
  } catch (const MeshFileError& error) {
    if (error.kind() == MeshFileError::Kind::refused) throw MeshError(error.what());
    throw;
  }
}

AcceptedMesh mesh_of_program(const TriangleMesh& given, BadTriangles policy) {
  try {
    return accept(to_soup(given), policy);
  } catch (const std::invalid_argument& error) {
    throw MeshError(std::string("the mesh that was given ") + error.what());
  }
}

// The mesh after /mesh/refine and /mesh/jitter.
TriangleMesh altered(TriangleMesh mesh, const Mesh& settings) {
  const char* setting = "/mesh/refine";
  try {
    if (settings.refine) mesh = refined(mesh, *settings.refine);
    setting = "/mesh/jitter";
    if (settings.jitter) mesh = jittered(mesh, *settings.jitter, settings.seed);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(setting, {{setting, error.what()}});
  }
  return mesh;
}

// Refuses sizes at which areas or their inverses exceed the range of single precision, and offsets that round
// coordinates by more than the height of a triangle of zero area.
void require_numbers_hold(const TriangleMesh& mesh, bool has_offset) {
  constexpr double smallest = 1e-18, largest = 1e18, epsilon = std::numeric_limits<double>::epsilon();
  const double size = (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).norm(),
               farthest = mesh.positions.cwiseAbs().maxCoeff();
  if (!(size >= smallest && size <= largest))
    throw MeshError(
        fmt::format("mesh: can't be simulated: the size is {:.3g} m, but sizes from {} to {} m are allowed; "
                    "check the extent of the mesh and /mesh/scale",
                    size, smallest, largest));
  if (has_offset && !(farthest * epsilon <= zero_area_thickness * size))
    throw MeshError(
        fmt::format("mesh: can't be simulated: at {:.3g} m from the origin, coordinates are rounded to "
                    "{:.2g} m, which is too inexact for a mesh of {:.3g} m; choose a smaller /mesh/offset",
                    farthest, farthest * epsilon, size));
}

// A physical stiffness is simulated by compliances: one for all triangles, and one for each bending
// constraint.
StiffnessKind kind_of(Stiffness stiffness) {
  return stiffness == Stiffness::physical ? StiffnessKind::compliance : static_cast<StiffnessKind>(stiffness);
}

// Of warp, weft and shear, relative to 1 / membrane_stiffness.
std::array<double, 3> membrane_softness(const Strain& strain) {
  const DirectedMembrane& membrane = strain.membrane;
  if (strain.stiffness != Stiffness::physical || !membrane.is_given()) return {1, 1, 1};
  const double warp = membrane.warp.value(), weft = membrane.weft.value(),
               shear = membrane.shear.value_or(std::sqrt(warp * weft));
  return {strain.membrane_stiffness / warp, strain.membrane_stiffness / weft,
          strain.membrane_stiffness / shear};
}

StrainStiffness strain_stiffness(const Strain& strain, double poisson_ratio) {
  const StrainForm form = strain.form.value_or(StrainForm::angle);
  const double compliance =
      strain.stiffness == Stiffness::physical ? 1 / strain.membrane_stiffness : strain.compliance;
  if (form == StrainForm::stvk)
    return {.form = form,
            .kind = StiffnessKind::compliance,
            .area = poisson_ratio / (1 - poisson_ratio),
            .compliance = (1 + poisson_ratio) * compliance};
  return {.form = form,
          .kind = kind_of(strain.stiffness),
          .warp = strain.warp,
          .weft = strain.weft,
          .shear = strain.shear,
          .area = strain.area,
          .compliance = compliance,
          .softness = membrane_softness(strain)};
}

// A physical stiffness is stored in the softness of each constraint, so the common compliance is 1.
BendingStiffness bending_stiffness(const Bending& bending) {
  return {.kind = kind_of(bending.stiffness),
          .k = bending.k,
          .compliance = bending.stiffness == Stiffness::physical ? 1 : bending.compliance};
}

MomentTarget moment_target(const Bending& bending) {
  MomentTarget target{.rigidity = bending.flexural_rigidity.value_or(0)};
  const Softening& softening = bending.softening;
  target.softening = {softening.half_at.value_or(0), softening.curvatures, softening.moments};
  for (double& moment : target.softening.moments) moment /= target.rigidity;
  if (const BendingFriction& friction = bending.hysteresis; friction.hb)
    target.hysteresis =
        Hysteresis{*friction.hb, friction.slip.value_or(0.2 * *friction.hb / target.rigidity)};
  if (const BendingPlasticity& plasticity = bending.plasticity; plasticity.yield_at)
    target.plasticity = Plasticity{*plasticity.yield_at, plasticity.hardening};
  return target;
}

// Factors by place: #T each, or none.
struct BendingFactors {
  std::vector<double> rigidity, friction, yield;
};

// The model's constraints, calibrated if the stiffness is physical.
BendingConstraints bending_constraints(const Bending& bending, double poisson_ratio, const RestMesh& rest,
                                       const Pins& pins, const std::vector<InverseRest>& coordinates,
                                       const BendingFactors& factors) {
  BendingInput input{rest, pins};
  std::optional<DirectedSheet> directed;
  if (bending.rigidity.is_given() && bending.stiffness == Stiffness::physical) {
    directed =
        DirectedSheet{orthotropic_rigidity(bending.rigidity.warp.value(), bending.rigidity.weft.value(),
                                           bending.rigidity.bias, poisson_ratio),
                      warp_axes(rest.mesh(), coordinates)};
    input.directed = &*directed;
  }
  input.poisson_ratio = poisson_ratio, input.is_flat = bending.rest_curvature == RestCurvature::flat;
  BendingConstraints constraints;
  try {
    constraints = constraints_of(bending.model, input);
  } catch (const std::invalid_argument& error) {
    throw ConfigError("bending model", {{"/bending/model", error.what()}});
  }
  if (bending.stiffness != Stiffness::physical) {
    const bool by_k = bending.stiffness != Stiffness::compliance;
    if (const auto why = unknown_to_k(bending.model.kind(), constraints); by_k && why)
      throw ConfigError("bending stiffness", {{"/bending/stiffness", *why}});
    return constraints;
  }
  const BendingKind& model = bending.model.kind();
  const bool at_curvature = model.springs_only && !model.prestressed;
  try {
    calibrate(
        constraints, rest, pins,
        {bending.flexural_rigidity, bending.quartic_coefficient,
         at_curvature ? bending.at_curvature : std::nullopt,
         model.springs_only ? Deflection::large : bending.deflection, input.directed, factors.rigidity});
  } catch (const std::invalid_argument& error) {  // a target that does not suit this mesh or this model
    throw ConfigError("physical stiffness", {{"/bending/stiffness", error.what()}});
  }
  try {
    MomentTarget target = moment_target(bending);
    target.rigidity_factor = factors.rigidity, target.friction_factor = factors.friction;
    target.yield_factor = factors.yield;
    set_moments(constraints, input, target);
  } catch (const std::invalid_argument& error) {
    throw ConfigError("moments", {{"/bending/model", error.what()}});
  }
  return constraints;
}

void check_own_elements(const SimulationInput& input, const BendingKind& model) {
  if (input.own.size() == 0 || input.method.kind().takes_own_elements) return;
  std::vector<std::string_view> able;
  for (const MethodKind* method : methods())
    if (method->takes_own_elements && !(model.needs_energy && method->needs_compliance.empty()))
      able.push_back(method->name);
  throw ConfigError("solver method",
                    {{"/solver/method",
                      fmt::format("'{}' cannot simulate the bending elements of '{}', which have no kernel: "
                                  "choose one of the methods {}",
                                  input.method.name(), input.own.function->name(), fmt::join(able, ", "))}});
}

void check_held(const SimulationInput& input) {
  if (input.held.empty() || input.method.kind().holds_axes) return;
  std::vector<std::string_view> able;
  for (const MethodKind* method : methods())
    if (method->holds_axes) able.push_back(method->name);
  throw ConfigError("solver method",
                    {{"/solver/method", fmt::format("'{}' cannot hold vertices along an axis (/pins/hold_x, "
                                                    "hold_y, hold_z): choose one of the methods {}",
                                                    input.method.name(), fmt::join(able, ", "))}});
}

// Lumped masses. The half of the cloth with the larger x is `density_ratio` times as heavy.
std::vector<double> masses_of(const Material& material, const RestMesh& rest,
                              const std::vector<double>& factor) {
  const double density = material.density, ratio = material.density_ratio;
  std::vector<double> mass = lumped_masses(rest, density, factor);
  for (int t = 0; ratio != 1 && t < rest.triangle_count(); ++t) {
    const auto corner = rest.triangles().row(t);
    const double x = (rest.position(corner(0)) + rest.position(corner(1)) + rest.position(corner(2))).x() / 3;
    if (x <= rest.centre().x()) continue;
    for (const int v : corner)
      mass[static_cast<std::size_t>(v)] += (ratio - 1) * density *
                                           (factor.empty() ? 1 : factor[static_cast<std::size_t>(t)]) *
                                           rest.areas()[static_cast<std::size_t>(t)] / 3;
  }
  return mass;
}

// Throws if the stiffness depends on the direction, but the warp is perpendicular to all triangles.
void expect_warp_in_sheet(const Scene& scene, const RestMesh& rest) {
  const Vector3& warp = scene.material.warp_direction;
  if (scene.material.coordinates != MaterialCoordinates::warp ||
      !(scene.bending.rigidity.is_given() || scene.material.strain.membrane.is_given()))
    return;
  constexpr double perpendicular = 1e-3;  // sine of an angle
  for (const auto& corner : rest.triangles().rowwise()) {
    const Vector3 a = rest.position(corner(0)),
                  normal = (rest.position(corner(1)) - a).cross(rest.position(corner(2)) - a);
    if (normal.cross(warp).norm() > perpendicular * normal.norm() * warp.norm()) return;
  }
  throw ConfigError(
      "/material/warp_direction",
      {{"/material/warp_direction",
        "is perpendicular to the sheet, so it is no direction of the warp: state a direction in "
        "the sheet"}});
}

std::vector<InverseRest> material_coordinates(const Material& material, const TriangleMesh& mesh,
                                              const std::vector<std::string>& mesh_notes) {
  if (material.coordinates == MaterialCoordinates::warp)
    return inverse_rest_from_warp(mesh, material.warp_direction);
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

// The passes of the effect at `index`, named after the effect. Throws ConfigError for unsuitable settings.
template <class Real>
std::vector<Pass<Real>> passes_at(const BuiltScene& scene, std::size_t index) {
  const Effect& effect = scene.effects[index];
  const EffectKind& kind = effect.kind();
  const MethodKind& method = scene.input.method.kind();
  if (!method.takes_effect(kind.needs_projection, kind.acts_in_iterations)) return {};
  if (kind.helps_projection && membrane_needs_no_tethers(scene)) return {};
  const bool contacts_used =  // implicit steps need contacts to distinguish obstacles from layers of cloth
      !method.projects ||
      std::ranges::any_of(scene.effects, [](const Effect& listed) { return listed.kind().uses_contacts; });
  std::vector<Pass<Real>> passes;
  try {
    passes = passes_of<Real>(effect,
                             {scene.rest, scene.pins, scene.input.permutation, contacts_used, scene.folder});
  } catch (const MeshFileError& error) {
    if (error.kind() == MeshFileError::Kind::refused) throw MeshError(error.what());
    throw;
  } catch (const std::invalid_argument& error) {
    throw ConfigError(kind.name, {{fmt::format("/effects/{}", index), error.what()}});
  }
  const std::string name = pass_name(scene.effects, index);
  for (Pass<Real>& pass : passes) pass.name = name + pass.name.substr(kind.name.size());
  return passes;
}

Precision precision_of(const BuiltScene& scene, ChosenPrecision asked) {
  if (scene.input.method.kind().make_float == nullptr || asked == ChosenPrecision::double_precision)
    return Precision::double_precision;
  return asked == ChosenPrecision::single_precision || single_suffices(scene) ? Precision::single_precision
                                                                              : Precision::double_precision;
}

// Throws ConfigError if the method leaves out one of `passes`, because its effect would then do nothing.
template <class Real>
void check_plan(const BuiltScene& scene, const std::vector<Pass<Real>>& passes,
                const Simulation& simulation) {
  for (const Pass<Real>& pass : passes) {
    const bool is_equation = !pass.drag.empty() || pass.friction;
    if (!is_equation &&
        std::ranges::find(simulation.passes(), pass.name, &PassStatistics::name) == simulation.passes().end())
      throw ConfigError("solver method",
                        {{"/solver/method",
                          fmt::format("the method '{}' never runs '{}', which would do nothing: remove the "
                                      "effect from /effects, or choose another method",
                                      scene.input.method.name(), pass.name)}});
  }
}

template <class Real>
std::unique_ptr<Simulation> simulation_in(const BuiltScene& scene) {
  std::vector<Pass<Real>> passes;
  for (const bool first : {true, false})
    for (std::size_t index = 0; index < scene.effects.size(); ++index)
      if (scene.effects[index].kind().acts_first == first)
        for (Pass<Real>& pass : passes_at<Real>(scene, index)) passes.push_back(std::move(pass));
  try {
    std::unique_ptr<Simulation> simulation = make_simulation<Real>(scene.input, passes);
    check_plan(scene, passes, *simulation);
    return simulation;
  } catch (const std::invalid_argument& error) {  // a method that does not suit this scene
    throw ConfigError("solver method", {{"/solver/method", error.what()}});
  }
}

}  // namespace

AcceptedMesh rest_mesh_of(const Mesh& mesh, const std::filesystem::path& folder) {
  AcceptedMesh accepted = mesh.given  ? mesh_of_program(*mesh.given, mesh.bad_triangles)
                          : mesh.file ? mesh_from_file(folder / *mesh.file, mesh.bad_triangles)
                                      : generated_mesh(mesh);
  accepted.mesh = altered(std::move(accepted.mesh), mesh);
  if (mesh.surface.is_given()) try {
      accepted.named = accepted.mesh.positions;
      accepted.mesh.positions = on_surface(mesh.surface, accepted.named);
    } catch (const std::invalid_argument& error) {
      throw ConfigError("/mesh/surface", {{"/mesh/surface/shape", error.what()}});
    }
  for (Positions* positions : {&accepted.mesh.positions, &accepted.named}) {
    *positions *= mesh.scale;
    positions->rowwise() += mesh.offset.transpose();
  }
  require_numbers_hold(accepted.mesh, !mesh.offset.isZero(0));
  return accepted;
}

BuiltScene build_scene(const Scene& stated) {
  AcceptedMesh accepted = rest_mesh_of(stated.mesh, stated.folder);
  BuiltScene scene{.rest = RestMesh(std::move(accepted.mesh), std::move(accepted.named)),
                   .mesh_notes = std::move(accepted.notes),
                   .input = {.method = stated.solver.method}};
  const RestMesh& rest = scene.rest;
  scene.folder = stated.folder;
  scene.effects = stated.effects;
  scene.down = direction_of_gravity(scene.effects);
  scene.pins = pins_of(stated, rest, scene.mesh_notes, accepted.renumbered, scene.down);

  SimulationInput& input = scene.input;
  const MethodKind& method = input.method.kind();
  input.positions = initial_positions(stated.initial, rest, scene.pins, stated.folder);
  input.velocities = initial_velocities(stated.initial, input.positions, rest.centre());
  input.rest = rest.positions();
  input.origin = rest.centre();
  input.size = rest.size();
  const auto factors = [&](const MaterialMap& map, const char* pointer) {
    try {
      return factors_of(map, stated.mesh, rest, stated.folder, pointer);
    } catch (const MeshFileError& error) {
      if (error.kind() == MeshFileError::Kind::refused) throw MeshError(error.what());
      throw;
    }
  };
  input.mass =
      masses_of(stated.material, rest, factors(stated.material.density_map, "/material/density_map"));
  input.is_pinned = scene.pins.is_pinned;
  input.held = scene.pins.held;
  if (!method.mesh_order) input.permutation = local_numbering(rest);
  input.settings = {.dt = stated.solver.dt,
                    .substeps = substeps_of(stated.solver),
                    .iterations = iterations_of(stated.solver),
                    .threads = stated.solver.threads};
  expect_warp_in_sheet(stated, rest);
  std::vector<InverseRest> coordinates;
  if (method.membrane == Membrane::triangles || stated.bending.rigidity.is_given())
    coordinates = material_coordinates(stated.material, rest.mesh(), scene.mesh_notes);
  if (method.membrane == Membrane::edges)
    input.edges = edge_springs(rest, scene.pins);
  else
    input.strain = strain_constraints(rest, scene.pins, coordinates,
                                      stated.mesh.bad_triangles == BadTriangles::membrane_off
                                          ? dispensable_triangles(rest)
                                          : std::vector<char>{},
                                      factors(stated.material.strain.map, "/material/strain/map"));
  input.strain_stiffness = strain_stiffness(stated.material.strain, stated.material.poisson_ratio);

  const Bending& stated_bending = stated.bending;
  input.bending_stiffness = bending_stiffness(stated_bending);
  input.strain_schedule = stated.material.strain.over_time;
  input.bending_schedule = stated_bending.over_time;
  BendingConstraints bending =
      bending_constraints(stated_bending, stated.material.poisson_ratio, rest, scene.pins, coordinates,
                          {factors(stated_bending.map, "/bending/map"),
                           factors(stated_bending.hysteresis_map, "/bending/hysteresis_map"),
                           factors(stated_bending.plasticity_map, "/bending/plasticity_map")});
  const SolverSettings& settings = input.settings;
  const bool prestressed = stated_bending.model.kind().prestressed;
  if (method.projects && prestressed && stated_bending.stiffness == Stiffness::physical) {
    scene.push = bound_push(bending.distance, rest, input.mass, settings.dt / settings.substeps,
                            projections_per_substep(input));
    if (scene.push) std::ranges::move(facts_of(*scene.push), std::back_inserter(bending.facts));
  }
  if (input.bending_stiffness.kind == StiffnessKind::compliance && input.bending_stiffness.compliance > 0 &&
      prestressed)
    input.push_tension = push_tension(bending.distance, rest, input.bending_stiffness.compliance);
  scene.springs_beyond_ring_1 = count_beyond_ring_1(rest, bending.distance);
  scene.bending_facts = std::move(bending.facts);
  input.distance = std::move(bending.distance);
  input.elements = std::move(bending.elements);
  input.own = std::move(bending.own);
  input.directors = std::move(bending.directors);
  if (!scene.pins.symmetric.empty()) {
    const std::vector<char>& slopes = input.directors.held;
    if (slopes.empty() && stated.bending.model.kind().bends)
      throw ConfigError("/pins", {{"/pins/symmetry",
                                   fmt::format("the bending model '{}' cannot hold the slope at a plane of "
                                               "symmetry: choose dkt, or simulate both halves",
                                               stated.bending.model.name())}});
    input.held.insert(input.held.end(), slopes.begin(), slopes.end());
  }
  check_own_elements(input, stated.bending.model.kind());
  check_held(input);
  if (method.sort != nullptr) method.sort(input.method.settings(), input, rest);
  input.moves_apart = !rounding_speed(scene).whole_suffices();
  scene.precision = precision_of(scene, stated.solver.precision);
  return scene;
}

std::string pass_name(const std::vector<Effect>& effects, std::size_t index) {
  const EffectKind& kind = effects[index].kind();
  const auto same = [&](const Effect& effect) { return &effect.kind() == &kind; };
  if (std::ranges::count_if(effects, same) == 1) return std::string(kind.name);
  const auto before = effects.begin() + static_cast<std::ptrdiff_t>(index);
  return fmt::format("{} {}", kind.name, 1 + std::count_if(effects.begin(), before, same));
}

std::vector<std::size_t> idle_effects(const BuiltScene& scene) {
  std::vector<std::size_t> idle;
  for (std::size_t index = 0; index < scene.effects.size(); ++index) {
    const Effect& effect = scene.effects[index];
    if ((effect.kind().idle && effect.kind().idle(effect.settings())) ||
        passes_at<double>(scene, index).empty())
      idle.push_back(index);
  }
  return idle;
}

bool moves_vertices(const BuiltScene& scene) {
  for (std::size_t index = 0; index < scene.effects.size(); ++index)
    for (const Pass<float>& pass : passes_at<float>(scene, index))
      if (pass.stage != Stage::force && pass.stage != Stage::damp) return true;
  return false;
}

Mesh grid(double width, double height, int cells, Diagonal diagonal) {
  return {
      .generator = Generator::grid, .width = width, .height = height, .cells = cells, .diagonal = diagonal};
}

std::unique_ptr<Simulation> simulation_of(const BuiltScene& scene) {
  return scene.precision == Precision::double_precision ? simulation_in<double>(scene)
                                                        : simulation_in<float>(scene);
}

}  // namespace bendlab
