#include "bendlab/parameters/parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace bendlab {
namespace {

// Where the name is among the sorted values, or would be.
auto place_of(auto& values, std::string_view name) {
  return std::ranges::lower_bound(values, name, {}, [](const auto& each) -> std::string_view {
    return each.first;
  });
}

}  // namespace

Value default_of(const Parameter& parameter) {
  const Default& value = parameter.default_value;
  switch (value.kind) {
    case Default::Kind::none:
      return std::monostate{};
    case Default::Kind::boolean:
      return value.boolean;
    case Default::Kind::integer:
      return value.integer;
    case Default::Kind::number:
      return value.number;
    case Default::Kind::text:
      return std::string(value.text);
    case Default::Kind::numbers:
      return std::vector<double>(value.numbers.begin(), value.numbers.end());
    case Default::Kind::texts:
      return std::vector<std::string>(value.texts.begin(), value.texts.end());
  }
  throw std::logic_error("default_of: unknown kind");
}

ParameterValues::ParameterValues(std::span<const Parameter> table) {
  values_.reserve(table.size());
  for (const Parameter& parameter : table) set(parameter.name, default_of(parameter));
}

void ParameterValues::set(std::string_view name, Value value) {
  const auto place = place_of(values_, name);
  if (place != values_.end() && place->first == name)
    place->second = std::move(value);
  else
    values_.emplace(place, name, std::move(value));
}

bool ParameterValues::has(std::string_view name) const {
  const auto found = place_of(values_, name);
  return found != values_.end() && found->first == name &&
         !std::holds_alternative<std::monostate>(found->second);
}

const Value& ParameterValues::value(std::string_view name) const {
  const auto found = place_of(values_, name);
  if (found == values_.end() || found->first != name)
    throw std::logic_error(fmt::format("there is no parameter '{}'", name));
  return found->second;
}

namespace {
template <class T>
const T& get(const Value& value, std::string_view name) {
  if (const T* typed = std::get_if<T>(&value)) return *typed;
  throw std::logic_error(fmt::format("parameter '{}' is read as a type it does not have", name));
}
}  // namespace

bool ParameterValues::boolean(std::string_view name) const {
  return get<bool>(value(name), name);
}

std::int64_t ParameterValues::integer(std::string_view name) const {
  return get<std::int64_t>(value(name), name);
}

double ParameterValues::number(std::string_view name) const {
  const Value& found = value(name);
  if (const auto* whole = std::get_if<std::int64_t>(&found)) return static_cast<double>(*whole);
  return get<double>(found, name);
}

const std::string& ParameterValues::text(std::string_view name) const {
  return get<std::string>(value(name), name);
}

const std::vector<double>& ParameterValues::numbers(std::string_view name) const {
  return get<std::vector<double>>(value(name), name);
}

const std::vector<std::string>& ParameterValues::texts(std::string_view name) const {
  return get<std::vector<std::string>>(value(name), name);
}

}  // namespace bendlab
