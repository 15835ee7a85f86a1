// What the number that states a stiffness means.
#pragma once

#include <array>
#include <cmath>
#include <string_view>

namespace bendlab {

enum class StiffnessKind {
  k,           ///< plain PBD: every projection removes the fraction k (depends on iterations)
  k_per_step,  ///< k' = 1 - (1 - k)^(1/n), n projections per substep (Müller et al. 2007, §3.3)
  compliance,  ///< XPBD (Macklin et al. 2016): inverse stiffness, α̃ = α / h²
};
inline constexpr std::array<std::string_view, 3> stiffness_kind_names = {"k", "k_per_step", "compliance"};

/// The fraction of C that one projection removes. With k_per_step, `projections` of them leave 1 - k of C.
inline double k_of_projection(StiffnessKind kind, double k, int projections) {
  return kind == StiffnessKind::k_per_step ? 1 - std::pow(1 - k, 1.0 / projections) : k;
}

}  // namespace bendlab
