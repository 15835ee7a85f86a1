#include "experiments/config/rules.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bendlab/bending/model.hpp"
#include "bendlab/effects/effect.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/config_tables.hpp"
#include "experiments/config/pointers.hpp"

namespace bendlab {
namespace {

// A setting of an earlier version, and what to write instead.
struct ReplacedSetting {
  std::string_view pointer, by;
};
constexpr std::array<ReplacedSetting, 3> replaced_settings = {
    {{"/output/stiffness", R"("output": {"measures": ["stiffness"]})"},
     {"/output/stability", R"("output": {"measures": ["stability"]})"},
     {"/output/drape", R"("output": {"measures": ["drape"]})"}}};

// A problem at such a pointer says that there is no such setting, and may suggest one that has nothing to do
// with it.
void name_replacements(ConfigProblems& problems) {
  for (ConfigProblem& problem : problems) {
    const auto found = std::ranges::find(replaced_settings, problem.pointer, &ReplacedSetting::pointer);
    if (found != replaced_settings.end())
      problem.message = fmt::format("is a setting of an earlier version; now write {}", found->by);
  }
}

void check_name(const Json& canonical, ConfigProblems& problems) {
  if (!canonical.contains("name")) return;
  const auto& name = canonical["name"].get_ref<const std::string&>();
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  if (!std::ranges::all_of(name, allowed))
    problems.push_back(
        {"/name", "may hold letters (a-z, A-Z), digits, '_' and '-' only, because it names a folder; got " +
                      given_text(canonical["name"])});
  constexpr std::size_t longest = 100;  // a file system has 255 bytes for a name, and files add to it
  if (name.size() > longest)
    problems.push_back({"/name", fmt::format("has {} characters, and a folder's name may have {}; got {}",
                                             name.size(), longest, given_text(canonical["name"]))});
}

// A mesh file replaces the generator: settings of a generator beside it are an error, and do not affect the
// result.
void settle_mesh(const Json& given, Json& mesh, ConfigProblems& problems) {
  if (!mesh.contains("file")) return;
  constexpr std::array<std::string_view, 6> beside_a_file = {"file",          "scale",  "offset",
                                                             "bad_triangles", "refine", "jitter"};
  const bool jittered = mesh.contains("jitter");  // by the seed
  for (const std::string_view name : names_of(find_section("/mesh")->parameters)) {
    if (std::ranges::find(beside_a_file, name) != beside_a_file.end() || (name == "seed" && jittered))
      continue;
    const std::string pointer = child_pointer("/mesh", name);
    mesh.erase(std::string(name));
    if (value_at(given, pointer) != nullptr)
      problems.push_back({pointer,
                          "does not go with /mesh/file, which brings the whole mesh (only scale, offset, "
                          "bad_triangles, refine, jitter and with that seed go with it): remove one of the "
                          "two; to vary meshes, sweep or set /mesh as a whole"});
  }
}

// A ring of two vertices is no tube; a lattice of one triangle's width has no second row.
void check_cells(const Json& mesh, ConfigProblems& problems) {
  if (!mesh.contains("generator")) return;
  const int least = mesh["generator"] == "tube" ? 3 : mesh["generator"] == "equilateral" ? 2 : 1;
  if (mesh["cells"].get<int>() < least)
    problems.push_back({"/mesh/cells", fmt::format("expected at least {} for the generator {}, got {}", least,
                                                   mesh["generator"].get_ref<const std::string&>(),
                                                   given_text(mesh["cells"]))});
}

// The rigidity that springs and arcs give a sheet is known for flat rest shapes only.
void check_springs_lie_flat(const Json& canonical, ConfigProblems& problems) {
  const Json &bending = canonical["bending"], &mesh = canonical["mesh"];
  if (bending["stiffness"] != "physical" || !mesh.contains("generator")) return;
  const BendingModel* model = find_bending_model(bending["model"].get<std::string>());
  const std::string& generator = mesh["generator"].get_ref<const std::string&>();
  const bool shortens = (model->springs_only && model->name != "none") || model->one_sided;
  if (shortens && (generator == "tube" || generator == "sphere"))
    problems.push_back(
        {"/bending/stiffness",
         fmt::format("the physical stiffness of {} is known for flat rest shapes only, not "
                     "for a {}: choose a model made of hinges ({}), or state it by k or compliance",
                     model->name, generator, fmt::join(models_of_hinges(), ", "))});
}

// A run has at least a step, and so few that they can be counted and waited for.
void check_times(const Json& canonical, ConfigProblems& problems) {
  constexpr double most = 1e9, rounding = 1e-6;
  const double duration = canonical["duration"], dt = canonical["solver"]["dt"];
  if (duration < dt * (1 - rounding))
    problems.push_back(
        {"/duration", fmt::format("is shorter than a step: {} s, and /solver/dt is {} s", duration, dt)});
  if (duration / dt > most)
    problems.push_back(
        {"/duration",
         fmt::format("is {:.3g} steps of /solver/dt, and a run has at most {:.3g}", duration / dt, most)});
}

void check_indices(const Json& pins, ConfigProblems& problems) {
  const Json& indices = pins["indices"];
  for (std::size_t i = 0; i < indices.size(); ++i)
    if (const double index = indices[i];
        index != std::floor(index) || index > std::numeric_limits<int>::max())
      problems.push_back(
          {fmt::format("/pins/indices/{}", i),
           "expected a whole number (a vertex index, the first is 0), got " + given_text(indices[i])});
}

void check_warp_direction(const Json& material, ConfigProblems& problems) {
  if (std::ranges::all_of(material["warp_direction"], [](const Json& x) { return x.get<double>() == 0; }))
    problems.push_back({"/material/warp_direction", "is the zero vector, which has no direction"});
}

void keep_chosen_model(Json& bending) {
  for (const ConfigSection* section : child_sections("/bending"))
    if (bending["model"] != section_key(*section)) bending.erase(std::string(section_key(*section)));
}

// Removes what /bending/stiffness does not use, and checks what a physical stiffness needs of each model.
void settle_bending_stiffness(Json& bending, ConfigProblems& problems) {
  if (bending["stiffness"] != "physical") {
    for (const char* unused : {"flexural_rigidity", "quartic_coefficient", "at_curvature", "deflection"})
      bending.erase(unused);
    return;
  }
  for (const char* unused : {"k", "compliance"}) bending.erase(unused);
  const BendingModel* model = find_bending_model(bending["model"].get<std::string>());
  const bool rigidity = bending.contains("flexural_rigidity"),
             quartic = bending.contains("quartic_coefficient");
  const auto report = [&](const char* key, const char* message) {
    problems.push_back({fmt::format("/bending/{}", key), fmt::format(fmt::runtime(message), model->name)});
  };
  if (model->springs_only) {
    if (bending["deflection"] != "large")
      report("deflection", "is for models made of hinges only: remove it for {}");
    bending.erase("deflection");
  }
  if (model->name == "none") return;
  if (!model->springs_only || model->prestressed) {
    bending.erase("at_curvature");  // their rigidity does not depend on it
    if (quartic)
      report("quartic_coefficient",
             "is for springs that are at rest in the flat sheet, and {} has none: give flexural_rigidity (in "
             "N m)");
  } else if (quartic && rigidity) {
    report("quartic_coefficient",
           "is given, and flexural_rigidity too, but the springs of {} have one stiffness: remove one of the "
           "two");
  }
}

// Without a reference there is nothing to compare, and how to compare does not affect the result.
void settle_accuracy(Json& accuracy, ConfigProblems& problems) {
  for (const char* list : {"solver", "solver_coarser", "physical", "physical_coarser"})
    if (accuracy.contains(list) && accuracy[list].empty()) accuracy.erase(list);
  for (const char* base : {"solver", "physical"})
    if (const std::string coarser = fmt::format("{}_coarser", base);
        accuracy.contains(coarser) && !accuracy.contains(base))
      problems.push_back(
          {"/accuracy/" + coarser, fmt::format("needs /accuracy/{}, a reference to make coarser", base)});
  if (accuracy["start_from_end"] == true && accuracy["over_time"] == true)
    problems.push_back(
        {"/accuracy/start_from_end", "does not go with over_time: motions are compared from the same start"});
  if (accuracy.contains("solver") || accuracy.contains("physical")) return;
  for (const char* how : {"over_time", "start_from_end"})
    if (accuracy[how] == true)
      problems.push_back(
          {fmt::format("/accuracy/{}", how),
           "has nothing to compare with: name a reference in /accuracy/solver or /accuracy/physical"});
  accuracy = Json::object();
}

// Checks what a method needs, and removes settings that it does not use.
class MethodRules {
 public:
  MethodRules(Json& canonical, ConfigProblems& problems)
      : canonical_(canonical),
        problems_(problems),
        method_(*find_method(canonical["solver"]["method"].get<std::string>())),
        model_(*find_bending_model(canonical["bending"]["model"].get<std::string>())) {}

  void settle() {
    const std::string_view why = method_.needs_compliance;
    if (!why.empty()) check_compliance("/material/strain", why);
    if (method_.springs_only && !model_.springs_only)
      refuse_model();
    else if (method_.factorised == Factorised::scalars && model_.one_sided)
      report("/bending/model",
             fmt::format("the force of {} jumps where it is straight, so that no constant matrix resembles "
                         "it: choose the method newton, or another model",
                         model_.name));
    else if (!why.empty() && model_.name != "none")
      check_compliance("/bending", why);
    if (!method_.projects) check_projection_effects();
    for (const std::string_view name : names_of(find_section("/solver")->parameters))
      if (!method_.reads(name)) canonical_["solver"].erase(std::string(name));
    if (method_.membrane == Membrane::edges)
      drop("/material/strain", {"form", "warp", "weft", "shear", "area"});
    if (!why.empty()) drop("/bending", {"k"});
    if (canonical_["solver"].value("levels", 0) > 0) check_all_directions();
  }

 private:
  // A coarse span knows no direction.
  void check_all_directions() {
    for (const char* const name : {"warp", "weft", "shear"})
      if (canonical_["material"]["strain"].value(name, 1.0) == 0)
        problems_.push_back({fmt::format("/material/strain/{}", name),
                             "expected a number above 0 (because /solver/levels resist in every direction), "
                             "got 0; 0 /solver/levels would do"});
  }

  void report(const std::string& pointer, const std::string& message) {
    problems_.push_back({pointer, fmt::format("{} (because /solver/method is {})", message, method_.name)});
  }

  void drop(const char* section, std::initializer_list<const char*> unused) {
    for (const char* name : unused) canonical_.at(Json::json_pointer(section)).erase(name);
  }

  void check_compliance(const std::string& pointer, std::string_view why) {
    const Json& section = canonical_.at(Json::json_pointer(pointer));
    if (section["stiffness"] == "physical") return;
    if (section["stiffness"] != "compliance")
      report(pointer + "/stiffness",
             fmt::format("must be \"physical\", or \"compliance\" with {}/compliance above 0{}: {}", pointer,
                         pointer == "/bending" ? "" : ", 1e-4 m/N for example", why));
    else if (!(section["compliance"].get<double>() > 0))
      report(pointer + "/compliance", fmt::format("must be above 0: {}", why));
  }

  // Refuses effects that need projections. Those that only help them do nothing, but stay in the list: the
  // others keep their places in it.
  void check_projection_effects() {
    const Json& effects = canonical_["effects"];
    for (std::size_t i = 0; i < effects.size(); ++i)
      if (const Effect& effect = *find_effect(effects[i]["type"].get<std::string>());
          !method_.takes_effect(effect.name, effect.needs_projection) && !effect.helps_projection)
        report(
            fmt::format("/effects/{}", i),
            fmt::format("{} acts between iterations, and this method does not take it: remove it, or choose "
                        "one of {}",
                        effect.name, fmt::join(takers_of(effect), ", ")));
  }

  static std::vector<std::string_view> takers_of(const Effect& effect) {
    std::vector<std::string_view> takers;
    for (const Method* each : methods())
      if (each->takes_effect(effect.name, effect.needs_projection)) takers.push_back(each->name);
    return takers;
  }

  void refuse_model() {
    std::vector<std::string_view> allowed;
    for (const BendingModel* each : bending_models())
      if (each->springs_only) allowed.push_back(each->name);
    report("/bending/model",
           fmt::format("{} is not made of springs, but this method needs springs: choose one of {}",
                       model_.name, fmt::join(allowed, ", ")));
  }

  Json& canonical_;
  ConfigProblems& problems_;
  const Method& method_;
  const BendingModel& model_;
};

}  // namespace

void apply_rules(const Json& given, Json& canonical, ConfigProblems& problems) {
  name_replacements(problems);
  check_name(canonical, problems);
  settle_mesh(given, canonical["mesh"], problems);
  check_cells(canonical["mesh"], problems);
  check_indices(canonical["pins"], problems);
  check_times(canonical, problems);
  check_warp_direction(canonical["material"], problems);
  keep_chosen_model(canonical["bending"]);
  settle_bending_stiffness(canonical["bending"], problems);
  check_springs_lie_flat(canonical, problems);
  MethodRules(canonical, problems).settle();
  settle_accuracy(canonical["accuracy"], problems);
}

}  // namespace bendlab
