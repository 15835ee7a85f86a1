#include "bendlab/bending/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bendlab/bending/triangle_finder.hpp"
#include "bendlab/bending/unit_bend.hpp"

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
    energy_.insert(energy_.end(), energy.begin(), energy.end());
    shares_.insert(shares_.end(), shares.begin(), shares.end());
    first_share_.push_back(shares_.size());
  }

  // A constraint that does not resist bending (a spring along an edge): then as soft as the median of the others.
  void add_idle(double& softness) { idle_.push_back(&softness); }

  bool empty() const { return softness_.empty() && idle_.empty(); }

  // `wanted` (#V): energy of each vertex at κ = 1, 0 where it may be anything. `usual`: a stiffness of idle constraints
  // where nothing else resists.
  std::vector<BendingFact> meet(const std::vector<double>& wanted, double usual, const std::string& name);

 private:
  using PerVertex = std::vector<ByDirection>;

  std::span<const double, directions> energy(std::size_t c) const {
    return std::span<const double, directions>(&energy_[c * directions], directions);
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
  std::vector<double> energy_;  // by constraint and direction
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
      for (std::size_t d = 0; d < directions; ++d) of_vertex[d] += part * energy(c)[d];
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
  // Saves rounds: what alone would be right at once keeps half its error, what is slow becomes faster.
  constexpr double over_relaxation = 1.5;
  PerVertex ratio = energies();
  for (std::size_t v = 0; v < vertices_; ++v)
    for (double& value : ratio[v]) value = wanted[v] > 0 && value > 0 ? wanted[v] / value : 0;
  for (std::size_t c = 0; c < softness_.size(); ++c) {
    double sum = 0, weight = 0;
    for (const Share& share : shares(c)) {
      const auto v = static_cast<std::size_t>(share.vertex);
      if (!(wanted[v] > 0)) continue;
      for (std::size_t d = 0; d < directions; ++d) {
        const double w = static_cast<double>(share.part) * energy(c)[d];
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
    for (const double e : energy(c)) own += e, calibrated += factor_[c] * e;
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

// Triangles with all corners pinned stay as they are; the sheet bends beyond them.
std::vector<char> held_triangles(const RestMesh& rest, const Pins& pins) {
  std::vector<char> held;
  for (int t = 0; t < rest.triangle_count(); ++t) {
    const auto corner = rest.triangles().row(t);
    held.push_back(pins.pinned(corner(0)) && pins.pinned(corner(1)) && pins.pinned(corner(2)));
  }
  return held;
}

// #V: a third of the area of each triangle that may bend.
std::vector<double> bending_areas(const RestMesh& rest, const std::vector<char>& held) {
  std::vector<double> area(static_cast<std::size_t>(rest.vertex_count()), 0);
  for (int t = 0; t < rest.triangle_count(); ++t)
    for (int c = 0; c < 3 && !held[static_cast<std::size_t>(t)]; ++c)
      area[static_cast<std::size_t>(rest.triangles()(t, c))] += rest.areas()[static_cast<std::size_t>(t)] / 3;
  return area;
}

// Whose a constraint's energy is, and by how much a held part of it lessens what it sees of a curvature.
struct Span {
  Shares shares;
  double seen = 1;
};

// Of pairs, by the theory of a line from 0 to 1 that bends by κ(s) and shortens by δ:
//
//     δ = ½ ∫∫ G κ(s) κ(s') ds ds',   G = min(s, s') (1 - max(s, s')),   ∂δ/∂κ(s) = ∫ G κ(s') ds'
//
// A place's share is that of the moment there, s (1 - s) on a line that bends evenly; a held part does not bend.
class PairSpans {
 public:
  PairSpans(const RestMesh& rest, const Pins& pins, const std::vector<char>& held,
            std::span<const Vector2> plane)
      : mean_edge_(rest.mean_edge_length()),
        pins_(pins),
        held_(held),
        plane_(plane),
        find_(rest.triangles(), plane, rest.mean_edge_length()) {}

  Span operator()(int a, int b) const {
    const Vector2 from = plane_[static_cast<std::size_t>(a)], to = plane_[static_cast<std::size_t>(b)];
    const std::size_t samples = sample_count(a, b, (to - from).norm());
    Span span{{}, 0};
    std::array<std::optional<TriangleFinder::Place>, fine> place;
    std::array<bool, fine> bends{};
    for (std::size_t s = 0; s < samples; ++s) {
      place[s] = find_(from + middle(s, samples) * (to - from));
      bends[s] = !(place[s] && held_[static_cast<std::size_t>(place[s]->triangle)]);
    }
    for (std::size_t s = 0; s < samples; ++s) {
      if (!bends[s]) continue;
      const double moment = moment_at(s, samples, bends);
      span.seen += moment;
      for (std::size_t i = 0; place[s] && i < 3; ++i)
        add(span.shares, place[s]->corner[i], moment * place[s]->weight[i]);
      if (!place[s]) add(span.shares, a, moment / 2), add(span.shares, b, moment / 2);  // across a gap
    }
    for (Share& share : span.shares) share.part /= static_cast<float>(span.seen);
    double all = 0;
    for (std::size_t s = 0; s < samples; ++s) all += moment_at(s, samples, every_place());
    span.seen /= all;
    return span;
  }

 private:
  static constexpr std::size_t most = 6, fine = 24;

  static const std::array<bool, fine>& every_place() {
    static const auto all = [] {
      std::array<bool, fine> list;
      list.fill(true);
      return list;
    }();
    return all;
  }

  std::size_t sample_count(int a, int b, double length) const {
    if (pins_.pinned(a) || pins_.pinned(b)) return fine;
    return std::clamp(static_cast<std::size_t>(std::ceil(length / mean_edge_)), std::size_t{2}, most);
  }

  static double middle(std::size_t sample, std::size_t samples) {
    return (static_cast<double>(sample) + 0.5) / static_cast<double>(samples);
  }

  static double moment_at(std::size_t sample, std::size_t samples, const std::array<bool, fine>& bends) {
    const double at = middle(sample, samples);
    double sum = 0;
    for (std::size_t other = 0; other < samples; ++other) {
      const double s = middle(other, samples);
      if (bends[other]) sum += std::min(at, s) * (1 - std::max(at, s));
    }
    return sum;
  }

  static void add(Shares& shares, int vertex, double part) {
    if (!(part > 1e-6)) return;
    const auto same = std::ranges::find(shares, vertex, &Share::vertex);
    if (same == shares.end())
      shares.push_back({vertex, static_cast<float>(part)});
    else
      same->part += static_cast<float>(part);
  }

  double mean_edge_;
  const Pins& pins_;
  const std::vector<char>& held_;
  std::span<const Vector2> plane_;
  TriangleFinder find_;
};

// Of a hinge: the thirds of its triangles that are nearest to the edge. A held one leaves half the angle.
Span hinge_span(const std::array<int, 4>& hinge, const Pins& pins) {
  constexpr float edge = 4.0f / 9, opposite = 1.0f / 9;
  const bool edge_held = pins.pinned(hinge[0]) && pins.pinned(hinge[1]);
  std::vector<int> free;
  for (const std::size_t i : {2u, 3u})
    if (!(edge_held && pins.pinned(hinge[i]))) free.push_back(hinge[i]);
  Span span{{{hinge[0], edge}, {hinge[1], edge}}, 0.5 * static_cast<double>(free.size())};
  for (const int vertex : free) span.shares.push_back({vertex, opposite / static_cast<float>(free.size())});
  return span;
}

class Calibration {
 public:
  Calibration(BendingConstraints& constraints, const RestMesh& rest, const Pins& pins)
      : constraints_(constraints),
        rest_(rest),
        pins_(pins),
        held_(held_triangles(rest, pins)),
        linear_(rest.vertex_count()),
        quartic_(rest.vertex_count()) {
    auto& hinges = std::get<ElementList<HingeAngle>>(constraints.elements);
    auto& bends = std::get<ElementList<QuadraticBend>>(constraints.elements);
    auto& arcs = std::get<ElementList<ArcSpring>>(constraints.elements);
    if (hinges.size() + bends.size() > 0) plane_ = plane_coordinates(rest);
    add(hinges), add(bends);
    if (arcs.size() + constraints.distance.size() == 0) return;
    const UnitBend bend(rest);
    const PairSpans spans(rest, pins, held_, bend.plane());
    add(arcs, bend, spans), add(constraints.distance, bend, spans);
    membrane_ = bend.membrane_quartic();
  }

  void meet(const CalibrationTarget& target) {
    const std::vector<double> area = bending_areas(rest_, held_);
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
  void add_hinge(Resistance& resistance, double& softness, const std::array<int, 4>& vertices,
                 const Energy& energy) {
    std::array<Vector2, 4> flat;
    std::array<Vector3, 4> p;
    for (std::size_t i = 0; i < 4; ++i) {
      p[i] = rest_.position(vertices[i]);
      if (!plane_.empty()) flat[i] = plane_[static_cast<std::size_t>(vertices[i])];
    }
    const QuadraticForm angle = fold(plane_.empty() ? unfolded(p) : flat);
    const Span span = hinge_span(vertices, pins_);
    ByDirection values =
        in_all_directions([&](const Vector2& d) { return energy(span.seen * value_in(angle, d)); });
    if (plane_.empty()) values.fill(mean(values));
    resistance.add(softness, values, span.shares);
  }

  void add(ElementList<HingeAngle>& list) {
    for (std::size_t c = 0; c < list.size(); ++c) {
      // ½ C² = V ≈ ¼ cos(θ0/2) (θ - θ0)² for the half sine.
      const double weight = list.law == HingeAngle::Law::angle ? 0.5 : 0.25 * list.rest[c][3];
      add_hinge(linear_, list.softness[c], list.vertices[c],
                [&](double angle) { return weight * square(angle) / list.softness[c]; });
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
      const double per_angle = edge * std::sqrt(std::max(0.0, 1 - sine * sine));
      add_hinge(norm ? linear_ : quartic_, list.softness[c], list.vertices[c], [&](double angle) {
        return 0.5 * square(norm ? per_angle * angle : 0.5 * square(edge * angle)) / list.softness[c];
      });
    }
  }

  // `energy` of its shortening. A spring along an edge belongs to the membrane, and one between pins to nothing.
  template <class Energy>
  void add_pair(Resistance& resistance, double& softness, const std::array<int, 2>& pair,
                const UnitBend& bend, const PairSpans& spans, const Energy& energy) {
    const Span span = spans(pair[0], pair[1]);
    if (span.shares.empty() || std::ranges::binary_search(rest_.one_ring()[pair[0]], pair[1]))
      return resistance.add_idle(softness);
    const QuarticForm shorter = bend.shortening(pair[0], pair[1]);
    resistance.add(softness, in_all_directions([&](const Vector2& d) {
                     return energy(span.seen * value_in(shorter, d));
                   }),
                   span.shares);
  }

  void add(ElementList<ArcSpring>& list, const UnitBend& bend, const PairSpans& spans) {
    for (std::size_t c = 0; c < list.size(); ++c) {
      const double push = ArcSpring::push(1, list.law) / square(list.rest[c][0]) / list.softness[c];
      add_pair(linear_, list.softness[c], list.vertices[c], bend, spans,
               [&](double shorter) { return push * std::max(0.0, shorter); });
    }
  }

  void add(DistanceConstraints& list, const UnitBend& bend, const PairSpans& spans) {
    list.softness.resize(list.size(), 1);
    for (std::size_t c = 0; c < list.size(); ++c) {
      const auto [a, b] = list.vertices[c];
      const double length = (rest_.position(a) - rest_.position(b)).norm();
      if (std::abs(list.rest_length[c] - length) > 1e-6 * length)
        throw std::invalid_argument(fmt::format(
            "the spring between vertices {} and {} is not at rest in the rest shape ({:.6g} m apart, rest "
            "length {:.6g} m): use straight rest lengths",
            a, b, length, list.rest_length[c]));
      add_pair(quartic_, list.softness[c], list.vertices[c], bend, spans,
               [&](double shorter) { return 0.5 * square(shorter) / list.softness[c]; });
    }
  }

  BendingConstraints& constraints_;
  const RestMesh& rest_;
  const Pins& pins_;
  std::vector<char> held_;
  std::vector<Vector2> plane_;
  Resistance linear_, quartic_;
  std::optional<double> membrane_;
};

}  // namespace

void calibrate(BendingConstraints& constraints, const RestMesh& rest, const Pins& pins,
               const CalibrationTarget& target) {
  Calibration(constraints, rest, pins).meet(target);
}

}  // namespace bendlab
