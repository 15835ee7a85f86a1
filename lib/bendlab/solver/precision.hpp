// The floating-point numbers that a simulation uses.
#pragma once

#include <array>
#include <string_view>

namespace bendlab {

enum class Precision { single_precision, double_precision };
inline constexpr std::array<std::string_view, 2> precision_names = {"single", "double"};

}  // namespace bendlab
