#include "bendlab/settings/family.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace bendlab::detail {

void check_new_name(std::string_view family, std::string_view name, std::span<const std::string_view> taken) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  if (name.empty() || !std::ranges::all_of(name, allowed))
    throw std::invalid_argument(
        fmt::format("the {} '{}' cannot be registered: a name must have at least one character, and only "
                    "letters (a-z, A-Z), digits, '_' and '-'",
                    family, name));
  if (std::ranges::find(taken, name) != taken.end())
    throw std::invalid_argument(
        fmt::format("the {} '{}' cannot be registered: this name already exists; choose a name other than {}",
                    family, name, fmt::join(taken, ", ")));
}

}  // namespace bendlab::detail
