// Warnings about settings that do nothing, or not what the config says.
#include "experiments/run/warning_messages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "bendlab/parameters/names.hpp"
#include "experiments/config/config_tables.hpp"
#include "experiments/config/settings_by_pointer.hpp"
#include "experiments/config/stiffness_settings.hpp"

namespace bendlab {

// ---- inert_seed

namespace {

// null is the default, and chooses nothing.
bool gives(const Json& settings, const std::string& pointer) {
  const Json* const value = value_at(settings, pointer);
  return value != nullptr && !value->is_null();
}

}  // namespace

bool is_chosen(const WarningInput& input, const std::string& pointer) {
  if (gives(input.experiment.settings, pointer)) return true;
  for (const auto& [swept, value] : input.config.point) {
    if (swept == pointer && !value.is_null()) return true;
    if (lies_within(pointer, swept) && gives(value, pointer.substr(swept.size()))) return true;
  }
  return false;
}

namespace {

// Whether other runs follow from this one's settings, which may use what this one does not.
bool has_derived_runs(const RunConfig& config) {
  return config.scene().initial.after || config.settings().accuracy.compares();
}

}  // namespace

Message inert_seed(const WarningInput& input) {
  if (has_derived_runs(input.config)) return std::nullopt;
  const Initial& initial = input.config.scene().initial;
  const Mesh& mesh = input.config.scene().mesh;
  const bool initial_used = initial.perturbation > 0 || initial.random > 0,
             mesh_used = mesh.jitter.value_or(0) > 0 || (!mesh.file && mesh.generator == Generator::delaunay);
  std::string inert;
  if (!initial_used && is_chosen(input, "/initial/seed")) inert = "/initial/seed";
  if (!mesh_used && is_chosen(input, "/mesh/seed")) inert = "/mesh/seed";
  if (inert.empty()) return std::nullopt;
  return fmt::format(
      "{} changes nothing here: runs that differ in it alone are equal, and their spread is 0. {}", inert,
      inert == "/mesh/seed" ? "Only /mesh/generator: delaunay and /mesh/jitter use it"
                            : "Set /initial/perturbation, to 1e-6 for example, or remove the seed");
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
  const std::string_view generator = name_in(generator_names, input.config.scene().mesh.generator);
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
    for (const Section& section : config_sections())
      if (lies_within(section.pointer, in))
        for (const SettingRow& row : section.rows)
          if (std::string pointer = child_pointer(section.pointer, row.field.name);
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
  const std::string_view method = input.config.scene().solver.method.name();
  std::vector<std::string> of_methods = unread("/solver", "/solver/method");
  std::ranges::move(unread("/material/strain", "/solver/method"), std::back_inserter(of_methods));
  if (!of_methods.empty())
    return text(of_methods,
                fmt::format("the method {} does not read {} ('bendlab methods' says what each reads)", method,
                            of_methods.size() == 1 ? "it" : "them")) +
           "/solver/method";
  if (const std::vector<std::string> of_generators = unread_of_generator(input); !of_generators.empty())
    return text(of_generators, fmt::format("the generator {} does not read {}",
                                           name_in(generator_names, input.config.scene().mesh.generator),
                                           of_generators.size() == 1 ? "it" : "them")) +
           "/mesh/generator";
  std::vector<std::string> of_models;
  for (const Section* section : child_sections("/bending"))
    std::ranges::move(unread(section->pointer, "/bending/model"), std::back_inserter(of_models));
  if (of_models.empty()) return std::nullopt;
  return text(of_models, fmt::format("/bending/model is {}", input.config.scene().bending.model.name())) +
         "/bending/model";
}

// ---- replaced_setting

namespace {

// Adds the settings that `stated` has, but not `value`, which takes its place. Left out are those whose value
// in force is the stated one all the same.
void add_replaced(const Json& resolved, const std::string& pointer, const Json& stated, const Json& value,
                  std::vector<std::string>& replaced) {
  for (const auto& [key, setting] : stated.items()) {
    const std::string place = child_pointer(pointer, key);
    const auto found = value.find(key);
    const Json* const now = value_at(resolved, place);
    if (found == value.end() && now != nullptr && *now != setting)
      replaced.push_back(place);
    else if (found != value.end() && setting.is_object() && found->is_object())
      add_replaced(resolved, place, setting, *found, replaced);
  }
}

}  // namespace

// A swept object takes the place of the config's own.
Message replaced_setting(const WarningInput& input) {
  std::vector<std::string> replaced, by;
  for (const auto& swept : input.config.point) {
    const std::string& pointer = swept.first;
    const Json& value = swept.second;
    const Json* const stated = value_at(input.experiment.settings, pointer);
    const bool of_no_model = pointer == "/bending" && !input.config.scene().bending.model.kind().bends;
    if (stated == nullptr || !stated->is_object() || !value.is_object() || of_no_model) continue;
    std::vector<std::string> here;
    add_replaced(input.config.resolved(), pointer, *stated, value, here);
    // What another axis sweeps within the object is meant to be another value.
    std::erase_if(here, [&](const std::string& place) {
      return std::ranges::any_of(input.config.point, [&](const auto& axis) {
        return axis.first != pointer && lies_within(axis.first, pointer) && lies_within(place, axis.first);
      });
    });
    if (!here.empty()) by.push_back(pointer);
    replaced.insert(replaced.end(), here.begin(), here.end());
  }
  if (replaced.empty()) return std::nullopt;
  return fmt::format(
      "the config states {}, but each value of the sweep of {} takes the place of the whole object. State it "
      "in each swept object, or sweep single settings",
      fmt::join(replaced, ", "), fmt::join(by, ", "));
}

}  // namespace bendlab
