#include "bendlab/bending/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "bendlab/bending/bend_spans.hpp"
#include "bendlab/bending/sheet_response.hpp"
#include "bendlab/bending/triangle_lookup.hpp"
#include "bendlab/bending/unit_bend.hpp"
#include "bendlab/bending/warp_field.hpp"
#include "bendlab/constraints/energy.hpp"

namespace bendlab {
namespace {

// Radius of the measured patch around the innermost vertex, in edges: about 5000 vertices. The rigidity D of
// this patch is within 1 % of the D of a whole irregular sheet, and is computed in 0.1 s at most.
constexpr int response_patch = 40;

double square(double x) {
  return x * x;
}

// #V: a third of the area of each triangle that may bend, times the triangle's factor (#T, or none: 1).
std::vector<double> bending_areas(const RestMesh& rest, const std::vector<char>& held,
                                  std::span<const double> factor = {}) {
  std::vector<double> area(static_cast<std::size_t>(rest.vertex_count()), 0);
  for (int t = 0; t < rest.triangle_count(); ++t)
    for (int c = 0; c < 3 && !held[static_cast<std::size_t>(t)]; ++c) {
      const auto at = static_cast<std::size_t>(t);
      area[static_cast<std::size_t>(rest.triangles()(t, c))] +=
          (factor.empty() ? 1 : factor[at]) * rest.areas()[at] / 3;
    }
  return area;
}

// What a kind of constraint resists: a fold between two triangles, or a shorter distance of two vertices.
template <class Kind>
constexpr bool folds = std::is_same_v<Kind, HingeAngle> || std::is_same_v<Kind, QuadraticBend>;
template <class Kind>
constexpr bool shortens = std::is_same_v<Kind, ArcSpring>;

// Kinds whose softness is 1 / D: they have the rigidity D without a fit.
template <class Kind>
constexpr bool by_formula = std::is_same_v<Kind, FoldBend> || std::is_same_v<Kind, MidEdgeBend> ||
                            std::is_same_v<Kind, LaplacianBend>;

template <class... Kinds>
constexpr bool every_kind_is_known(std::type_identity<std::tuple<Kinds...>>) {
  return ((folds<Kinds> || shortens<Kinds> || by_formula<Kinds>)&&...);
}
static_assert(every_kind_is_known(std::type_identity<ElementKinds>{}),
              "a new kind of constraint needs a calibration, too: name it in folds, shortens or by_formula");

class Calibration {
 public:
  Calibration(BendingConstraints& constraints, const RestMesh& rest, const Pins& pins,
              const CalibrationTarget& target)
      : constraints_(constraints),
        rest_(rest),
        pins_(pins),
        held_(held_triangles(rest, pins)),
        target_(target),
        directions_(rest, target.directed),
        linear_(rest.vertex_count(), directions_.shape()),
        quartic_(rest.vertex_count(), directions_.shape()) {
    for_each_kind(constraints.elements, [&]<class Kind>(const ElementList<Kind>& list) {
      if (folds<Kind> && list.size() > 0) plane_ = plane_coordinates(rest);
    });
    for_each_kind(constraints.elements, [&]<class Kind>(ElementList<Kind>& list) {
      if constexpr (folds<Kind>) add(list);
    });
    std::size_t shortening = constraints.distance.size();
    for_each_kind(constraints.elements, [&]<class Kind>(const ElementList<Kind>& list) {
      if (shortens<Kind>) shortening += list.size();
    });
    if (shortening == 0) return;
    const UnitBend bend(rest);
    const PairSpans spans(rest, pins, held_, bend.plane());
    for_each_kind(constraints.elements, [&]<class Kind>(ElementList<Kind>& list) {
      if constexpr (shortens<Kind>) add(list, bend, spans);
    });
    add(constraints.distance, bend, spans);
    membrane_ = bend.membrane_quartic();
  }

  // Elements of kinds by formula and own elements have a softness for a rigidity of 1 N m, so they need no
  // fit.
  void scale_elements_by_formula() {
    std::size_t count = constraints_.own.size();
    for_each_kind(constraints_.elements, [&]<class Kind>(const ElementList<Kind>& list) {
      if (by_formula<Kind>) count += list.size();
    });
    if (count == 0) return;
    if (target_.deflection != Deflection::large)
      throw std::invalid_argument(
          "a formula gives this model its flexural_rigidity, and the formula holds for large deflections: "
          "set "
          "\"deflection\" to \"large\", or choose a model made of hinges, such as discrete_shells");
    const std::vector<Vector2> plane = plane_coordinates(rest_);
    if (!plane.empty() && target_.factor.empty()) add_share_facts(plane);
    const OverElements factor(rest_, target_.factor);
    OwnElements& own = constraints_.own;
    for (std::size_t c = 0; c < own.size(); ++c)
      own.softness[c] /= rigidity() * factor.of_corners(own.corners(c));
    for_each_kind(constraints_.elements, [&]<class Kind>(ElementList<Kind>& list) {
      if constexpr (by_formula<Kind>)
        for (std::size_t c = 0; c < list.size(); ++c) list.softness[c] /= rigidity() * factor(list, c);
    });
  }

  void meet() {
    const std::vector<double> area = bending_areas(rest_, held_, target_.factor);
    if (!linear_.empty()) meet_linear(area);
    if (!quartic_.empty()) meet(quartic_, area, quartic() / 4, 4, "quartic");
    if (membrane_)
      constraints_.facts.push_back({"membrane_quartic", *membrane_,
                                    "C of the membrane itself, per N/m of membrane stiffness; not 0, because "
                                    "this mesh cannot bend without strain",
                                    "m⁴"});
  }

 private:
  double rigidity() const {
    if (target_.flexural_rigidity) return *target_.flexural_rigidity;
    throw std::invalid_argument("hinges and arcs have a moment B κ: give flexural_rigidity (B in N m)");
  }
  double quartic() const {
    if (target_.quartic_coefficient) return *target_.quartic_coefficient;
    if (target_.flexural_rigidity && target_.at_curvature)
      return *target_.flexural_rigidity / square(*target_.at_curvature);
    throw std::invalid_argument(
        "springs at rest have a moment C κ³: give quartic_coefficient (C in N m³), or flexural_rigidity (in "
        "N m) together with at_curvature (in 1/m), the curvature at which the flexural_rigidity holds");
  }

  void meet(StiffnessFit& fit, std::vector<double> energy, double per_area, int power,
            const std::string& name) {
    for (double& of_vertex : energy) of_vertex *= per_area;
    const double usual = per_area / std::pow(rest_.mean_edge_length(), power);
    for (BendingFact& fact : fit.meet(energy, usual, name)) constraints_.facts.push_back(std::move(fact));
  }

  void meet_linear(std::vector<double> energy) {
    const bool hinges_only = !stencils_.empty() && stencils_.size() == linear_.size();
    if (!hinges_only) {
      if (target_.deflection != Deflection::large)
        throw std::invalid_argument(
            "\"deflection\" may be \"small\" or \"both\" only for hinges with a flat rest shape: set it to "
            "\"large\", or choose a model made of hinges and a flat mesh");
      return meet(linear_, std::move(energy), rigidity() / 2, 1, "linear");
    }
    for (double& of_vertex : energy) of_vertex *= rigidity() / 2;
    linear_.fit(energy);
    const bool whole = target_.deflection == Deflection::both;
    if (target_.deflection != Deflection::large && !target_.factor.empty())
      throw std::invalid_argument(
          "the response to small deflections is not known for a sheet with a map: set \"deflection\" to "
          "\"large\", or remove the map");
    if (target_.deflection != Deflection::large && !directions_.is_uniform())
      throw std::invalid_argument(
          "the response to small deflections is known only if the warp has the same direction everywhere: "
          "set \"deflection\" to \"large\", or /material/coordinates to \"warp\"");
    const SheetResponse response(rest_, pins_, plane_, whole ? 0 : response_patch);
    if (whole && response.measurable()) agree(response, energy);
    std::vector<BendingFact> facts;
    const bool uniform = directions_.is_uniform() && target_.factor.empty();
    const auto answer = uniform ? response(stencils_, linear_.factors()) : std::nullopt;
    if (answer) {
      const double scale = scale_for(*answer);
      for (double& factor : linear_.factors()) factor *= scale;
      for (double& of_vertex : energy) of_vertex *= scale;
      facts = share_facts(*answer, scale);
    } else if (target_.deflection != Deflection::large) {
      throw std::invalid_argument(
          fmt::format("the response to small deflections cannot be measured on this mesh: the mesh needs "
                      "vertices that are {} edges away from its boundary and its pins, and hinges everywhere "
                      "around these vertices; use more cells, or \"deflection\": \"large\"",
                      SheetResponse::least_depth));
    }
    const double usual = rigidity() / 2 / rest_.mean_edge_length();
    for (BendingFact& fact : linear_.finish(energy, usual, "linear"))
      constraints_.facts.push_back(std::move(fact));
    for (BendingFact& fact : facts) constraints_.facts.push_back(std::move(fact));
  }

  // Bends the sheet, but so little that energies are quadratic. Directors then depend linearly on the three
  // curvatures of the sheet, so they are relaxed on three surfaces only. For own elements, heights are
  // measured from the middle of each element, because a function may compute with rounding of the whole
  // height.
  void add_share_facts(const std::vector<Vector2>& plane) {
    const double curvature = 1e-3 / rest_.size();
    double area = 0;
    for (const double of_vertex : bending_areas(rest_, held_)) area += of_vertex;
    if (!(area > 0)) return;
    // The whole sheet bends, so normals at clamps and on planes of symmetry turn, too.
    Directors directors = constraints_.directors;
    directors.held.clear();
    for (std::size_t i = 0; i < directors.is_pinned.size(); ++i)
      if (directors.rest.row(static_cast<Eigen::Index>(i)).norm() > 0) directors.is_pinned[i] = 0;
    // The surface z = ½ (k₀ x² + k₁ y²) + k₂ x y.
    const auto bent = [&](const Vector3& k) {
      Positions surface(rest_.vertex_count(), 3);
      for (int v = 0; v < rest_.vertex_count(); ++v) {
        const Vector2& q = plane[static_cast<std::size_t>(v)];
        surface.row(v) << q.x(), q.y(),
            0.5 * (k(0) * square(q.x()) + k(1) * square(q.y())) + k(2) * q.x() * q.y();
      }
      return surface;
    };
    const Positions flat = upright(directors);
    std::array<Positions, 3> turned;  // the change of the directors over each curvature
    for (int k = 0; k < 3 && directors.count() > 0; ++k)
      turned[static_cast<std::size_t>(k)] =
          (relaxed_directors(directors, constraints_.elements, constraints_.own,
                             bent(curvature * Vector3::Unit(k)), flat) -
           flat) /
          curvature;
    const auto share_along = [&](const Vector2& d) {
      double energy = 0;
      if (constraints_.directors.count() > 0 || constraints_.own.size() == 0) {
        const Vector3 k = curvature * Vector3(square(d.x()), square(d.y()), d.x() * d.y());
        Positions turns = flat;
        for (int i = 0; i < 3 && directors.count() > 0; ++i)
          turns += k(i) * turned[static_cast<std::size_t>(i)];
        const Positions points = joined(bent(k), turns);
        energy = elastic_energy(constraints_.own, points);
        for_each_kind(constraints_.elements, [&]<class Kind>(const ElementList<Kind>& list) {
          if constexpr (by_formula<Kind>) energy += elastic_energy(list, points);
        });
      } else {
        energy = energy_apart(constraints_.own, plane, d, curvature);
      }
      return energy / (0.5 * square(curvature) * area) / directions_.relative(d);
    };
    const ByDirection shares = in_all_directions(share_along);
    if (directions_.matters() && directions_.is_uniform()) {
      const Vector2 warp = directions_.axis(), weft(-warp.y(), warp.x());
      for (BendingFact& fact :
           facts_by_direction(share_along(warp), share_along(weft), share_along((warp + weft).normalized())))
        constraints_.facts.push_back(std::move(fact));
    }
    const auto [least, most] = std::ranges::minmax(shares);
    constraints_.facts.push_back({"large_deflection", mean(shares),
                                  "share of the stated B that the sheet has if its membrane forces it to a "
                                  "cylinder, mean over directions"});
    constraints_.facts.push_back(
        {"large_deflection_least", least, "smallest value of large_deflection over directions"});
    constraints_.facts.push_back(
        {"large_deflection_most", most, "largest value of large_deflection over directions"});
  }

  // Directors of three coordinates are normals, which are along z if the sheet lies in its plane.
  static Positions upright(const Directors& directors) {
    Positions rest = directors.rest;
    if (directors.coordinates == 3)
      for (auto row : rest.rowwise()) row = Eigen::RowVector3d(0, 0, row.norm());
    return rest;
  }

  // The energy of own elements if each is bent about its middle.
  static double energy_apart(const OwnElements& own, const std::vector<Vector2>& plane, const Vector2& d,
                             double curvature) {
    OwnElements apart = own;
    Positions bent(static_cast<Eigen::Index>(own.vertices.size()), 3);
    for (std::size_t c = 0, next = 0; c < own.size(); ++c) {
      const auto at = [&](int v) { return plane[static_cast<std::size_t>(v)]; };
      Vector2 middle = Vector2::Zero();
      for (const int v : own.corners(c)) middle += at(v) / static_cast<double>(own.arity);
      for (const int v : own.corners(c)) {
        const Vector2 q = at(v) - middle;
        apart.vertices[next] = static_cast<int>(next);
        bent.row(static_cast<Eigen::Index>(next++)) << q.x(), q.y(), 0.5 * curvature * square(q.dot(d));
      }
    }
    return elastic_energy(apart, bent);
  }

  // Reduces the difference between the rigidities of the relaxed sheet and of the cylinder. Hinges that fold
  // less in the relaxed sheet than in the cylinder get softer, and all other hinges get stiffer. The changes
  // follow the gradient of the energy that relaxing saves, which is convex in the stiffnesses. Then refit()
  // restores the energy of the cylinder. Measured on irregular sheets: after 8 rounds half of the difference
  // is left, and more rounds change nothing. On a grid, the changes would make the rigidity depend more on
  // the direction, so the hinges of a grid keep their factors.
  void agree(const SheetResponse& response, const std::vector<double>& energy) {
    constexpr int rounds = 8, refits = 2;
    const std::vector<double> before(linear_.factors().begin(), linear_.factors().end());
    auto answer = response(stencils_, linear_.factors());
    const double spread_before = answer ? spread(*answer) : 0;
    for (int round = 0; answer && round < rounds; ++round) {
      for (std::size_t c = 0; c < stencils_.size(); ++c) {
        const Eigen::RowVector3d now = answer->angles.row(static_cast<Eigen::Index>(c));
        const double cylinder =
            mean(in_all_directions([&](const Vector2& d) { return square(value_in(folds_[c], d)); }));
        const double relaxed = mean(in_all_directions([&](const Vector2& d) {
          return square(now(0) * d.x() * d.x() + now(1) * d.y() * d.y() + now(2) * d.x() * d.y());
        }));
        if (cylinder > 0) linear_.factors()[c] *= std::exp(std::clamp(relaxed / cylinder - 1, -1.0, 1.0));
      }
      linear_.refit(energy, refits);
      answer = response(stencils_, linear_.factors());
    }
    if (!answer || !(spread(*answer) < spread_before)) std::ranges::copy(before, linear_.factors().begin());
  }

  // The largest share of the stated rigidity divided by the smallest, over both deflections and all
  // directions.
  double spread(const SheetResponse::Answer& answer) const {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const Vector2& d : all_bending_directions())
      for (const Rigidity& sheet : {answer.unrelaxed, answer.relaxed}) {
        const double share = cylinder_rigidity(sheet, d) / directions_.relative(d);
        least = std::min(least, share), most = std::max(most, share);
      }
    return most / least;
  }

  double scale_for(const SheetResponse::Answer& answer) const {
    const auto share = [&](const Rigidity& rigidity_of) {
      return mean(in_all_directions([&](const Vector2& d) { return cylinder_rigidity(rigidity_of, d); })) /
             rigidity();
    };
    switch (target_.deflection) {
      case Deflection::large:
        break;
      case Deflection::small:
        return 1 / share(answer.relaxed);
      case Deflection::both:
        return 2 / (share(answer.relaxed) + share(answer.unrelaxed));
    }
    return 1;
  }

  std::vector<BendingFact> share_facts(const SheetResponse::Answer& answer, double scale) const {
    std::vector<BendingFact> facts;
    const auto add = [&](const std::string& name, const auto& rigidity_of, const std::string& meaning) {
      constexpr int directions = 36;
      double sum = 0, least = std::numeric_limits<double>::infinity(), most = 0;
      for (int k = 0; k < directions; ++k) {
        const double angle = std::numbers::pi * k / directions;
        const Vector2 d(std::cos(angle), std::sin(angle));
        const double share = scale * rigidity_of(d) / (rigidity() * directions_.relative(d));
        sum += share / directions, least = std::min(least, share), most = std::max(most, share);
      }
      facts.push_back({name, sum, meaning});
      facts.push_back({name + "_least", least, "smallest value of " + name + " over directions"});
      facts.push_back({name + "_most", most, "largest value of " + name + " over directions"});
    };
    add(
        "large_deflection", [&](const Vector2& d) { return cylinder_rigidity(answer.unrelaxed, d); },
        "share of the stated B that the sheet has if its membrane forces it to a cylinder, mean over "
        "directions");
    add(
        "small_deflection", [&](const Vector2& d) { return cylinder_rigidity(answer.relaxed, d); },
        "share of the stated B that the sheet has at deflections so small that its membrane does not matter, "
        "mean over directions");
    add(
        "small_strip", [&](const Vector2& d) { return strip_rigidity(answer.relaxed, d); },
        "share of the stated B that a narrow strip has at small deflections, where it may also curve across "
        "its width (Poisson's ratio), mean over directions");
    double poisson_ratio = 0;
    const Rigidity compliance = answer.relaxed.inverse();
    for (const Vector2& d : all_bending_directions()) {
      const Eigen::Vector3d along(d.x() * d.x(), d.y() * d.y(), 2 * d.x() * d.y()),
          across(d.y() * d.y(), d.x() * d.x(), -2 * d.x() * d.y());
      poisson_ratio -= across.dot(compliance * along) / along.dot(compliance * along) / bending_directions;
    }
    facts.push_back({"poisson_ratio", poisson_ratio,
                     "the Poisson's ratio that the hinges imply at small deflections, mean over directions"});
    facts.push_back({"small_deflection_ends", 4 * std::sqrt(rigidity()) / square(rest_.mean_edge_length()),
                     "this value divided by √Y is about the curvature in 1/m above which a membrane of "
                     "stiffness Y (N/m) forces the sheet to a cylinder",
                     "√(N/m)/m"});
    return facts;
  }

  // A hinge in a flat rest shape lies in the sheet's plane. In any other rest shape each hinge is unfolded
  // into a plane of its own. Such planes share no axes, so the hinge's energy is averaged over directions. If
  // B depends on the direction, every hinge is unfolded into a plane whose axis is the warp.
  template <class Energy>
  void add_hinge(StiffnessFit& fit, double& softness, const std::array<int, 4>& vertices,
                 const Energy& energy) {
    std::array<Vector2, 4> flat;
    std::array<Vector3, 4> p;
    for (std::size_t i = 0; i < 4; ++i) {
      p[i] = rest_.position(vertices[i]);
      if (!plane_.empty()) flat[i] = plane_[static_cast<std::size_t>(vertices[i])];
    }
    const QuadraticForm angle = fold(directions_.matters() ? directions_.unfolded_along_warp(vertices)
                                     : plane_.empty()      ? unfolded(p)
                                                           : flat);
    const Span span = hinge_span(vertices, pins_);
    ByDirection values =
        in_all_directions([&](const Vector2& d) { return energy(span.seen * value_in(angle, d)); });
    if (plane_.empty() && !directions_.matters()) values.fill(mean(values));
    fit.add(softness, values, span.shares);
    if (&fit != &linear_ || plane_.empty()) return;
    stencils_.push_back({vertices, fold_weights(flat), 2 * energy(1.0)});
    folds_.push_back(fold(flat));
  }

  void add(ElementList<HingeAngle>& list) {
    for (std::size_t c = 0; c < list.size(); ++c) {
      const double slope = HingeAngle::slope_at_rest(list.rest[c], list.law);
      add_hinge(linear_, list.softness[c], list.vertices[c],
                [&](double angle) { return 0.5 * square(slope * angle) / list.softness[c]; });
    }
  }

  void add(ElementList<QuadraticBend>& list) {
    const bool norm = list.law == QuadraticBend::Law::norm;
    for (std::size_t c = 0; c < list.size(); ++c) {
      if (!norm && list.rest[c][4] > 0)
        throw std::invalid_argument(
            "the energy of Bergou as a constraint is quartic in the curvature only if the rest shape is "
            "flat: set the model's \"constraint\" to \"norm\", or state the stiffness by k or compliance");
      const double slope = QuadraticBend::slope_at_rest(list.rest[c]);
      add_hinge(norm ? linear_ : quartic_, list.softness[c], list.vertices[c], [&](double angle) {
        return 0.5 * square(norm ? slope * angle : 0.5 * square(slope * angle)) / list.softness[c];
      });
    }
  }

  // `energy` is a function of the shortening. A spring along an edge is part of the membrane, and a spring
  // between pins resists nothing, so these springs have no bending energy.
  template <class Energy>
  void add_pair(StiffnessFit& fit, double& softness, const std::array<int, 2>& pair, const UnitBend& bend,
                const PairSpans& spans, const Energy& energy) {
    const Span span = spans(pair[0], pair[1]);
    if (span.shares.empty() || std::ranges::binary_search(rest_.one_ring()[pair[0]], pair[1]))
      return fit.add_without_energy(softness);
    const QuarticForm shorter = bend.shortening(pair[0], pair[1]);
    fit.add(softness, in_all_directions([&](const Vector2& d) {
              const Vector2 bent = directions_.matters() ? directions_.in_plane(pair[0], pair[1], d) : d;
              return energy(span.seen * value_in(shorter, bent));
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
    constexpr double at_rest = 1e-6;  // of its length
    const bool linear = target_.flexural_rigidity && !target_.at_curvature;
    list.softness.resize(list.size(), 1);
    for (std::size_t c = 0; c < list.size(); ++c) {
      const auto [a, b] = list.vertices[c];
      const double length = (rest_.position(a) - rest_.position(b)).norm(), push = list.rest(c) - length;
      // The energy is ½ (push + δ)². The part of this energy that is linear in δ is quadratic in κ, so a
      // spring that pushes has a moment linear in κ.
      if (linear && push > at_rest * length)
        add_pair(linear_, list.softness[c], list.vertices[c], bend, spans,
                 [&](double shorter) { return push * std::max(0.0, shorter) / list.softness[c]; });
      else if (std::abs(push) <= at_rest * length)
        add_pair(quartic_, list.softness[c], list.vertices[c], bend, spans,
                 [&](double shorter) { return 0.5 * square(shorter) / list.softness[c]; });
      else
        throw std::invalid_argument(fmt::format(
            "the spring between vertices {} and {} is not at rest in the rest shape ({:.6g} m "
            "apart, rest length {:.6g} m): set the model's \"rest_length\" to \"euclidean\", or state the "
            "stiffness by k or compliance",
            a, b, length, list.rest(c)));
    }
  }

  BendingConstraints& constraints_;
  const RestMesh& rest_;
  const Pins& pins_;
  std::vector<char> held_;
  const CalibrationTarget& target_;
  WarpField directions_;
  std::vector<Vector2> plane_;
  StiffnessFit linear_, quartic_;
  std::vector<HeightStencil> stencils_;  // of the hinges in linear_, if the rest shape is flat
  std::vector<QuadraticForm> folds_;     // fold angles over κ of these hinges
  std::optional<double> membrane_;
};

}  // namespace

void calibrate(BendingConstraints& constraints, const RestMesh& rest, const Pins& pins,
               const CalibrationTarget& target) {
  Calibration calibration(constraints, rest, pins, target);
  calibration.meet();
  calibration.scale_elements_by_formula();
}

}  // namespace bendlab
