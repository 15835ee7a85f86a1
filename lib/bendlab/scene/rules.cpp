#include "bendlab/scene/rules.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <vector>

#include "bendlab/scene/fields_json.hpp"
#include "bendlab/scene/pointers.hpp"
#include "bendlab/scene/scene_tables.hpp"
#include "bendlab/settings/names.hpp"

namespace bendlab {
namespace {

// Rows are parallel to sides that are pinned by name, because rows across a clamp lock the membrane.
Rows rows_of_lattice(const Mesh& mesh, const Pinning& pins) {
  const auto names = [&](std::initializer_list<Place> sides) {
    return std::ranges::find_first_of(pins.vertices, sides) != pins.vertices.end();
  };
  const bool along_x = names({Place::top, Place::bottom}), along_y = names({Place::left, Place::right});
  if (along_x == along_y) return Rows::parallel;
  return along_x == (mesh.width >= mesh.height) ? Rows::parallel : Rows::perpendicular;
}

// A ring of a tube needs three vertices. In a lattice one cell wide, every second row would be one vertex.
void check_cells(const Scene& scene, ConfigProblems& problems) {
  const Mesh& mesh = scene.mesh;
  if (mesh.file || mesh.given) return;
  const int least = mesh.generator == Generator::tube ? 3 : mesh.generator == Generator::equilateral ? 2 : 1;
  if (mesh.cells < least)
    problems.push_back({"/mesh/cells", fmt::format("expected at least {} for the generator {}, got {}", least,
                                                   name_in(generator_names, mesh.generator), mesh.cells)});
}

// Springs and arcs give a sheet a rigidity that is known only for flat rest shapes.
void check_springs_lie_flat(const Scene& scene, ConfigProblems& problems) {
  const Mesh& mesh = scene.mesh;
  if (scene.bending.stiffness != Stiffness::physical || mesh.file || mesh.given) return;
  const BendingKind& model = scene.bending.model.kind();
  const bool shortens = model.bends && !is_made_of_hinges(model);
  if (shortens && (mesh.generator == Generator::tube || mesh.generator == Generator::sphere))
    problems.push_back(
        {"/bending/stiffness",
         fmt::format("the physical stiffness of {} is known only for flat rest shapes, not for a {}: choose "
                     "a model made of hinges ({}), or set stiffness to k or compliance",
                     model.name, name_in(generator_names, mesh.generator),
                     fmt::join(models_of_hinges(), ", "))});
}

// A run has at least one step and at most 10⁹ steps.
void check_times(const Scene& scene, ConfigProblems& problems) {
  constexpr double most = 1e9, rounding = 1e-6;
  const double duration = scene.duration, dt = scene.solver.dt;
  if (duration < dt * (1 - rounding))
    problems.push_back(
        {"/duration", fmt::format("is shorter than a step: {} s, but /solver/dt is {} s", duration, dt)});
  if (duration / dt > most)
    problems.push_back(
        {"/duration", fmt::format("takes {:.3g} steps of /solver/dt, but at most {:.3g} steps are allowed",
                                  duration / dt, most)});
}

void check_warp_direction(const Scene& scene, ConfigProblems& problems) {
  if (scene.material.warp_direction.isZero(0))
    problems.push_back({"/material/warp_direction", "is the zero vector, but needs a direction"});
}

// Checks what a physical stiffness requires of the model.
void check_bending_stiffness(const Bending& bending, ConfigProblems& problems) {
  if (bending.stiffness != Stiffness::physical) return;
  const BendingKind& model = bending.model.kind();
  const auto report = [&](const char* key, const char* message) {
    problems.push_back({fmt::format("/bending/{}", key), fmt::format(fmt::runtime(message), model.name)});
  };
  if ((model.springs_only || model.rigidity_by_formula) && bending.deflection != Deflection::large)
    report("deflection",
           "applies only to hinges that are calibrated, such as discrete_shells: remove this setting for {}");
  if (!model.bends || !bending.quartic_coefficient) return;
  if (!model.springs_only || model.prestressed)
    report("quartic_coefficient",
           "applies only to springs without force in the flat sheet, which {} does not have: set "
           "flexural_rigidity (in N m) instead");
  else if (bending.flexural_rigidity)
    report("quartic_coefficient",
           "cannot be combined with flexural_rigidity, because the springs of {} have only one stiffness: "
           "remove one of these settings");
}

// Checks what a rigidity and a membrane that depend on the direction require.
void check_directions(const Scene& scene, ConfigProblems& problems) {
  const auto report = [&](const std::string& pointer, const std::string& message) {
    problems.push_back({pointer, message});
  };
  const auto need_both = [&](const std::string& pointer, const auto& directed) {
    for (const auto& [name, value] : {std::pair{"warp", directed.warp}, std::pair{"weft", directed.weft}})
      if (!value) report(fmt::format("{}/{}", pointer, name), "is missing: state warp and weft");
    return directed.warp && directed.weft;
  };
  const DirectedRigidity& rigidity = scene.bending.rigidity;
  const BendingKind& model = scene.bending.model.kind();
  if (rigidity.is_given() && scene.bending.stiffness == Stiffness::physical) {
    if (scene.material.youngs_modulus)
      report("/bending/rigidity",
             "cannot be combined with /material/youngs_modulus: remove one of these settings");
    if (scene.bending.quartic_coefficient)
      report("/bending/rigidity",
             "cannot be combined with quartic_coefficient: remove one of these settings");
    if (model.rigidity_by_formula && !model.takes_directions)
      report(
          "/bending/rigidity",
          fmt::format("{} has the same rigidity in all directions: set flexural_rigidity, or choose another "
                      "model, such as mid_edge",
                      model.name));
    if (need_both("/bending/rigidity", rigidity)) try {
        orthotropic_rigidity(*rigidity.warp, *rigidity.weft, rigidity.bias, scene.material.poisson_ratio);
      } catch (const std::invalid_argument& error) {
        report("/bending/rigidity/bias", error.what());
      }
  }
  const Strain& strain = scene.material.strain;
  if (!strain.membrane.is_given() || strain.stiffness != Stiffness::physical) return;
  need_both("/material/strain/membrane", strain.membrane);
  if (scene.material.youngs_modulus)
    report("/material/strain/membrane",
           "cannot be combined with /material/youngs_modulus: remove one of these settings");
  else if (strain.form == StrainForm::stvk)
    report("/material/strain/membrane",
           "cannot be combined with the isotropic form stvk: set /material/strain/form to angle or green, or "
           "remove this setting");
  if (scene.solver.method.kind().membrane == Membrane::edges)
    report("/material/strain/membrane",
           fmt::format("needs a membrane of triangles, but {} has springs along the edges: choose another "
                       "method, or set membrane_stiffness",
                       scene.solver.method.name()));
}

// Checks keyframes of a stiffness.
void check_keyframes(const Scene& scene, ConfigProblems& problems) {
  const auto check = [&](const std::string& section, const Schedule& schedule, Stiffness stiffness) {
    const auto report = [&](const std::string& message) {
      problems.push_back({section + "/over_time", message});
    };
    if (!schedule.is_given()) return;
    if (const std::string problem = schedule.problem(); !problem.empty()) report(problem);
    if (stiffness == Stiffness::k || stiffness == Stiffness::k_per_step)
      report(fmt::format("needs a stiffness that is not k: set {}/stiffness to physical or compliance",
                         section));
    if (scene.solver.method.kind().membrane == Membrane::edges)
      report(
          fmt::format("is not read by {}: choose another method, or remove it", scene.solver.method.name()));
  };
  check("/material/strain", scene.material.strain.over_time, scene.material.strain.stiffness);
  check("/bending", scene.bending.over_time, scene.bending.stiffness);
}

// Checks what maps of the material require.
void check_maps(const Scene& scene, ConfigProblems& problems) {
  const Strain& strain = scene.material.strain;
  const Bending& bending = scene.bending;
  const auto report = [&](const std::string& pointer, const std::string& message) {
    problems.push_back({pointer, message});
  };
  const bool by_k = strain.stiffness == Stiffness::k || strain.stiffness == Stiffness::k_per_step;
  if (strain.map.is_given() && by_k)
    report("/material/strain/map",
           "needs a stiffness in N/m: set /material/strain/stiffness to physical or compliance");
  if (strain.map.is_given() && scene.solver.method.kind().membrane == Membrane::edges)
    report("/material/strain/map",
           fmt::format("needs a membrane of triangles, but {} has springs along the edges: "
                       "choose another method, or remove the map",
                       scene.solver.method.name()));
  for (const auto& [name, map] :
       {std::pair{"map", &bending.map}, std::pair{"hysteresis_map", &bending.hysteresis_map},
        std::pair{"plasticity_map", &bending.plasticity_map}})
    if (map->is_given() && bending.stiffness != Stiffness::physical)
      report(fmt::format("/bending/{}", name), "needs a rigidity in N m: set /bending/stiffness to physical");
  for (const auto& [pointer, map] :
       {std::pair{"/material/density_map", &scene.material.density_map},
        std::pair{"/material/strain/map", &strain.map}, std::pair{"/bending/map", &bending.map},
        std::pair{"/bending/hysteresis_map", &bending.hysteresis_map},
        std::pair{"/bending/plasticity_map", &bending.plasticity_map}})
    if (!map->is_given() && (!map->property.empty() || map->low != 0 || map->high != 1))
      report(fmt::format("{}/file", pointer), "is missing: state a PLY file or a PNG image");
  if (bending.hysteresis_map.is_given() && !bending.hysteresis.is_given())
    report("/bending/hysteresis_map", "needs /bending/hysteresis: state its hb, or remove the map");
  if (bending.plasticity_map.is_given() && !bending.plasticity.is_given())
    report("/bending/plasticity_map", "needs /bending/plasticity: state its yield_at, or remove the map");
}

// Checks what a nonlinear moment requires.
void check_moments(const Scene& scene, ConfigProblems& problems) {
  const Bending& bending = scene.bending;
  if (bending.stiffness != Stiffness::physical) return;
  const auto report = [&](const std::string& pointer, const std::string& message) {
    problems.push_back({"/bending/" + pointer, message});
  };
  const Softening& softening = bending.softening;
  const std::vector<double>&curvatures = softening.curvatures, &moments = softening.moments;
  if (softening.half_at && !(curvatures.empty() && moments.empty()))
    report("softening/half_at",
           "cannot be combined with curvatures and moments: remove one of these settings");
  if (curvatures.size() != moments.size())
    report("softening/moments", fmt::format("has {} numbers, but curvatures has {}: state a moment for every "
                                            "curvature",
                                            moments.size(), curvatures.size()));
  for (std::size_t i = 1; i < std::min(curvatures.size(), moments.size()); ++i)
    if (!(curvatures[i] > curvatures[i - 1]) || !(moments[i] >= moments[i - 1]))
      report(
          "softening/curvatures",
          fmt::format("point {} does not lie beyond point {}: sort the points, so that curvatures rise and "
                      "moments do not fall",
                      i + 1, i));
  for (const auto& [pointer, is_given] :
       {std::pair{"/material/youngs_modulus", scene.material.youngs_modulus.has_value()},
        std::pair{"/bending/rigidity", bending.rigidity.is_given()}})
    if (is_given && !curvatures.empty())
      report("softening/curvatures",
             fmt::format("set the rigidity (the first moment divided by the first curvature), which {} sets, "
                         "too: remove one of these settings",
                         pointer));
  if (bending.plasticity.hardening != 0 && !bending.plasticity.yield_at)
    report("plasticity/yield_at", "is missing: state the curvature beyond which a fold stays, in 1/m");
  if (bending.hysteresis.slip && !bending.hysteresis.hb)
    report("hysteresis/hb", "is missing: state HB, in N");
  for (const auto& [name, is_given] : {std::pair{"hysteresis", bending.hysteresis.is_given()},
                                       std::pair{"plasticity", bending.plasticity.is_given()}})
    if (is_given && !scene.solver.method.kind().has_motion)
      report(name, fmt::format("is not simulated by {}, because the moment depends on how the cloth moved: "
                               "choose a method with motion, such as quasi_newton",
                               scene.solver.method.name()));
  if (bending.plasticity.is_given() && softening.is_given())
    report("plasticity", "cannot be combined with softening: remove one of these settings");
}

// Checks what a shell and an isotropic membrane require.
void check_material(const Scene& scene, ConfigProblems& problems) {
  const Material& material = scene.material;
  const bool by_k =
      material.strain.stiffness == Stiffness::k || material.strain.stiffness == Stiffness::k_per_step;
  if (material.strain.form == StrainForm::stvk && by_k)
    problems.push_back(
        {"/material/strain/form",
         "stvk has a Poisson's ratio, which k cannot express: set /material/strain/stiffness to "
         "physical or compliance"});
  if (material.strain.form == StrainForm::stvk && material.poisson_ratio < 0)
    problems.push_back(
        {"/material/poisson_ratio",
         "is below 0, which the form stvk does not support: choose a ratio from 0 to 0.499, or "
         "the form angle"});
  if (!material.youngs_modulus) {
    if (material.thickness)
      problems.push_back({"/material/thickness", "needs a youngs_modulus, too: add it, or remove thickness"});
    return;
  }
  if (!material.thickness)
    problems.push_back({"/material/youngs_modulus", "needs a thickness, too: add it, in m"});
  for (const auto& [pointer, stiffness] : {std::pair{"/material/strain/stiffness", material.strain.stiffness},
                                           std::pair{"/bending/stiffness", scene.bending.stiffness}})
    if (stiffness != Stiffness::physical)
      problems.push_back({pointer,
                          "has to be physical with /material/youngs_modulus, which states the stiffness: "
                          "remove one of these settings"});
  if (scene.bending.quartic_coefficient)
    problems.push_back({"/bending/quartic_coefficient",
                        "cannot be combined with /material/youngs_modulus: remove one of these settings"});
}

void check_repeats(const Scene& scene, ConfigProblems& problems) {
  for (std::size_t i = 0; i < scene.effects.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const EffectKind& kind = scene.effects[i].kind();
          &kind == &scene.effects[j].kind() && !kind.repeatable) {
        problems.push_back({fmt::format("/effects/{}", i),
                            fmt::format("effect \"{}\" is already listed at /effects/{}; list each type once",
                                        kind.name, j)});
        break;
      }
}

// Checks what the method requires.
class MethodRules {
 public:
  MethodRules(const Scene& scene, ConfigProblems& problems)
      : scene_(scene),
        problems_(problems),
        method_(scene.solver.method.kind()),
        model_(scene.bending.model.kind()) {}

  void check() {
    const std::string_view why = method_.needs_compliance;
    const Strain& strain = scene_.material.strain;
    if (!why.empty()) check_compliance("/material/strain", strain.stiffness, strain.compliance, why);
    if (method_.springs_only && !model_.springs_only)
      refuse_model();
    else if (method_.factorised == Factorised::scalars && model_.one_sided)
      report("/bending/model",
             fmt::format("the force of {} jumps where the cloth is straight, so that no constant matrix can "
                         "approximate the force: choose the method newton, or another model",
                         model_.name));
    else if (why.empty() && model_.needs_energy)
      report(
          "/bending/model",
          fmt::format("the elements of {} have an energy, but no constraint that could be projected: choose "
                      "the method quasi_newton, newton or equilibrium, or another model",
                      model_.name));
    else if (!why.empty() && model_.bends)
      check_compliance("/bending", scene_.bending.stiffness, scene_.bending.compliance, why);
    if (!method_.projects) check_projection_effects();
    if (method_.carries_stretch != nullptr && method_.carries_stretch(scene_.solver.method.settings()))
      check_all_directions();
  }

 private:
  // Coarse levels resist stretch in every direction, so warp, weft and shear must be above 0.
  void check_all_directions() {
    const Strain& strain = scene_.material.strain;
    for (const auto& [name, k] :
         {std::pair{"warp", strain.warp}, {"weft", strain.weft}, {"shear", strain.shear}})
      if (k == 0)
        problems_.push_back({fmt::format("/material/strain/{}", name),
                             "expected a number above 0, got 0: the coarse levels of /solver/levels resist "
                             "stretch in every direction; to use 0, set /solver/levels to 0"});
  }

  void report(const std::string& pointer, const std::string& message) {
    problems_.push_back({pointer, fmt::format("{} (because /solver/method is {})", message, method_.name)});
  }

  void check_compliance(const std::string& pointer, Stiffness stiffness, double compliance,
                        std::string_view why) {
    if (stiffness == Stiffness::physical) return;
    if (stiffness != Stiffness::compliance)
      report(pointer + "/stiffness",
             fmt::format("must be \"physical\", or \"compliance\" with {}/compliance above 0{}: {}", pointer,
                         pointer == "/bending" ? "" : ", 1e-4 m/N for example", why));
    else if (!(compliance > 0))
      report(pointer + "/compliance", fmt::format("must be above 0: {}", why));
  }

  // Refuses effects that need projections. Effects that only help projections do nothing, but stay in the
  // list, so that the indices of the other effects do not change.
  void check_projection_effects() {
    for (std::size_t i = 0; i < scene_.effects.size(); ++i)
      if (const EffectKind& effect = scene_.effects[i].kind();
          !takes(method_, effect) && !effect.helps_projection)
        report(
            fmt::format("/effects/{}", i),
            fmt::format("{} acts between iterations, which this method does not support: remove the effect, "
                        "or choose one of the methods {}",
                        effect.name, fmt::join(takers_of(effect), ", ")));
  }

  static bool takes(const MethodKind& method, const EffectKind& effect) {
    return method.takes_effect(effect.needs_projection, effect.acts_in_iterations);
  }
  static std::vector<std::string_view> takers_of(const EffectKind& effect) {
    std::vector<std::string_view> takers;
    for (const MethodKind* method : methods())
      if (takes(*method, effect)) takers.push_back(method->name);
    return takers;
  }

  void refuse_model() {
    std::vector<std::string_view> allowed;
    for (const BendingKind* model : bending_models())
      if (model->springs_only) allowed.push_back(model->name);
    report("/bending/model",
           fmt::format("{} is not made of springs, but this method needs springs: choose one of {}",
                       model_.name, fmt::join(allowed, ", ")));
  }

  const Scene& scene_;
  ConfigProblems& problems_;
  const MethodKind& method_;
  const BendingKind& model_;
};

void check_table(const FieldTable& table, const void* owner, const Scene& scene, const std::string& pointer,
                 ConfigProblems& problems) {
  for (const Field& field : table.fields)
    if (field.is_kept(&scene))
      read_value(field, json_of(field.of(owner)), child_pointer(pointer, field.name), problems);
}

}  // namespace

void settle(Scene& scene) {
  if (!scene.mesh.rows && !scene.mesh.file)
    scene.mesh.rows = scene.mesh.generator == Generator::equilateral ? rows_of_lattice(scene.mesh, scene.pins)
                                                                     : Rows::parallel;
  Material& material = scene.material;
  const bool is_shell = material.youngs_modulus.has_value();
  if (!material.strain.form && scene.solver.method.kind().membrane == Membrane::triangles)
    material.strain.form = is_shell ? StrainForm::stvk : StrainForm::angle;
  if (is_shell && material.thickness) {
    const double e = *material.youngs_modulus, h = *material.thickness, nu = material.poisson_ratio;
    material.strain.membrane_stiffness = e * h;
    scene.bending.flexural_rigidity = e * h * h * h / (12 * (1 - nu * nu));
  }
  // Messages and bounds use one number: the larger stiffness of the membrane, and the mean rigidity.
  if (const DirectedMembrane& membrane = material.strain.membrane; membrane.warp && membrane.weft)
    material.strain.membrane_stiffness = std::max(*membrane.warp, *membrane.weft);
  if (const DirectedRigidity& rigidity = scene.bending.rigidity; rigidity.warp && rigidity.weft) try {
      scene.bending.flexural_rigidity =
          orthotropic_rigidity(*rigidity.warp, *rigidity.weft, rigidity.bias, material.poisson_ratio).mean();
    } catch (const std::invalid_argument&) {  // check_directions() reports it
    }
  if (const Softening& s = scene.bending.softening; !s.curvatures.empty() && !s.moments.empty())
    scene.bending.flexural_rigidity = s.moments.front() / s.curvatures.front();
  const MethodKind& method = scene.solver.method.kind();
  if (!scene.solver.substeps && method.default_substeps > 0) scene.solver.substeps = method.default_substeps;
  if (!scene.solver.iterations && method.default_iterations > 0)
    scene.solver.iterations = method.default_iterations;
}

void check_stated(const Json& given, const Scene& scene, ConfigProblems& problems) {
  if (!scene.mesh.file) return;
  const Part& part = scene_parts().front();
  for (const Field& field : part.table.fields)
    if (const std::string pointer = child_pointer(part.pointer, field.name);
        !field.is_kept(&scene) && value_at(given, pointer) != nullptr)
      problems.push_back({pointer,
                          "cannot be combined with /mesh/file: remove one of these settings; to sweep "
                          "different meshes, sweep /mesh as a whole. A file allows only scale, offset, "
                          "bad_triangles, refine, jitter, and seed with jitter"});
}

void check_scene(const Scene& scene, ConfigProblems& problems) {
  check_repeats(scene, problems);
  check_cells(scene, problems);
  check_times(scene, problems);
  check_warp_direction(scene, problems);
  check_bending_stiffness(scene.bending, problems);
  check_directions(scene, problems);
  check_moments(scene, problems);
  check_maps(scene, problems);
  check_keyframes(scene, problems);
  check_material(scene, problems);
  check_springs_lie_flat(scene, problems);
  MethodRules(scene, problems).check();
}

void check_ranges(const Scene& scene, ConfigProblems& problems) {
  check_table(scene_table(), &scene, scene, "", problems);
  for (const Part& part : scene_parts())
    check_table(part.table, part.in(scene), scene, std::string(part.pointer), problems);
  const BendingModel& model = scene.bending.model;
  const Method& method = scene.solver.method;
  check_table(model.kind().settings, model.settings(), scene, fmt::format("/bending/{}", model.name()),
              problems);
  check_table(method.kind().settings, method.settings(), scene, "/solver", problems);
  for (std::size_t i = 0; i < scene.effects.size(); ++i)
    check_table(scene.effects[i].kind().settings, scene.effects[i].settings(), scene,
                fmt::format("/effects/{}", i), problems);
}

void check_unread(const Scene& scene, ConfigProblems& problems) {
  for (const Part& part : scene_parts())
    for (const Field& field : part.table.fields) {
      const Value value = field.of(part.in(scene));
      if (field.is_kept(&scene) || value == part.table.default_of(field)) continue;
      problems.push_back(
          {child_pointer(part.pointer, field.name),
           fmt::format("is {}, but with the other settings nothing reads this setting: leave the default",
                       json_of(value).dump())});
    }
}

int substeps_of(const Solver& solver) {
  const int usual = solver.method.kind().default_substeps;
  return usual > 0 ? solver.substeps.value_or(usual) : 1;
}

int iterations_of(const Solver& solver) {
  const int usual = solver.method.kind().default_iterations;
  return usual > 0 ? solver.iterations.value_or(usual) : 1;
}

}  // namespace bendlab
