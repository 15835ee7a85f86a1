#include "experiments/advise/fitness.hpp"

#include <algorithm>
#include <cmath>

namespace bendlab {

Unfit unfit(double error, const Strained& strained) {
  if (strained.implausible) return Unfit::implausible;
  if (!std::islessequal(strained.rms, largest_strain)) return Unfit::strain;
  if (!std::islessequal(strained.largest, largest_stretch)) return Unfit::stretch;
  if (!std::islessequal(error, largest_error)) return Unfit::error;
  return Unfit::no;
}

double beyond_limits(double error, const Strained& strained) {
  double worst = std::max(strained.rms / largest_strain, (strained.largest - 1) / (largest_stretch - 1));
  // A setting that was not compared, because of its strain, is judged by its strain.
  if (std::isfinite(error)) worst = std::max(worst, error / largest_error);
  return worst;
}

double judged_error(double error, const Strained& strained) {
  if (unfit(error, strained) == Unfit::no) return error;
  return largest_error * std::max(1.0, beyond_limits(error, strained));
}

}  // namespace bendlab
