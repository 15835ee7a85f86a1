// What a setting may change about a scene besides its model and its work: remedies that leave the stated
// cloth as it is.
#pragma once

#include <compare>
#include <string>
#include <vector>

namespace bendlab {

struct Variant {
  bool tethers = false;         ///< no vertex gets farther from a pin than the cloth between them is long
  std::string shear = "angle";  ///< /material/strain/form
  double flight_limit = 0;      ///< /solver/flight_limit; 0: none
  double radius = 0;            ///< of the model's springs, m; 0: as the config has it

  auto operator<=>(const Variant&) const = default;
};

/// What a scene lets vary.
struct VariantChoices {
  bool tethers = false;         ///< whether there is something that tethers may hang on, or not
  std::vector<double> radii{};  ///< m; none for models without a radius
};

/// Every variant that differs in one thing.
std::vector<Variant> neighbours(const Variant& variant, const VariantChoices& choices);

/// "tethers, angle shear, moves limited to 0.25, springs of 0.03 m".
std::string variant_text(const Variant& variant);

}  // namespace bendlab
