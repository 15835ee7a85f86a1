// Warnings about settings that are unread, or that a swept object replaces.
#include "experiments/run/warning_messages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <vector>

#include "experiments/config/config_tables.hpp"
#include "experiments/config/settings_by_pointer.hpp"

namespace bendlab {

// ---- inert_seed

namespace {

// Whether the settings have a value at `pointer`. null means the default, and does not count as a value.
bool has_value(const Json& settings, const std::string& pointer) {
  const Json* const value = value_at(settings, pointer);
  return value != nullptr && !value->is_null();
}

}  // namespace

bool is_chosen(const WarningInput& input, const std::string& pointer) {
  if (has_value(input.experiment.settings, pointer)) return true;
  for (const auto& [swept, value] : input.config.point) {
    if (swept == pointer && !value.is_null()) return true;
    if (lies_within(pointer, swept) && has_value(value, pointer.substr(swept.size()))) return true;
  }
  return false;
}

namespace {

// Whether the settings of this run also define other runs, which may read settings that this run does not
// read.
bool has_derived_runs(const RunConfig& config) {
  return config.scene().initial.after || config.settings().accuracy.compares();
}

}  // namespace

Message inert_seed(const WarningInput& input) {
  if (has_derived_runs(input.config)) return std::nullopt;
  for (const Part& part : scene_parts()) {
    const Field* const seed = part.table.find("seed");
    const std::string pointer = child_pointer(part.pointer, "seed");
    if (seed == nullptr || seed->is_read(&input.config.scene()) || !is_chosen(input, pointer)) continue;
    return fmt::format(
        "{} changes nothing here: runs that differ only in this seed are equal, and their spread is 0. {}",
        pointer,
        pointer == "/mesh/seed" ? "Only the /mesh/generator delaunay and /mesh/jitter read this seed"
                                : "Set /initial/perturbation, to 1e-6 for example, or remove the seed");
  }
  return std::nullopt;
}

// ---- inert_stiffness, inert_setting

namespace {

// Pointer of the setting whose value decides whether `field` is read; empty if no setting decides this.
std::string_view decider_of(const Section& section, const Field& field) {
  if (!field.depends_on.empty()) return field.depends_on;
  if (section.pointer == "/solver" || section.pointer == "/material/strain") return "/solver/method";
  return section.pointer.starts_with("/bending/") ? "/bending/model" : "";
}

// The settings that the config states, but that nothing reads because of the value of the setting `decider`.
// Empty if `decider` is swept, because other runs may read the settings. (The resolved config has no settings
// of methods and models that are not chosen.)
std::vector<std::string> unread(const WarningInput& input, std::string_view decider) {
  std::vector<std::string> pointers;
  if (std::ranges::any_of(input.experiment.axes,
                          [&](const Axis& axis) { return lies_within(decider, axis.first); }))
    return pointers;
  // The resolved config keeps laws of bending, such as /bending/softening, even if the model does not bend.
  const bool no_bending = decider == "/bending/model" && !input.config.scene().bending.model.kind().bends;
  for (const Section& section : config_sections())
    for (const SettingRow& row : section.rows) {
      const bool is_inert = no_bending && section.pointer.starts_with("/bending/");
      if (!is_inert && decider_of(section, row.field) != decider) continue;
      std::string pointer = child_pointer(section.pointer, row.field.name);
      const bool is_read =
          !is_inert && (row.field.depends_on.empty() ? value_at(input.config.resolved(), pointer) != nullptr
                                                     : row.field.is_read(&input.config.scene()));
      if (!is_read && is_chosen(input, pointer)) pointers.push_back(std::move(pointer));
    }
  return pointers;
}

std::string choice_at(const WarningInput& input, const char* pointer) {
  const Json* const choice = value_at(input.config.resolved(), pointer);
  return choice == nullptr ? "" : choice->get<std::string>();
}

}  // namespace

// A warning about a stiffness that the chosen kind of stiffness does not read.
Message inert_stiffness(const WarningInput& input) {
  if (has_derived_runs(input.config)) return std::nullopt;
  for (const char* kind : {"/bending/stiffness", "/material/strain/stiffness"})
    if (const std::vector<std::string> pointers = unread(input, kind); !pointers.empty()) {
      const auto readers = choices_that_read(*find_setting(Json(), pointers.front()));
      if (std::ranges::find(readers, choice_at(input, kind)) != readers.end())
        return fmt::format(
            "{} changes nothing here, because another setting states this stiffness, for example by "
            "direction, as a curve, or as a shell. Remove this setting or the other",
            pointers.front());
      return fmt::format("{} changes nothing here, because {} is {}. Choose {} there, or remove the setting",
                         pointers.front(), kind, choice_at(input, kind), fmt::join(readers, " or "));
    }
  return std::nullopt;
}

Message inert_setting(const WarningInput& input) {
  if (has_derived_runs(input.config)) return std::nullopt;
  constexpr std::array<std::array<const char*, 2>, 3> causes = {{
      {"/solver/method",
       "the method {} does not read {} ('bendlab methods' lists the settings of each method)"},
      {"/mesh/generator", "the generator {} does not read {}"},
      {"/bending/model", "/bending/model is {}"},
  }};
  for (const auto& cause : causes)
    if (const std::vector<std::string> pointers = unread(input, cause[0]); !pointers.empty()) {
      const char* const them = pointers.size() == 1 ? "it" : "them";
      return fmt::format("{} change{} nothing here, because {}. Remove {}, or choose another {}",
                         fmt::join(pointers, ", "), pointers.size() == 1 ? "s" : "",
                         fmt::format(fmt::runtime(cause[1]), choice_at(input, cause[0]), them), them,
                         cause[0]);
    }
  const Scene& scene = input.config.scene();
  for (const auto& [pointer, factors] :
       {std::pair{"/material/strain/over_time", &scene.material.strain.over_time},
        std::pair{"/bending/over_time", &scene.bending.over_time}})
    if (scene.solver.method.kind().has_motion && is_chosen(input, pointer) && factors->is_given() &&
        factors->is_always_1(scene.duration) &&
        std::ranges::none_of(input.experiment.axes, [pointer = std::string_view(pointer)](const Axis& axis) {
          return lies_within(pointer, axis.first);
        }))
      return fmt::format(
          "{0} changes nothing here, because the factor is 1 until the run ends at {1:.3g} s. Remove {0}, or "
          "state another factor before this time",
          pointer, scene.duration);
  return std::nullopt;
}

// ---- replaced_setting

namespace {

// Adds the settings of the object `stated` that are missing in `value`, which replaces `stated`. Leaves out a
// setting if its resolved value still equals its stated value.
void add_replaced(const Json& resolved, const std::string& pointer, const Json& stated, const Json& value,
                  std::vector<std::string>& replaced) {
  for (const auto& [key, setting] : stated.items()) {
    const std::string place = child_pointer(pointer, key);
    const auto swept = value.find(key);
    const Json* const in_force = value_at(resolved, place);
    if (swept == value.end() && in_force != nullptr && *in_force != setting)
      replaced.push_back(place);
    else if (swept != value.end() && setting.is_object() && swept->is_object())
      add_replaced(resolved, place, setting, *swept, replaced);
  }
}

}  // namespace

// A warning about stated settings that get lost, because a swept object replaces the whole object.
Message replaced_setting(const WarningInput& input) {
  std::vector<std::string> replaced, by;
  for (const auto& swept : input.config.point) {
    const std::string& pointer = swept.first;
    const Json& value = swept.second;
    const Json* const stated = value_at(input.experiment.settings, pointer);
    const bool of_no_model = pointer == "/bending" && !input.config.scene().bending.model.kind().bends;
    if (stated == nullptr || !stated->is_object() || !value.is_object() || of_no_model) continue;
    std::vector<std::string> in_object;
    add_replaced(input.config.resolved(), pointer, *stated, value, in_object);
    // If another axis sweeps a setting of the object, this setting is meant to change.
    std::erase_if(in_object, [&](const std::string& place) {
      return std::ranges::any_of(input.config.point, [&](const auto& axis) {
        return axis.first != pointer && lies_within(axis.first, pointer) && lies_within(place, axis.first);
      });
    });
    if (!in_object.empty()) by.push_back(pointer);
    replaced.insert(replaced.end(), in_object.begin(), in_object.end());
  }
  if (replaced.empty()) return std::nullopt;
  return fmt::format(
      "the config states {}, but sweeping {} replaces the whole object. State the settings in each swept "
      "object, or sweep single settings",
      fmt::join(replaced, ", "), fmt::join(by, ", "));
}

}  // namespace bendlab
