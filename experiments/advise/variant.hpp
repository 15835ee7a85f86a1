// What a setting may change about a scene besides its model and its work: the solver's method, and remedies
// that leave the stated cloth as it is.
#pragma once

#include <compare>
#include <string>
#include <string_view>
#include <vector>

namespace bendlab {

struct Variant {
  bool tethers = false;         ///< no vertex gets farther from a pin than the cloth between them is long
  std::string shear = "angle";  ///< /material/strain/form
  double flight_limit = 0;      ///< /solver/flight_limit; 0: none
  double radius = 0;            ///< of the model's springs, m; 0: as the config has it
  std::string method = "pbd";   ///< /solver/method
  bool softened = false;        ///< /solver/membrane of quasi_newton: auto; else stated
  bool second_order = false;    ///< /solver/integrator of quasi_newton: bdf2; else euler

  auto operator<=>(const Variant&) const = default;
};

/// What a scene lets vary.
struct VariantChoices {
  bool tethers = false;         ///< whether there is something that tethers may hang on, or not
  std::vector<double> radii{};  ///< m; none for models without a radius
  std::vector<std::string> methods{};
};

/// Whether a method's membrane and its integrator vary: of quasi_newton.
bool softens(std::string_view method);

/// The variant in that method, without what the method does not have: only one that projects has tethers and
/// a limit on moves, only quasi_newton softens a membrane.
Variant in_method(Variant variant, std::string_view method, bool softened = false);

/// Every variant that differs in one thing; one in another method has the tethers that may be.
std::vector<Variant> neighbours(const Variant& variant, const VariantChoices& choices);

/// "tethers, angle shear, moves limited to 0.25, springs of 0.03 m", "softened membrane, angle shear".
std::string variant_text(const Variant& variant);

}  // namespace bendlab
