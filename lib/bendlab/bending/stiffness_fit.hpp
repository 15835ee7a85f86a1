// The bending energy of constraints, and the fit of their stiffnesses to a target: the same energy per area
// at every vertex, in every direction of bending.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "bendlab/bending/model.hpp"

namespace bendlab {

/// Number of sampled bending directions. Nine directions are enough, because the energy of a constraint, as a
/// function of the direction's angle, has only the harmonics 0, 2, … 8.
inline constexpr std::size_t bending_directions = 9;
using ByDirection = std::array<double, bending_directions>;

const std::array<Vector2, bending_directions>& all_bending_directions();

template <class Energy>
ByDirection in_all_directions(const Energy& energy) {
  ByDirection values;
  for (std::size_t d = 0; d < bending_directions; ++d) values[d] = energy(all_bending_directions()[d]);
  return values;
}

double mean(const ByDirection& values);

/// 1 in every direction.
ByDirection all_alike();

/// The value at an angle (rad) between the sampled directions. Exact for the harmonics 0, 2, … 8.
double value_at(const ByDirection& values, double angle);

/// Which shares of the stated rigidities along the warp, along the weft and at 45 degrees (the bias) the
/// sheet has: facts share_of_warp, share_of_weft, share_of_bias.
std::vector<BendingFact> facts_by_direction(double warp, double weft, double bias);

/// The part of a constraint's energy that belongs to a vertex.
struct Share {
  int vertex;
  float part;
};
using Shares = std::vector<Share>;

/// The constraints that are fitted to one target. Each constraint has its energy at κ = 1 in every direction,
/// and the shares of the vertices in this energy.
class StiffnessFit {
 public:
  /// `shape`: the wanted energy in each direction, divided by its mean over the directions.
  explicit StiffnessFit(int vertices, const ByDirection& shape = all_alike())
      : vertices_(static_cast<std::size_t>(vertices)), shape_(shape) {}

  /// `energy` is the constraint's energy at its current softness. The reference `softness` must stay valid
  /// until meet().
  void add(double& softness, const ByDirection& energy, const Shares& shares);

  /// Adds a constraint without bending energy (a spring along an edge). meet() gives it the median softness
  /// of the constraints that have bending energy.
  void add_without_energy(double& softness) { without_energy_.push_back(&softness); }

  bool empty() const { return softness_.empty() && without_energy_.empty(); }
  std::size_t size() const { return softness_.size(); }  ///< constraints with bending energy

  /// Sets every softness. `wanted` (#V): wanted energy of each vertex at κ = 1, mean over directions; 0: any
  /// energy is accepted.
  /// `usual`: the stiffness of constraints without bending energy if no constraint has bending energy.
  /// Returns facts, named `name`_…, about the quality of the fit.
  std::vector<BendingFact> meet(const std::vector<double>& wanted, double usual, const std::string& name) {
    fit(wanted);
    return finish(wanted, usual, name);
  }

  /// The two steps of meet(). Between these steps the caller may change factors(): one factor on the
  /// stiffness of each constraint, in the order of add().
  void fit(const std::vector<double>& wanted);
  std::vector<BendingFact> finish(const std::vector<double>& wanted, double usual, const std::string& name);
  std::span<double> factors() { return factor_; }
  /// Improves the current factors by `rounds` further rounds.
  void refit(const std::vector<double>& wanted, int rounds);

 private:
  using PerVertex = std::vector<ByDirection>;

  std::span<const double, bending_directions> energy(std::size_t c) const {
    return std::span<const double, bending_directions>(&energy_[c * bending_directions], bending_directions);
  }
  std::span<const Share> shares(std::size_t c) const {
    return std::span(shares_).subspan(first_share_[c], first_share_[c + 1] - first_share_[c]);
  }

  PerVertex energies() const;
  void scale_to(const std::vector<double>& wanted);
  void improve(const std::vector<double>& wanted);
  std::vector<BendingFact> facts(const std::vector<double>& wanted, const std::string& name) const;

  std::size_t vertices_;
  ByDirection shape_;
  std::vector<double*> softness_, without_energy_;
  std::vector<double> energy_;  // by constraint and direction
  std::vector<std::size_t> first_share_ = {0};
  std::vector<Share> shares_;
  std::vector<double> factor_;  // on each constraint's stiffness
};

}  // namespace bendlab
