#include "bendlab/settings/field.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

namespace bendlab {

std::string detail::name_of_choice(const Field& field, std::size_t index) {
  return std::string(field.choices[index]);
}

std::size_t detail::index_of_choice(const Field& field, const std::string& name) {
  const auto choice = std::ranges::find(field.choices, name);
  if (choice == field.choices.end())
    throw std::invalid_argument(
        fmt::format("{}: '{}' is not one of {}", field.name, name, fmt::join(field.choices, ", ")));
  return static_cast<std::size_t>(choice - field.choices.begin());
}

const Field* FieldTable::find(std::string_view name) const {
  const auto row = std::ranges::find(fields, name, &Field::name);
  return row == fields.end() ? nullptr : &*row;
}

}  // namespace bendlab
