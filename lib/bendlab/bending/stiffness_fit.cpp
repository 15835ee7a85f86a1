#include "bendlab/bending/stiffness_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bendlab/settings/median.hpp"

namespace bendlab {

const std::array<Vector2, bending_directions>& all_bending_directions() {
  static const auto all = [] {
    std::array<Vector2, bending_directions> list;
    for (std::size_t d = 0; d < bending_directions; ++d) {
      const double angle = std::numbers::pi * static_cast<double>(d) / bending_directions;
      list[d] = {std::cos(angle), std::sin(angle)};
    }
    return list;
  }();
  return all;
}

double mean(const ByDirection& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / bending_directions;
}

ByDirection all_alike() {
  ByDirection ones;
  ones.fill(1);
  return ones;
}

double value_at(const ByDirection& values, double angle) {
  double sum = 0;
  for (std::size_t d = 0; d < bending_directions; ++d) {
    const double between = angle - std::numbers::pi * static_cast<double>(d) / bending_directions;
    double kernel = 1;
    for (int harmonic = 2; harmonic < static_cast<int>(bending_directions); harmonic += 2)
      kernel += 2 * std::cos(harmonic * between);
    sum += values[d] * kernel / bending_directions;
  }
  return sum;
}

std::vector<BendingFact> facts_by_direction(double warp, double weft, double bias) {
  return {
      {"share_of_warp", warp, "share of the stated rigidity that the sheet has along the warp"},
      {"share_of_weft", weft, "share of the stated rigidity that the sheet has along the weft"},
      {"share_of_bias", bias, "share of the stated rigidity that the sheet has at 45 degrees to the warp"}};
}

void StiffnessFit::add(double& softness, const ByDirection& energy, const Shares& shares) {
  // An energy that is zero except for rounding must not count. Near a clamp, a vertex may have no other
  // energy in a direction, and the fit would then scale the rounding error up to the wanted energy.
  constexpr double rounding = 1e-12;  // of the largest energy; angles round by 1e-16, their squares by 1e-32
  const double least = rounding * *std::ranges::max_element(energy);
  softness_.push_back(&softness);
  for (const double value : energy) energy_.push_back(value > least ? value : 0);
  shares_.insert(shares_.end(), shares.begin(), shares.end());
  first_share_.push_back(shares_.size());
}

StiffnessFit::PerVertex StiffnessFit::energies() const {
  PerVertex sum(vertices_, ByDirection{});
  for (std::size_t c = 0; c < softness_.size(); ++c)
    for (const Share& share : shares(c)) {
      const double part = factor_[c] * static_cast<double>(share.part);
      ByDirection& of_vertex = sum[static_cast<std::size_t>(share.vertex)];
      for (std::size_t d = 0; d < bending_directions; ++d) of_vertex[d] += part * energy(c)[d];
    }
  return sum;
}

// Multiplies all factors by the same number, so that the energies of the vertices with a target have the
// right sum.
void StiffnessFit::scale_to(const std::vector<double>& wanted) {
  const PerVertex have = energies();
  double sum = 0, target = 0;
  for (std::size_t v = 0; v < vertices_; ++v)
    if (wanted[v] > 0 && mean(have[v]) > 0) sum += mean(have[v]), target += wanted[v];
  for (double& factor : factor_) factor *= sum > 0 ? target / sum : 1;
}

// A step of the iteration of Richardson (1972) and Lucy (1974) for W f = e with W, f ≥ 0. For each direction,
// the energy that a constraint gives to a vertex is multiplied by the ratio of the wanted energy to the
// present energy of the vertex. The sum of these products is the constraint's new energy. The iteration keeps
// f positive. There are many solutions. The iteration finds one whose
// stiffnesses have nearly the same ratios as the model's own stiffnesses.
void StiffnessFit::improve(const std::vector<double>& wanted) {
  // A power above 1 saves rounds, because errors that fall slowly then fall faster. An error that one step
  // with the power 1 would remove is halved instead.
  constexpr double over_relaxation = 1.5;
  PerVertex ratio = energies();
  for (std::size_t v = 0; v < vertices_; ++v)
    for (std::size_t d = 0; d < bending_directions; ++d) {
      double& value = ratio[v][d];
      value = wanted[v] > 0 && value > 0 ? wanted[v] * shape_[d] / value : 0;
    }
  for (std::size_t c = 0; c < softness_.size(); ++c) {
    double sum = 0, weight = 0;
    for (const Share& share : shares(c)) {
      const auto v = static_cast<std::size_t>(share.vertex);
      if (!(wanted[v] > 0)) continue;
      for (std::size_t d = 0; d < bending_directions; ++d) {
        const double w = static_cast<double>(share.part) * energy(c)[d];
        weight += w, sum += w * ratio[v][d];
      }
    }
    if (weight > 0) factor_[c] *= std::pow(sum / weight, over_relaxation);
  }
}

std::vector<BendingFact> StiffnessFit::facts(const std::vector<double>& wanted,
                                             const std::string& name) const {
  const PerVertex have = energies();
  double area = 0, unreached = 0, squares = 0, worst = 0, own = 0, calibrated = 0;
  ByDirection total{};
  for (std::size_t v = 0; v < vertices_; ++v) {
    if (!(wanted[v] > 0)) continue;
    area += wanted[v];
    const double error = mean(have[v]) / wanted[v] - 1;
    if (error < -0.99) {
      unreached += wanted[v];
      continue;
    }
    squares += wanted[v] * error * error, worst = std::max(worst, std::abs(error));
    for (std::size_t d = 0; d < bending_directions; ++d) total[d] += have[v][d];
  }
  for (std::size_t c = 0; c < softness_.size(); ++c)
    for (const double e : energy(c)) own += e, calibrated += factor_[c] * e;
  const double reached = area - unreached;
  const auto share = [&](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return reached > 0 ? value_at(total, angle) / (reached * value_at(shape_, angle)) : 0;
  };
  const bool by_direction = shape_ != all_alike();
  const auto directed =
      by_direction ? facts_by_direction(share(0), share(90), share(45)) : std::vector<BendingFact>{};
  for (std::size_t d = 0; d < bending_directions; ++d) total[d] /= shape_[d];
  const auto [least, most] = std::minmax_element(total.begin(), total.end());
  std::vector<BendingFact> all = {
      {name + "_factor", own > 0 ? calibrated / own : 0,
       "mean factor of the fit on the model's own stiffnesses (at a compliance of 1)"},
      {name + "_rms", reached > 0 ? std::sqrt(squares / reached) : 0,
       "relative error of a vertex's bending energy, averaged over directions: RMS over free vertices"},
      {name + "_worst", worst,
       "relative error of a vertex's bending energy, averaged over directions: largest value"},
      {name + "_anisotropy", mean(total) > 0 ? (*most - *least) / mean(total) : 0,
       "(largest - smallest) / mean over directions of the bending energy of all free vertices, relative to "
       "the stated energy"},
      {name + "_unreached", area > 0 ? unreached / area : 0,
       "share of the free vertices' area where no constraint resists bending"}};
  all.insert(all.end(), directed.begin(), directed.end());
  return all;
}

void StiffnessFit::fit(const std::vector<double>& wanted) {
  // Measured on lattices, grids and irregular sheets: more rounds change the energy by less than 1 %, but
  // bring more and more springs to a stiffness of almost 0.
  constexpr int rounds = 24;
  factor_.assign(softness_.size(), 1);
  scale_to(wanted);
  refit(wanted, rounds);
}

void StiffnessFit::refit(const std::vector<double>& wanted, int rounds) {
  for (int round = 0; round < rounds; ++round) improve(wanted);
  scale_to(wanted);
}

std::vector<BendingFact> StiffnessFit::finish(const std::vector<double>& wanted, double usual,
                                              const std::string& name) {
  std::vector<double> softnesses = {1 / usual};
  if (!softness_.empty()) softnesses.clear();
  for (std::size_t c = 0; c < softness_.size(); ++c) softnesses.push_back(*softness_[c] /= factor_[c]);
  const double median = upper_median(softnesses);
  for (double* const softness : without_energy_) *softness = median;
  return facts(wanted, name);
}

}  // namespace bendlab
