// What is asked of the settings for a scene: at most this error, or at most this time.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace bendlab {

/// Either of the two.
struct Demand {
  std::optional<double> error;  ///< rms distance from the reference, in sizes of the mesh
  std::optional<double> cpu_s;  ///< CPU seconds per frame, which is 1/60 s of simulated time
};

/// "5%" or "0.05" → 0.05. Throws std::invalid_argument unless it is above 0 and below 1.
double parse_error(std::string_view text);

/// "2ms", "0.002s", "500us" or "2min" → seconds. Throws std::invalid_argument without a unit or above-zero
/// number.
double parse_duration(std::string_view text);

/// 0.0512 → "5.1" and "5.1 %".
std::string percent_number(double share);
std::string percent_text(double share);

}  // namespace bendlab
