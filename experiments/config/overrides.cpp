#include "experiments/config/overrides.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "bendlab/scene/scene_tables.hpp"
#include "experiments/config/settings_by_pointer.hpp"

namespace bendlab {
namespace {

bool is_list_setting(const Json& document, const std::string& pointer) {
  const Field* row = find_setting(document, pointer);
  return pointer == "/effects" ||
         (row != nullptr && (row->type == FieldType::numbers || row->type == FieldType::integers ||
                             row->type == FieldType::texts));
}

Json read_override_value(const Json& document, const std::string& pointer, const std::string& text) {
  ConfigProblems not_json;
  const std::optional<Json> value = read_strict_json(text, not_json);
  if (!not_json.empty()) return text;
  const Field* row = find_setting(document, pointer);
  const bool is_text = row != nullptr && row->type == FieldType::text;
  return is_text && (value->is_number() || value->is_boolean()) ? Json(text) : *value;
}

// Whether `value`, given for a swept pointer, is a list of values for the axis rather than one value.
bool is_axis(const Json& value, bool list_setting) {
  if (!value.is_array()) return false;
  return !list_setting ||
         (!value.empty() && std::ranges::all_of(value, [](const Json& entry) { return entry.is_array(); }));
}

// Sets a value at the pointer `rest` in every object of a swept axis. False if this is impossible.
bool set_inside_axis(Json& values, const std::string& rest, const Json& value) {
  return values.is_array() &&
         std::ranges::all_of(values, [&](Json& entry) { return set_at(entry, rest, value); });
}

// Applies an override. Returns the problem, or "".
std::string apply(Json& document, const std::string& pointer, const std::string& text) {
  const std::vector<std::string> known = known_pointers(document);
  const auto free_places = {"/name", "/description", "/sweep", "/cover", "/expect"};
  const bool is_free =
      std::ranges::any_of(free_places, [&](const char* p) { return lies_within(pointer, p); });
  Json value = read_override_value(document, pointer, text);
  if (!is_free && document.contains("sweep") && document["sweep"].is_object()) {
    // An axis of the setting itself comes first, because another axis may sweep the object that contains the
    // setting.
    if (const auto axis = document["sweep"].find(pointer); axis != document["sweep"].end()) {
      *axis = is_axis(value, is_list_setting(document, pointer)) ? value : Json::array({value});
      return "";
    }
    for (auto& [swept, values] : document["sweep"].items())
      if (lies_within(pointer, swept))
        return set_inside_axis(values, pointer.substr(swept.size()), value)
                   ? ""
                   : fmt::format("not every swept value of '{}' is an object that can hold this setting",
                                 swept);
  }
  if (!is_free && std::ranges::find(known, pointer) == known.end())
    return unknown_pointer_text(pointer, known);
  return set_at(document, pointer, std::move(value)) ? ""
                                                     : "the config has no object that can hold this setting";
}

bool lies_in_an_axis(const Json& document, std::string_view pointer) {
  if (!document.contains("sweep") || !document["sweep"].is_object()) return false;
  return std::ranges::any_of(document["sweep"].items(),
                             [&](const auto& axis) { return lies_within(pointer, axis.key()); });
}

// Why nothing reads the value of an override; "" if the value is read or null. A config may state values for
// kinds of stiffness that are not chosen. But an override with such a value is most likely a mistake.
std::string unread_text(const Json& document, const std::string& pointer) {
  const Field* const field = find_setting(document, pointer);
  if (field == nullptr || !field->depends_on.ends_with("/stiffness") ||
      lies_in_an_axis(document, field->depends_on))
    return "";
  const Json* const value = value_at(document, pointer);
  const Json* const kind = value_at(document, std::string(field->depends_on));
  if (value == nullptr || value->is_null() || kind == nullptr || !kind->is_string()) return "";
  const std::vector<std::string_view> readers = choices_that_read(*field);
  const auto& name = kind->get_ref<const std::string&>();
  if (std::ranges::find(readers, name) != readers.end()) return "";
  return fmt::format("has no effect, because {} is {}; the setting is read only with {}", field->depends_on,
                     name, fmt::join(readers, " or "));
}

}  // namespace

std::string sweep_override(const std::string& axis) {
  const std::size_t equals = axis.find('=');
  if (equals == std::string::npos || !axis.starts_with('/'))
    throw std::invalid_argument(fmt::format("'{}' is not of the form /json/pointer=value,value", axis));
  const std::string text = axis.substr(equals + 1);
  ConfigProblems not_json;
  std::optional<Json> values = read_strict_json("[" + text + "]", not_json);
  if (!values || !not_json.empty()) {
    values = Json::array();
    for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
      end = text.find(',', begin);
      values->push_back(text.substr(begin, end == std::string::npos ? end : end - begin));
    }
  }
  if (*values == Json::array({"all"})) values = "all";  // every choice of the setting
  return fmt::format("{}={}", child_pointer("/sweep", axis.substr(0, equals)), values->dump());
}

void apply_overrides(Json& document, std::span<const std::string> overrides, ConfigProblems& problems) {
  std::vector<std::string> pointers;
  for (const std::string& override_text : overrides) {
    const std::size_t equals = override_text.find('=');
    const std::string pointer = override_text.substr(0, equals);
    if (equals == std::string::npos || !pointer.starts_with('/')) {
      problems.push_back(
          {"", fmt::format("override '{}' is not of the form /json/pointer=value", override_text)});
      continue;
    }
    const auto clashes = [&](const std::string& other) {
      return pointer.starts_with("/sweep/") ? other == pointer || child_pointer("/sweep", other) == pointer
                                            : other == child_pointer("/sweep", pointer);
    };
    if (std::ranges::any_of(pointers, clashes))
      problems.push_back(
          {pointer,
           fmt::format("override '{}': another override sets or sweeps the same setting; keep one of the two",
                       override_text)});
    pointers.push_back(pointer);
    try {
      const std::string wrong = apply(document, pointer, override_text.substr(equals + 1));
      if (!wrong.empty())
        problems.push_back({pointer, fmt::format("override '{}': {}", override_text, wrong)});
    } catch (const Json::parse_error&) {  // thrown where a '~' in the pointer is neither ~0 nor ~1
      problems.push_back(
          {"", fmt::format("override '{}': the part before '=' is no JSON pointer", override_text)});
      pointers.pop_back();
    }
  }
  for (const std::string& pointer : pointers)
    if (const std::string wrong = unread_text(document, pointer); !wrong.empty())
      problems.push_back({pointer, wrong});
}

}  // namespace bendlab
