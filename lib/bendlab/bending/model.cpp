#include "bendlab/bending/model.hpp"

#include <algorithm>
#include <array>

namespace bendlab {

namespace models {
#define BENDLAB_BENDING_MODEL(name) extern const BendingModel name;
#include "bendlab/bending/models.def"
#undef BENDLAB_BENDING_MODEL
}  // namespace models

std::span<const BendingModel* const> bending_models() {
  static constexpr std::array all = {
#define BENDLAB_BENDING_MODEL(name) &models::name,
#include "bendlab/bending/models.def"
#undef BENDLAB_BENDING_MODEL
  };
  return all;
}

const BendingModel* find_bending_model(std::string_view name) {
  const auto all = bending_models();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const BendingModel* m) { return m->name == name; });
  return found == all.end() ? nullptr : *found;
}

}  // namespace bendlab
