// Converts between texts and enumerators. Each enumeration has an array of names in the same order.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>
#include <type_traits>

namespace bendlab {

namespace detail {
[[noreturn]] void throw_unknown_name(std::string_view name, std::span<const std::string_view> names);
}

/// The enumerator with that name. Throws std::invalid_argument with a list of the known names.
template <class Enum>
requires std::is_enum_v<Enum> Enum named(std::string_view name, std::span<const std::string_view> names) {
  const auto place = std::ranges::find(names, name);
  if (place == names.end()) detail::throw_unknown_name(name, names);
  return static_cast<Enum>(place - names.begin());
}

/// The name of an enumerator.
template <class Enum>
requires std::is_enum_v<Enum>
constexpr std::string_view name_in(std::span<const std::string_view> names, Enum value) {
  return names[static_cast<std::size_t>(value)];
}

}  // namespace bendlab
