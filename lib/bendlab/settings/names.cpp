#include "bendlab/settings/names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

namespace bendlab::detail {

void throw_unknown_name(std::string_view name, std::span<const std::string_view> names) {
  throw std::invalid_argument(fmt::format("'{}' is not one of {}", name, fmt::join(names, ", ")));
}

}  // namespace bendlab::detail
