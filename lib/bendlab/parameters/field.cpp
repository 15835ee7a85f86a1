#include "bendlab/parameters/field.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

namespace bendlab {

std::string detail::name_of_choice(const Field& field, std::size_t index) {
  return std::string(field.choices[index]);
}

std::size_t detail::index_of_choice(const Field& field, const std::string& name) {
  const auto found = std::ranges::find(field.choices, name);
  if (found == field.choices.end())
    throw std::invalid_argument(
        fmt::format("{}: '{}' is none of {}", field.name, name, fmt::join(field.choices, ", ")));
  return static_cast<std::size_t>(found - field.choices.begin());
}

const Field* FieldTable::find(std::string_view name) const {
  const auto found = std::ranges::find(fields, name, &Field::name);
  return found == fields.end() ? nullptr : &*found;
}

}  // namespace bendlab
