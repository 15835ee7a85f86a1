// A count with its noun, for messages.
#pragma once

#include <fmt/format.h>

#include <concepts>
#include <string>
#include <string_view>

namespace bendlab {

/// For example "1 run", "2 runs" or "0 runs". An s is added if the count is not 1.
std::string counted(std::integral auto count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace bendlab
