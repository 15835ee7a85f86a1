#include "experiments/advise/variant.hpp"

#include <fmt/format.h>

#include "bendlab/constraints/batches.hpp"

namespace bendlab {

std::vector<Variant> neighbours(const Variant& variant, const VariantChoices& choices) {
  constexpr double limit = 0.25;  // the remedy that the program's warnings name (run/remedies.cpp)
  std::vector<Variant> found;
  const auto with = [&](auto member, auto value) {
    if (variant.*member == value) return;
    found.push_back(variant);
    found.back().*member = value;
  };
  if (choices.tethers) with(&Variant::tethers, !variant.tethers);
  for (const std::string_view form : strain_form_names) with(&Variant::shear, std::string(form));
  with(&Variant::flight_limit, variant.flight_limit > 0 ? 0 : limit);
  for (const double radius : choices.radii) with(&Variant::radius, radius);
  if (variant.radius > 0) with(&Variant::radius, 0.0);
  return found;
}

std::string variant_text(const Variant& variant) {
  std::string text = variant.tethers ? "tethers, " : "";
  text += variant.shear + " shear";
  if (variant.flight_limit > 0) text += fmt::format(", moves limited to {:.3g}", variant.flight_limit);
  if (variant.radius > 0) text += fmt::format(", springs of {:.3g} m", variant.radius);
  return text;
}

}  // namespace bendlab
