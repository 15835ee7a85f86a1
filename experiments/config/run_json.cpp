#include "experiments/config/run_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "bendlab/scene/fields_json.hpp"
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
  constexpr std::size_t longest = 100;  // a file system allows 255 bytes, and names of files add to it
  if (name.size() > longest)
    problems.push_back(
        {"/name", fmt::format("has {} characters, but a folder's name may have at most {}; got {}",
                              name.size(), longest, given_text(name))});
}

// Checks /accuracy, and resets it if there is no reference, because it then does not affect the result.
void settle_accuracy(Accuracy& accuracy, ConfigProblems& problems) {
  for (auto* list :
       {&accuracy.solver, &accuracy.solver_coarser, &accuracy.physical, &accuracy.physical_coarser})
    if (*list && (*list)->empty()) list->reset();
  const auto needs_base = [&](const char* name, const auto& coarser, const auto& base) {
    if (coarser && !base)
      problems.push_back({fmt::format("/accuracy/{}_coarser", name),
                          fmt::format("needs a reference in /accuracy/{}, to which the changes for the "
                                      "coarser reference are applied",
                                      name)});
  };
  needs_base("solver", accuracy.solver_coarser, accuracy.solver);
  needs_base("physical", accuracy.physical_coarser, accuracy.physical);
  if (accuracy.start_from_end && accuracy.over_time)
    problems.push_back(
        {"/accuracy/start_from_end",
         "cannot be combined with over_time, because motions can be compared only from the same start"});
  if (accuracy.compares()) return;
  for (const auto& [how, chosen] :
       {std::pair{"over_time", accuracy.over_time}, {"start_from_end", accuracy.start_from_end}})
    if (chosen)
      problems.push_back(
          {fmt::format("/accuracy/{}", how),
           "has nothing to compare with: name a reference in /accuracy/solver or /accuracy/physical"});
  accuracy = Accuracy{};
}

// The JSON object of a part of the settings, or {}. For the top level, only the run's own settings.
Json object_of(const RunPart& part, const Json& top, ConfigProblems& problems) {
  Json object = Json::object();
  if (!part.pointer.empty()) {
    const auto found = top.find(part.pointer.substr(1));
    return found != top.end() && is_object(*found, std::string(part.pointer), problems) ? *found : object;
  }
  for (const Field& field : part.table.fields)
    if (const auto found = top.find(field.name); found != top.end()) object[std::string(field.name)] = *found;
  return object;
}

}  // namespace

RunSettings read_run(const Json& settings, ConfigProblems& problems) {
  RunSettings run;
  std::vector<std::string_view> own = names_of(run_parts().front().table.fields);
  for (const RunPart& part : run_parts().subspan(1)) own.push_back(part.pointer.substr(1));
  for (const ConfigList& list : config_lists()) own.push_back(list.name);
  run.scene = read_scene(settings, own, problems);
  if (!settings.is_object()) return run;
  for (const RunPart& part : run_parts())
    read_fields(part.table, const_cast<void*>(part.in(run)), object_of(part, settings, problems),
                std::string(part.pointer), {}, problems);
  if (settings.contains("name")) check_name(run.name, problems);
  settle_accuracy(run.accuracy, problems);
  return run;
}

ConfigProblems check_value(const Json& settings, const std::string& pointer, const Json& value,
                           const std::string& place, ConfigProblems& problems) {
  Json with_value = settings;
  ConfigProblems found, other_problems;
  if (!set_at(with_value, pointer, value))
    return other_problems;  // this problem of the settings is reported elsewhere
  read_run(with_value, found);
  for (const ConfigProblem& problem : found)
    if (lies_within(problem.pointer, pointer))
      problems.push_back({place + problem.pointer.substr(pointer.size()), problem.message});
    else
      other_problems.push_back(problem);
  return other_problems;
}

Json to_json(const RunSettings& settings) {
  Json json = to_json(settings.scene);
  for (const RunPart& part : run_parts()) {
    Json& object = json[Json::json_pointer(std::string(part.pointer))];
    if (object.is_null()) object = Json::object();
    write_fields(part.table, part.in(settings), &settings, object);
  }
  return json;
}

}  // namespace bendlab
