#include "bendlab/effects/effect.hpp"

#include "bendlab/effects/effects.hpp"

namespace bendlab {
namespace {

// If a build leaves effects out, BENDLAB_EFFECTS lists the remaining effects.
#ifdef BENDLAB_EFFECTS
constexpr auto listed = listed_kinds<EffectKind, BENDLAB_EFFECTS>;
#else
constexpr auto listed = listed_effects;
#endif

Registry<EffectKind>& registry() {
  static Registry<EffectKind> all("effect", listed);
  return all;
}

}  // namespace

std::span<const EffectKind* const> effects() {
  return registry().all();
}

const EffectKind* find_effect(std::string_view name) {
  return registry().find(name);
}

void register_effect(const EffectKind& kind) {
  registry().add(kind);
}

void remove_effect(std::string_view name) {
  registry().remove(name);
}

std::span<const EffectKind* const> added_effects() {
  return registry().added();
}

}  // namespace bendlab
