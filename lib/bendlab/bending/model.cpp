#include "bendlab/bending/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "bendlab/bending/models.hpp"

namespace bendlab {

namespace {

Registry<BendingKind>& registry() {
  static Registry<BendingKind> all("bending model", listed_bending_models);
  return all;
}

}  // namespace

std::span<const BendingKind* const> bending_models() {
  return registry().all();
}

const BendingKind* find_bending_model(std::string_view name) {
  return registry().find(name);
}

std::optional<std::string> unknown_to_k(const BendingKind& model, const BendingConstraints& constraints) {
  if (model.softness_needs_compliance) return std::nullopt;
  double least = 1, most = 1;
  const auto include = [&](const std::vector<double>& softness) {
    for (const double value : softness) least = std::min(least, value), most = std::max(most, value);
  };
  include(constraints.distance.softness);
  for_each_kind(constraints.elements, [&](const auto& list) { include(list.softness); });
  include(constraints.own.softness);
  if (least == 1 && most == 1) return std::nullopt;
  return fmt::format(
      "the constraints of '{}' are {:.3g} to {:.3g} times as soft as the scene's compliance, but k would "
      "correct all of them by the same share: state \"compliance\" or a flexural_rigidity instead of k. If "
      "the model should ignore softness with k, set .softness_needs_compliance = true in the model",
      model.name, least, most);
}

std::vector<std::string_view> models_of_hinges() {
  std::vector<std::string_view> names;
  for (const BendingKind* model : bending_models())
    if (is_made_of_hinges(*model)) names.push_back(model->name);
  return names;
}

void register_bending_model(const BendingKind& model) {
  if (model.build == nullptr)
    throw std::invalid_argument(
        fmt::format("the bending model '{}' cannot be registered: it has no build()", model.name));
  registry().add(model);
}

void remove_bending_model(std::string_view name) {
  registry().remove(name);
}

std::span<const BendingKind* const> added_bending_models() {
  return registry().added();
}

}  // namespace bendlab
