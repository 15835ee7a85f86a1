#include "bendlab/effects/effect.hpp"

#include <algorithm>
#include <array>

// A build may leave effects out by naming another list.
#ifndef BENDLAB_EFFECTS
#define BENDLAB_EFFECTS "bendlab/effects/effects.def"
#endif

namespace bendlab {

namespace effect {
#define BENDLAB_EFFECT(name) extern const Effect name;
#include BENDLAB_EFFECTS
#undef BENDLAB_EFFECT
}  // namespace effect

std::span<const Effect* const> effects() {
  static constexpr std::array all = {
#define BENDLAB_EFFECT(name) &effect::name,
#include BENDLAB_EFFECTS
#undef BENDLAB_EFFECT
  };
  return all;
}

const Effect* find_effect(std::string_view name) {
  const auto all = effects();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Effect* e) { return e->name == name; });
  return found == all.end() ? nullptr : *found;
}

}  // namespace bendlab
