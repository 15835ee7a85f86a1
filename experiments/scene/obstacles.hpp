// Which effects are bodies that cloth may lie on.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace bendlab {

inline bool is_obstacle(std::string_view effect_type) {
  constexpr std::array<std::string_view, 5> obstacles = {"plane", "sphere", "capsule", "disc",
                                                         "mesh_obstacle"};
  return std::ranges::find(obstacles, effect_type) != obstacles.end();
}

}  // namespace bendlab
