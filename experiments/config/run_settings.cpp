#include "experiments/config/run_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "bendlab/scene/fields_json.hpp"
#include "bendlab/scene/pointers.hpp"
#include "bendlab/scene/scene_json.hpp"
#include "experiments/config/config_tables.hpp"

namespace bendlab {
namespace {

void check_name(const std::string& name, ConfigProblems& problems) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  if (!std::ranges::all_of(name, allowed))
    problems.push_back(
        {"/name", "may hold letters (a-z, A-Z), digits, '_' and '-' only, because it names a folder; got " +
                      given_text(name)});
  constexpr std::size_t longest = 100;  // a file system has 255 bytes for a name, and files add to it
  if (name.size() > longest)
    problems.push_back({"/name", fmt::format("has {} characters, and a folder's name may have {}; got {}",
                                             name.size(), longest, given_text(name))});
}

// Without a reference there is nothing to compare, and how to compare does not affect the result.
void settle_accuracy(Accuracy& accuracy, ConfigProblems& problems) {
  for (auto* list :
       {&accuracy.solver, &accuracy.solver_coarser, &accuracy.physical, &accuracy.physical_coarser})
    if (*list && (*list)->empty()) list->reset();
  const auto needs_base = [&](const char* name, const auto& coarser, const auto& base) {
    if (coarser && !base)
      problems.push_back({fmt::format("/accuracy/{}_coarser", name),
                          fmt::format("needs /accuracy/{}, a reference to make coarser", name)});
  };
  needs_base("solver", accuracy.solver_coarser, accuracy.solver);
  needs_base("physical", accuracy.physical_coarser, accuracy.physical);
  if (accuracy.start_from_end && accuracy.over_time)
    problems.push_back(
        {"/accuracy/start_from_end", "does not go with over_time: motions are compared from the same start"});
  if (accuracy.compares()) return;
  for (const auto& [how, chosen] :
       {std::pair{"over_time", accuracy.over_time}, {"start_from_end", accuracy.start_from_end}})
    if (chosen)
      problems.push_back(
          {fmt::format("/accuracy/{}", how),
           "has nothing to compare with: name a reference in /accuracy/solver or /accuracy/physical"});
  accuracy = Accuracy{};
}

// The object at that key of the top level; empty where there is none, or none that is an object.
const Json& section_in(const Json& top, const char* key, ConfigProblems& problems) {
  static const Json nothing = Json::object();
  const auto found = top.find(key);
  if (found == top.end()) return nothing;
  return is_object(*found, child_pointer("", key), problems) ? *found : nothing;
}

}  // namespace

RunSettings read_run(const Json& settings, ConfigProblems& problems) {
  RunSettings run;
  std::vector<std::string_view> own = names_of(run_table().fields);
  own.insert(own.end(), {"output", "accuracy", "quality"});
  for (const ConfigList& list : config_lists()) own.push_back(list.name);
  run.scene = read_scene(settings, own, problems);
  if (!settings.is_object()) return run;
  Json top = Json::object();
  for (const Field& field : run_table().fields)
    if (const auto found = settings.find(field.name); found != settings.end())
      top[std::string(field.name)] = *found;
  read_fields(run_table(), &run, top, "", {}, problems);
  if (settings.contains("name")) check_name(run.name, problems);
  read_fields(output_table(), &run.output, section_in(settings, "output", problems), "/output", {}, problems);
  read_fields(accuracy_table(), &run.accuracy, section_in(settings, "accuracy", problems), "/accuracy", {},
              problems);
  read_fields(quality_table(), &run.quality, section_in(settings, "quality", problems), "/quality", {},
              problems);
  settle_accuracy(run.accuracy, problems);
  return run;
}

Json to_json(const RunSettings& settings) {
  Json json = to_json(settings.scene);
  write_fields(run_table(), &settings, &settings, json);
  const auto write = [&](const char* key, const FieldTable& table, const void* owner) {
    write_fields(table, owner, &settings, json[key] = Json::object());
  };
  write("output", output_table(), &settings.output);
  write("accuracy", accuracy_table(), &settings.accuracy);
  write("quality", quality_table(), &settings.quality);
  return json;
}

}  // namespace bendlab
