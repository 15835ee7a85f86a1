#include "experiments/advise/variant.hpp"

#include <fmt/format.h>

#include "bendlab/constraints/batches.hpp"
#include "bendlab/solver/method.hpp"

namespace bendlab {

bool softens(std::string_view method) {
  return find_method(method)->reads("membrane");
}

Variant in_method(Variant variant, std::string_view method, bool softened) {
  variant.method = method;
  variant.softened = softened && softens(method);
  variant.second_order &= softens(method);
  if (!find_method(method)->projects) variant.tethers = false, variant.flight_limit = 0;
  return variant;
}

std::vector<Variant> neighbours(const Variant& variant, const VariantChoices& choices) {
  constexpr double limit = 0.25;  // the remedy that the program's warnings name (run/remedies.cpp)
  std::vector<Variant> found;
  const auto with = [&](auto member, auto value) {
    if (variant.*member == value) return;
    found.push_back(variant);
    found.back().*member = value;
  };
  if (find_method(variant.method)->projects) {
    if (choices.tethers) with(&Variant::tethers, !variant.tethers);
    with(&Variant::flight_limit, variant.flight_limit > 0 ? 0 : limit);
  }
  if (softens(variant.method)) {
    with(&Variant::softened, !variant.softened);
    with(&Variant::second_order, !variant.second_order);
  }
  for (const std::string_view form : strain_form_names) with(&Variant::shear, std::string(form));
  for (const double radius : choices.radii) with(&Variant::radius, radius);
  if (variant.radius > 0) with(&Variant::radius, 0.0);
  Variant helped = variant;
  helped.tethers |= choices.tethers;
  for (const std::string& method : choices.methods)
    if (method != variant.method) {
      found.push_back(in_method(helped, method));
      if (softens(method)) found.push_back(in_method(helped, method, true));
    }
  return found;
}

std::string variant_text(const Variant& variant) {
  std::string text = variant.tethers ? "tethers, " : variant.softened ? "softened membrane, " : "";
  text += variant.shear + " shear";
  if (variant.second_order) text += ", bdf2";
  if (variant.flight_limit > 0) text += fmt::format(", moves limited to {:.3g}", variant.flight_limit);
  if (variant.radius > 0) text += fmt::format(", springs of {:.3g} m", variant.radius);
  return text;
}

}  // namespace bendlab
