// Which kind of stiffness uses which number.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace bendlab {

/// A number that only some kinds of stiffness use.
struct StiffnessSetting {
  std::string_view pointer, stiffness;    ///< of the number, and of the kind of stiffness
  std::array<std::string_view, 2> kinds;  ///< which use it; the second may be empty

  bool used_by(std::string_view kind) const { return kind == kinds[0] || kind == kinds[1]; }
  /// "k or k_per_step"
  std::string kinds_text() const {
    return std::string(kinds[0]) + (kinds[1].empty() ? "" : " or " + std::string(kinds[1]));
  }
};

inline constexpr std::array stiffness_settings = {
    StiffnessSetting{"/bending/k", "/bending/stiffness", {"k", "k_per_step"}},
    StiffnessSetting{"/bending/compliance", "/bending/stiffness", {"compliance"}},
    StiffnessSetting{"/bending/flexural_rigidity", "/bending/stiffness", {"physical"}},
    StiffnessSetting{"/bending/quartic_coefficient", "/bending/stiffness", {"physical"}},
    StiffnessSetting{"/bending/at_curvature", "/bending/stiffness", {"physical"}},
    StiffnessSetting{"/material/strain/compliance", "/material/strain/stiffness", {"compliance"}},
    StiffnessSetting{"/material/strain/membrane_stiffness", "/material/strain/stiffness", {"physical"}},
};

}  // namespace bendlab
