#include "bendlab/scene/fields_json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bendlab/scene/nearest_name.hpp"
#include "bendlab/scene/pointers.hpp"
#include "bendlab/scene/scene_tables.hpp"

namespace bendlab {
namespace {

std::string range_text(const Field& row) {
  const bool low = std::isfinite(row.minimum), high = std::isfinite(row.maximum);
  if (low && high && !row.above) return fmt::format(" from {} to {}", row.minimum, row.maximum);
  const std::string least =
      low ? fmt::format(" {} {}", row.above ? "above" : "of at least", row.minimum) : "";
  const std::string most = high ? fmt::format(" of at most {}", row.maximum) : "";
  return least + (low && high ? " and" : "") + most;
}

// Reads the values of a row. Values with a wrong type or range are reported, and nothing is returned.
class Reader {
 public:
  Reader(const Field& row, ConfigProblems& problems) : row_(row), problems_(problems) {}

  std::optional<Value> read(const Json& given, const std::string& pointer) {
    if (given.is_null() && row_.optional) return std::monostate{};
    switch (row_.type) {
      case FieldType::boolean:
        return read_boolean(given, pointer);
      case FieldType::integer:
        return read_integer(given, pointer);
      case FieldType::number:
        return read_number(given, pointer);
      case FieldType::text:
        return read_text(given, pointer);
      case FieldType::integers:
        return read_list<std::int64_t>(given, pointer, FieldType::integer);
      case FieldType::numbers:
        return read_list<double>(given, pointer, FieldType::number);
      case FieldType::texts:
        return read_list<std::string>(given, pointer, FieldType::text);
    }
    throw std::logic_error("read_value: unknown type");
  }

 private:
  std::nullopt_t wrong(const Json& given, const std::string& pointer, const std::string& hint = "") {
    const std::string unit = row_.unit.empty() || row_.unit == "1" ? "" : fmt::format(" (in {})", row_.unit);
    problems_.push_back({pointer, fmt::format("expected {}{}, got {}{}", expected_text(row_), unit,
                                              given_text(given), hint)});
    return std::nullopt;
  }

  bool in_range(double value) const {
    return std::isfinite(value) && (row_.above ? value > row_.minimum : value >= row_.minimum) &&
           value <= row_.maximum;
  }

  std::optional<Value> read_boolean(const Json& given, const std::string& pointer) {
    if (!given.is_boolean()) return wrong(given, pointer);
    return given.get<bool>();
  }

  std::optional<Value> read_number(const Json& given, const std::string& pointer) {
    if (!given.is_number() || !in_range(given.get<double>())) return wrong(given, pointer);
    return given.get<double>() + 0.0;  // -0 and 0 are the same setting
  }

  std::optional<Value> read_integer(const Json& given, const std::string& pointer) {
    constexpr double largest = 9007199254740992;  // 2⁵³: whole numbers up to this limit are exact
    if (!given.is_number()) return wrong(given, pointer);
    const double value = given.get<double>();
    if (!in_range(value) || std::abs(value) >= largest || value != std::floor(value))
      return wrong(given, pointer);
    return static_cast<std::int64_t>(value);
  }

  std::optional<Value> read_text(const Json& given, const std::string& pointer) {
    if (!given.is_string()) return wrong(given, pointer);
    std::string value = given.get<std::string>();
    const bool must_say_something = row_.choices.empty() && (row_.optional || row_.required);
    if (must_say_something && value.empty()) return wrong(given, pointer, "; it must not be empty");
    if (!row_.choices.empty() && std::ranges::find(row_.choices, value) == row_.choices.end())
      return wrong(given, pointer, suggestion(value, row_.choices));
    return value;
  }

  template <class Entry>
  std::optional<Value> read_list(const Json& given, const std::string& pointer, FieldType entry_type) {
    if (!given.is_array() || (row_.length != 0 && given.size() != row_.length)) return wrong(given, pointer);
    Field entry_row = row_;
    entry_row.type = entry_type;
    entry_row.optional = false;  // no null among the entries
    entry_row.required = true;
    Reader reader(entry_row, problems_);
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < given.size(); ++i)
      if (std::optional<Value> entry = reader.read(given[i], child_pointer(pointer, std::to_string(i))))
        entries.push_back(std::get<Entry>(*std::move(entry)));
    return entries.size() == given.size() ? std::optional<Value>(std::move(entries)) : std::nullopt;
  }

  const Field& row_;
  ConfigProblems& problems_;
};

// If another section has a setting with that name, suggests that setting.
std::string setting_elsewhere(std::string_view key) {
  for (const Section& section : scene_sections())
    for (const SettingRow& row : section.rows)
      if (row.field.name == key)
        return fmt::format("; did you mean '{}'?", child_pointer(section.pointer, key));
  return "";
}

void report_unknown_key(const std::string& key, const std::string& pointer,
                        std::span<const std::string_view> allowed, ConfigProblems& problems) {
  std::string near = suggestion(key, allowed);
  if (near.empty()) near = setting_elsewhere(key);
  const std::string list = allowed.empty() ? "nothing" : fmt::format("{}", fmt::join(allowed, ", "));
  problems.push_back(
      {child_pointer(pointer, key), fmt::format("there is no setting '{}' here{} Allowed here: {}", key,
                                                near.empty() ? "." : near, list)});
}

}  // namespace

std::string expected_text(const Field& row) {
  const std::string choices = fmt::format("one of {}", fmt::join(row.choices, ", "));
  const std::string length = row.length == 0 ? "" : fmt::format("{} ", row.length);
  switch (row.type) {
    case FieldType::boolean:
      return "true or false";
    case FieldType::integer:
      return "a whole number" + range_text(row);
    case FieldType::number:
      return "a number" + range_text(row);
    case FieldType::text:
      return row.choices.empty() ? "a text" : choices;
    case FieldType::integers:
      return "a list of whole numbers" + range_text(row);
    case FieldType::numbers:
      return fmt::format("a list of {}numbers{}", length, range_text(row));
    case FieldType::texts:
      return fmt::format("a list of {}texts{}", length, row.choices.empty() ? "" : ", each " + choices);
  }
  throw std::logic_error("expected_text: unknown type");
}

std::optional<Value> read_value(const Field& field, const Json& given, const std::string& pointer,
                                ConfigProblems& problems) {
  return Reader(field, problems).read(given, pointer);
}

Json json_of(const Value& value) {
  return std::visit(
      [](const auto& typed) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(typed)>, std::monostate>)
          return nullptr;
        else
          return typed;
      },
      value);
}

void read_fields(const FieldTable& table, void* owner, const Json& given, const std::string& pointer,
                 std::span<const std::string_view> other_keys, ConfigProblems& problems) {
  std::vector<std::string_view> allowed = names_of(table.fields);
  allowed.insert(allowed.end(), other_keys.begin(), other_keys.end());
  for (const auto& [key, value] : given.items())
    if (std::ranges::find(allowed, key) == allowed.end()) report_unknown_key(key, pointer, allowed, problems);
  for (const Field& field : table.fields) {
    const auto entry = given.find(field.name);
    const std::string place = child_pointer(pointer, field.name);
    if (entry == given.end()) {
      if (field.required)
        problems.push_back({place, fmt::format("is missing: expected {}", expected_text(field))});
      continue;
    }
    const std::optional<Value> value = read_value(field, *entry, place, problems);
    if (value && !std::holds_alternative<std::monostate>(*value)) field.put(owner, *value);
  }
}

void write_fields(const FieldTable& table, const void* owner, const void* scene, Json& json) {
  for (const Field& field : table.fields) {
    if (!field.is_kept(scene)) continue;
    Json value = json_of(field.of(owner));
    if (!value.is_null()) json[std::string(field.name)] = std::move(value);
  }
}

std::vector<std::string_view> names_of(std::span<const Field> fields) {
  std::vector<std::string_view> names;
  for (const Field& field : fields) names.push_back(field.name);
  return names;
}

bool is_object(const Json& given, const std::string& pointer, ConfigProblems& problems) {
  if (!given.is_object()) problems.push_back({pointer, "expected an object {…}, got " + given_text(given)});
  return given.is_object();
}

}  // namespace bendlab
