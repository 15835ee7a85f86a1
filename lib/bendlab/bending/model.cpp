#include "bendlab/bending/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "bendlab/parameters/registry.hpp"

namespace bendlab {

namespace models {
#define BENDLAB_BENDING_MODEL(name) extern const BendingModel name;
#include "bendlab/bending/models.def"
#undef BENDLAB_BENDING_MODEL
}  // namespace models

namespace {

constexpr std::array listed = {
#define BENDLAB_BENDING_MODEL(name) &models::name,
#include "bendlab/bending/models.def"
#undef BENDLAB_BENDING_MODEL
};

Registry<const BendingModel*>& registry() {
  static Registry<const BendingModel*> all("bending model", listed);
  return all;
}

}  // namespace

std::span<const BendingModel* const> bending_models() {
  return registry().rows();
}

const BendingModel* find_bending_model(std::string_view name) {
  const auto all = bending_models();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const BendingModel* m) { return m->name == name; });
  return found == all.end() ? nullptr : *found;
}

std::optional<std::string> unknown_to_k(const BendingModel& model, const BendingConstraints& constraints) {
  if (model.softness_needs_compliance) return std::nullopt;
  double least = 1, most = 1;
  const auto look_at = [&](const std::vector<double>& softness) {
    for (const double each : softness) least = std::min(least, each), most = std::max(most, each);
  };
  look_at(constraints.distance.softness);
  for_each_kind(constraints.elements, [&](const auto& list) { look_at(list.softness); });
  if (least == 1 && most == 1) return std::nullopt;
  return fmt::format(
      "'{}' makes its constraints {:.3g} to {:.3g} times as soft as the scene's compliance, and k would "
      "correct all by the same share: state \"compliance\" instead, or a flexural_rigidity; if the model is "
      "meant to be the same with k, it says .softness_needs_compliance = true",
      model.name, least, most);
}

std::vector<std::string_view> models_of_hinges() {
  std::vector<std::string_view> names;
  for (const BendingModel* model : bending_models())
    if (is_made_of_hinges(*model)) names.push_back(model->name);
  return names;
}

void register_bending_model(const BendingModel& model) {
  if (model.build == nullptr)
    throw std::invalid_argument(
        fmt::format("the bending model '{}' cannot be registered: it has no build()", model.name));
  registry().add(&model);
}

std::span<const BendingModel* const> added_bending_models() {
  return registry().added();
}

}  // namespace bendlab
