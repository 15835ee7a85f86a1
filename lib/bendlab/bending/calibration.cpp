#include "bendlab/bending/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bendlab/bending/triangle_finder.hpp"
#include "bendlab/bending/unit_bend.hpp"
#include "bendlab/constraints/build.hpp"

namespace bendlab {
namespace {

// Enough for the energy of any constraint here: harmonics 0, 2, … 8 of the direction's angle.
constexpr std::size_t directions = 9;
using ByDirection = std::array<double, directions>;

const std::array<Vector2, directions>& all_directions() {
  static const auto all = [] {
    std::array<Vector2, directions> list;
    for (std::size_t d = 0; d < directions; ++d) {
      const double angle = std::numbers::pi * static_cast<double>(d) / directions;
      list[d] = {std::cos(angle), std::sin(angle)};
    }
    return list;
  }();
  return all;
}

template <class Energy>
ByDirection in_all_directions(const Energy& energy) {
  ByDirection values;
  for (std::size_t d = 0; d < directions; ++d) values[d] = energy(all_directions()[d]);
  return values;
}

double square(double x) {
  return x * x;
}

double mean(const ByDirection& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / directions;
}

struct Share {
  int vertex;
  float part;
};
using Shares = std::vector<Share>;

// The constraints that meet one target, and each one's energy at κ = 1: how much in which direction, and whose.
class Resistance {
 public:
  explicit Resistance(int vertices) : vertices_(static_cast<std::size_t>(vertices)) {}

  void add(double& softness, const ByDirection& energy, const Shares& shares) {
    softness_.push_back(&softness);
    for (const double e : energy) energy_.push_back(static_cast<float>(e));
    shares_.insert(shares_.end(), shares.begin(), shares.end());
    first_share_.push_back(shares_.size());
  }

  // A constraint that does not resist bending (a spring along an edge): as soft as half of the others become.
  void add_idle(double& softness) { idle_.push_back(&softness); }

  bool empty() const { return softness_.empty() && idle_.empty(); }

  // `wanted` (#V): energy of each vertex at κ = 1, 0 where it may be anything. `usual`: a stiffness of idle constraints
  // where nothing else resists.
  std::vector<BendingFact> meet(const std::vector<double>& wanted, double usual, const std::string& name);

 private:
  using PerVertex = std::vector<ByDirection>;

  std::span<const float, directions> energy(std::size_t c) const {
    return std::span<const float, directions>(&energy_[c * directions], directions);
  }
  std::span<const Share> shares(std::size_t c) const {
    return std::span(shares_).subspan(first_share_[c], first_share_[c + 1] - first_share_[c]);
  }

  PerVertex energies() const;
  void scale_to(const std::vector<double>& wanted);
  void improve(const std::vector<double>& wanted);
  std::vector<BendingFact> facts(const std::vector<double>& wanted, const std::string& name) const;

  std::size_t vertices_;
  std::vector<double*> softness_, idle_;
  std::vector<float> energy_;  // by constraint and direction
  std::vector<std::size_t> first_share_ = {0};
  std::vector<Share> shares_;
  std::vector<double> factor_;  // on each constraint's stiffness
};

Resistance::PerVertex Resistance::energies() const {
  PerVertex sum(vertices_, ByDirection{});
  for (std::size_t c = 0; c < softness_.size(); ++c)
    for (const Share& share : shares(c)) {
      const double part = factor_[c] * static_cast<double>(share.part);
      ByDirection& of_vertex = sum[static_cast<std::size_t>(share.vertex)];
      for (std::size_t d = 0; d < directions; ++d) of_vertex[d] += part * static_cast<double>(energy(c)[d]);
    }
  return sum;
}

// One common factor: the sum over the vertices with a target is right.
void Resistance::scale_to(const std::vector<double>& wanted) {
  const PerVertex have = energies();
  double sum = 0, target = 0;
  for (std::size_t v = 0; v < vertices_; ++v)
    if (wanted[v] > 0 && mean(have[v]) > 0) sum += mean(have[v]), target += wanted[v];
  for (double& factor : factor_) factor *= sum > 0 ? target / sum : 1;
}

// A step of the iteration of Richardson (1972) and Lucy (1974) for W f = e with W, f ≥ 0: what a constraint gives to a
// vertex in a direction is multiplied by what is wanted there over what is there, and its new energy is the sum. Keeps
// f positive and, of the many solutions, near the model's own proportions.
void Resistance::improve(const std::vector<double>& wanted) {
  constexpr double over_relaxation =
      1.5;  // saves rounds: an error e in the logarithm becomes -e/2, where 1 ends at once
  PerVertex ratio = energies();
  for (std::size_t v = 0; v < vertices_; ++v)
    for (double& value : ratio[v]) value = wanted[v] > 0 && value > 0 ? wanted[v] / value : 0;
  for (std::size_t c = 0; c < softness_.size(); ++c) {
    double sum = 0, weight = 0;
    for (const Share& share : shares(c)) {
      const auto v = static_cast<std::size_t>(share.vertex);
      if (!(wanted[v] > 0)) continue;
      for (std::size_t d = 0; d < directions; ++d) {
        const double w = static_cast<double>(share.part) * static_cast<double>(energy(c)[d]);
        weight += w, sum += w * ratio[v][d];
      }
    }
    if (weight > 0) factor_[c] *= std::pow(sum / weight, over_relaxation);
  }
}

std::vector<BendingFact> Resistance::facts(const std::vector<double>& wanted, const std::string& name) const {
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
    for (std::size_t d = 0; d < directions; ++d) total[d] += have[v][d];
  }
  for (std::size_t c = 0; c < softness_.size(); ++c)
    for (const float e : energy(c))
      own += static_cast<double>(e), calibrated += factor_[c] * static_cast<double>(e);
  const auto [least, most] = std::minmax_element(total.begin(), total.end());
  const double reached = area - unreached;
  return {{name + "_factor", own > 0 ? calibrated / own : 0,
           "of the model's own stiffnesses, on average; times what a softness of 1 stands for"},
          {name + "_rms", reached > 0 ? std::sqrt(squares / reached) : 0,
           "of the relative error of free vertices' bending energy, averaged over directions"},
          {name + "_worst", worst, "largest such error"},
          {name + "_anisotropy", mean(total) > 0 ? (*most - *least) / mean(total) : 0,
           "energy of all free vertices: largest less smallest over directions, by the mean"},
          {name + "_unreached", area > 0 ? unreached / area : 0,
           "share of the free vertices' area where no constraint resists bending"}};
}

std::vector<BendingFact> Resistance::meet(const std::vector<double>& wanted, double usual,
                                          const std::string& name) {
  // Measured on lattices, grids and irregular sheets: more rounds change the energy by less than 1 %, but switch more
  // and more springs off.
  constexpr int rounds = 24;
  factor_.assign(softness_.size(), 1);
  scale_to(wanted);
  for (int round = 0; round < rounds; ++round) improve(wanted);
  scale_to(wanted);
  std::vector<double> found = {1 / usual};
  if (!softness_.empty()) found.clear();
  for (std::size_t c = 0; c < softness_.size(); ++c) found.push_back(*softness_[c] /= factor_[c]);
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
  std::nth_element(found.begin(), middle, found.end());
  for (double* const softness : idle_) *softness = *middle;
  return facts(wanted, name);
}

// Where a constraint's energy is, for each kind.
class Spread {
 public:
  Spread(const RestMesh& rest, std::span<const Vector2> plane)
      : mean_edge_(rest.mean_edge_length()),
        plane_(plane),
        find_(rest.triangles(), plane, rest.mean_edge_length()) {}

  // Evenly along the straight line, at a few places of it.
  Shares between(int a, int b) const {
    constexpr int most = 6;
    const Vector2 from = plane_[static_cast<std::size_t>(a)], to = plane_[static_cast<std::size_t>(b)];
    const int samples = std::clamp(static_cast<int>(std::ceil((to - from).norm() / mean_edge_)), 2, most);
    Shares shares;
    for (int s = 0; s < samples; ++s) {
      const auto place = find_(from + (s + 0.5) / samples * (to - from));
      for (std::size_t i = 0; place && i < 3; ++i) add(shares, place->corner[i], place->weight[i] / samples);
      if (!place) add(shares, a, 0.5 / samples), add(shares, b, 0.5 / samples);  // across a gap
    }
    return shares;
  }

 private:
  static void add(Shares& shares, int vertex, double part) {
    if (!(part > 1e-6)) return;
    const auto same = std::ranges::find(shares, vertex, &Share::vertex);
    if (same == shares.end())
      shares.push_back({vertex, static_cast<float>(part)});
    else
      same->part += static_cast<float>(part);
  }

  double mean_edge_;
  std::span<const Vector2> plane_;
  TriangleFinder find_;
};

// The third of each triangle that is nearest to the edge.
Shares around(const std::array<int, 4>& hinge) {
  constexpr float edge = 4.0f / 9, opposite = 1.0f / 18;
  return {{hinge[0], edge}, {hinge[1], edge}, {hinge[2], opposite}, {hinge[3], opposite}};
}

class Calibration {
 public:
  Calibration(BendingConstraints& constraints, const RestMesh& rest)
      : constraints_(constraints), rest_(rest), linear_(rest.vertex_count()), quartic_(rest.vertex_count()) {
    auto& hinges = std::get<ElementList<HingeAngle>>(constraints.elements);
    auto& bends = std::get<ElementList<QuadraticBend>>(constraints.elements);
    auto& arcs = std::get<ElementList<ArcSpring>>(constraints.elements);
    if (hinges.size() + bends.size() > 0) plane_ = plane_coordinates(rest);
    add(hinges), add(bends);
    if (arcs.size() + constraints.distance.size() == 0) return;
    const UnitBend bend(rest);
    const Spread spread(rest, bend.plane());
    add(arcs, bend, spread), add(constraints.distance, bend, spread);
    membrane_ = bend.membrane_quartic();
  }

  void meet(const Pins& pins, const CalibrationTarget& target) {
    std::vector<double> area = lumped_masses(rest_, 1);
    for (const int vertex : pins.all) area[static_cast<std::size_t>(vertex)] = 0;
    if (!linear_.empty()) meet(linear_, area, rigidity(target) / 2, 1, "linear");
    if (!quartic_.empty()) meet(quartic_, area, quartic(target) / 4, 4, "quartic");
    if (membrane_)
      constraints_.facts.push_back(
          {"membrane_quartic", *membrane_,
           "m⁴; C of the bent sheet's membrane per N/m of its stiffness, because this "
           "mesh cannot bend without strain"});
  }

 private:
  static double rigidity(const CalibrationTarget& target) {
    if (target.flexural_rigidity) return *target.flexural_rigidity;
    throw std::invalid_argument("hinges and arcs have a moment B κ: give flexural_rigidity (B in N m)");
  }
  static double quartic(const CalibrationTarget& target) {
    if (target.quartic_coefficient) return *target.quartic_coefficient;
    if (target.flexural_rigidity && target.at_curvature)
      return *target.flexural_rigidity / square(*target.at_curvature);
    throw std::invalid_argument(
        "springs have a moment C κ³: give quartic_coefficient (C in N m³), or flexural_rigidity "
        "(in N m) together with at_curvature (in 1/m), the curvature at which it holds");
  }

  void meet(Resistance& resistance, std::vector<double> energy, double per_area, int power,
            const std::string& name) {
    for (double& of_vertex : energy) of_vertex *= per_area;
    const double usual = per_area / std::pow(rest_.mean_edge_length(), power);
    for (BendingFact& fact : resistance.meet(energy, usual, name))
      constraints_.facts.push_back(std::move(fact));
  }

  // In the sheet's plane; on a rest shape that is not flat each in its own, averaged over directions because their axes
  // have nothing in common.
  template <class Energy>
  ByDirection by_direction(const std::array<int, 4>& vertices, const Energy& energy) const {
    std::array<Vector2, 4> flat;
    std::array<Vector3, 4> p;
    for (std::size_t i = 0; i < 4; ++i) {
      p[i] = rest_.position(vertices[i]);
      if (!plane_.empty()) flat[i] = plane_[static_cast<std::size_t>(vertices[i])];
    }
    const QuadraticForm angle = fold(plane_.empty() ? unfolded(p) : flat);
    ByDirection values = in_all_directions([&](const Vector2& d) { return energy(value_in(angle, d)); });
    if (plane_.empty()) values.fill(mean(values));
    return values;
  }

  void add(ElementList<HingeAngle>& list) {
    for (std::size_t c = 0; c < list.size(); ++c) {
      // ½ C² = V ≈ ¼ cos(θ0/2) (θ - θ0)² for the half sine.
      const double weight = list.law == HingeAngle::Law::angle ? 0.5 : 0.25 * list.rest[c][3];
      const auto energy = [&](double angle) { return weight * square(angle) / list.softness[c]; };
      linear_.add(list.softness[c], by_direction(list.vertices[c], energy), around(list.vertices[c]));
    }
  }

  void add(ElementList<QuadraticBend>& list) {
    const bool norm = list.law == QuadraticBend::Law::norm;
    for (std::size_t c = 0; c < list.size(); ++c) {
      const double edge = list.rest[c][5], sine = list.rest[c][4] / (2 * edge);
      if (!norm && sine > 0)
        throw std::invalid_argument(
            "the energy of Bergou as a constraint is quartic in a flat rest shape only");
      // |Kx| = 2 edge sin(θ/2).
      const auto energy = [&](double angle) {
        const double change =
            norm ? edge * std::sqrt(std::max(0.0, 1 - sine * sine)) * angle : 0.5 * square(edge * angle);
        return 0.5 * square(change) / list.softness[c];
      };
      (norm ? linear_ : quartic_)
          .add(list.softness[c], by_direction(list.vertices[c], energy), around(list.vertices[c]));
    }
  }

  void add(ElementList<ArcSpring>& list, const UnitBend& bend, const Spread& spread) {
    const double push = ArcSpring::push(1, list.law);
    for (std::size_t c = 0; c < list.size(); ++c) {
      const auto [a, b] = list.vertices[c];
      const QuarticForm shorter = bend.shortening(a, b);
      const double factor = push / square(list.rest[c][0]) / list.softness[c];
      linear_.add(list.softness[c], in_all_directions([&](const Vector2& d) {
                    return factor * std::max(0.0, value_in(shorter, d));
                  }),
                  spread.between(a, b));
    }
  }

  void add(DistanceConstraints& list, const UnitBend& bend, const Spread& spread) {
    list.softness.resize(list.size(), 1);
    for (std::size_t c = 0; c < list.size(); ++c) {
      const auto [a, b] = list.vertices[c];
      const double length = (rest_.position(a) - rest_.position(b)).norm();
      if (std::abs(list.rest_length[c] - length) > 1e-6 * length)
        throw std::invalid_argument(fmt::format(
            "the spring between vertices {} and {} is not at rest in the rest shape ({:.6g} m apart, rest "
            "length {:.6g} m): use straight rest lengths",
            a, b, length, list.rest_length[c]));
      if (along_edge(a, b)) {
        quartic_.add_idle(list.softness[c]);
        continue;
      }
      const QuarticForm shorter = bend.shortening(a, b);
      quartic_.add(list.softness[c], in_all_directions([&](const Vector2& d) {
                     return 0.5 * square(value_in(shorter, d)) / list.softness[c];
                   }),
                   spread.between(a, b));
    }
  }

  // A spring along an edge belongs to the membrane.
  bool along_edge(int a, int b) const { return std::ranges::binary_search(rest_.one_ring()[a], b); }

  BendingConstraints& constraints_;
  const RestMesh& rest_;
  std::vector<Vector2> plane_;
  Resistance linear_, quartic_;
  std::optional<double> membrane_;
};

}  // namespace

void calibrate(BendingConstraints& constraints, const RestMesh& rest, const Pins& pins,
               const CalibrationTarget& target) {
  Calibration(constraints, rest).meet(pins, target);
}

}  // namespace bendlab
