// Moments that soften, rub or stay, against the closed forms of a sheet that is bent to a cylinder.
#include "bendlab/bending/moment_laws.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "bendlab/bending/calibration.hpp"
#include "bendlab/constraints/yielding.hpp"
#include "bendlab/mesh/delaunay.hpp"
#include "bendlab/mesh/generators.hpp"
#include "tests/bending/shapes.hpp"
#include "tests/catch.hpp"

namespace bendlab::moment_laws_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

constexpr double rigidity = 2e-5;

// A sheet whose cylinders have their curved lines along `degrees`.
class Sheet {
 public:
  Sheet(std::string_view model, const TriangleMesh& mesh, const MomentTarget& target, double degrees = 90)
      : rest_(mesh), pins_(make_pins(rest_, {}, 0)), angle_((degrees - 90) * std::numbers::pi / 180) {
    const BendingInput input{rest_, pins_};
    constraints_ = constraints_of(BendingModel(*find_bending_model(model)), input);
    calibrate(constraints_, rest_, pins_, {.flexural_rigidity = rigidity});
    set_moments(constraints_, input, target);
    for (const double of_triangle : rest_.areas()) area_ += of_triangle;
  }

  double energy(double curvature) const {  // per area
    return test::energy(constraints_, pose(curvature)) / area_;
  }
  // The moment per width, by the central difference of the energy.
  double moment(double curvature) const {
    const double step = 1e-4;
    return (energy(curvature + step) - energy(curvature - step)) / (2 * step);
  }
  void yield(double curvature) {
    const Positions bent = pose(curvature);
    const Directors& directors = constraints_.directors;
    yield_to(constraints_.elements, joined(bent, relaxed_directors(directors, constraints_.elements,
                                                                   constraints_.own, bent, directors.rest)));
  }
  // Bends the sheet to this curvature in small steps.
  void bend_to(double curvature) {
    constexpr int steps = 8;
    for (int k = 1; k <= steps; ++k) yield(at_ + k * (curvature - at_) / steps);
    at_ = curvature;
  }

 private:
  Positions pose(double curvature) const {
    return curvature == 0 ? rest_.positions() : test::bent(rest_, curvature, angle_);
  }

  RestMesh rest_;
  Pins pins_;
  BendingConstraints constraints_;
  double angle_, area_ = 0, at_ = 0;
};

// Small enough that a triangle turns by 0.03 rad at a curvature of 50 /m, so that tan and sine agree with the
// angle to 10⁻³. The half cells at the border of 16 cells are 1/16 of the sheet at each side.
TriangleMesh mesh(int cells = 16) {
  return grid(0.01 / 16 * cells, 0.01 / 16 * cells, cells, cells, Diagonal::alternating);
}

}  // namespace

TEST_CASE("a softening law has the moment that its numbers say, and the energy of this moment", "[bending]") {
  const SofteningLaw half{.half_at = 186, .curvatures = {}, .moments = {}};
  CHECK_THAT(half.moment(186), WithinRel(93.0, 1e-14));  // half of B κ
  const SofteningLaw table{.half_at = 0, .curvatures = {10, 40, 100}, .moments = {10, 25, 31}};
  CHECK_THAT(table.moment(5), WithinRel(5.0, 1e-14));
  CHECK_THAT(table.moment(25), WithinRel(17.5, 1e-14));
  CHECK_THAT(table.moment(200), WithinRel(41.0, 1e-14));  // the last slope, 0.1, goes on
  // Areas below the curve: a triangle and two trapezia.
  CHECK_THAT(table.energy(100), WithinRel(50 + 30 * 17.5 + 60 * 28, 1e-14));
  for (const SofteningLaw& law : {half, table})
    for (const double curvature : {1e-3, 3.0, 17.0, 70.0, 500.0}) {
      const double step = 1e-4 * curvature;
      CAPTURE(curvature);
      CHECK_THAT((law.energy(curvature + step) - law.energy(curvature - step)) / (2 * step),
                 WithinRel(law.moment(curvature), 1e-6));  // the difference has an error of step²
    }
}

TEST_CASE("a sheet that softens has the stated moment on cylinders", "[bending]") {
  const MomentTarget target{.rigidity = rigidity,
                            .softening = {.half_at = 100, .curvatures = {}, .moments = {}}};
  const MomentTarget linear{.rigidity = rigidity};
  // Relative to the linear sheet, so that the half cells at the border do not count.
  for (const std::string_view model : {"mid_edge", "mid_edge_average", "corotational_face", "laplacian"}) {
    const Sheet soft(model, mesh(), target), stiff(model, mesh(), linear);
    for (const double curvature : {5.0, 20.0, 50.0}) {
      // At the border, a Laplacian is not the curvature.
      if (model == "laplacian" && curvature > 5) continue;
      INFO(model << " " << curvature);
      // Triangles beside the border see less curvature and soften less: 1/16 of the sheet at each side.
      CHECK_THAT(soft.moment(curvature) / stiff.moment(curvature) * (1 + curvature / 100),
                 WithinAbs(1, 0.03));
    }
  }
  // Hinges soften right to first order, in the mean over the directions.
  double sum = 0, linear_sum = 0;
  constexpr int directions = 9;
  constexpr double curvature = 10;
  for (int k = 0; k < directions; ++k) {
    const double degrees = 180.0 * k / directions;
    sum += Sheet("discrete_shells", mesh(), target, degrees).moment(curvature);
    linear_sum += Sheet("discrete_shells", mesh(), linear, degrees).moment(curvature);
  }
  CHECK_THAT(sum / linear_sum * (1 + curvature / 100), WithinAbs(1, 0.02));
}

TEST_CASE("internal friction makes a closed loop of the stated height and area", "[bending]") {
  constexpr double friction = 4e-4, slip = 4, most = 60;  // HB / B is 20 /m
  const MomentTarget target{.rigidity = rigidity, .softening = {}, .hysteresis = Hysteresis{friction, slip}};
  const MomentTarget linear{.rigidity = rigidity};
  for (const std::string_view model : {"mid_edge", "mid_edge_average", "corotational_face"}) {
    INFO(model);
    Sheet sheet(model, mesh(8), target);
    const Sheet elastic(model, mesh(8), linear);
    // The share of the sheet that bends: the half cells at the border see less curvature.
    const double share = elastic.moment(1) / rigidity;
    const auto friction_at = [&](double curvature) {
      return sheet.moment(curvature) - elastic.moment(curvature);
    };
    CHECK_THAT(friction_at(0.5 * slip) / (share * friction), WithinAbs(0.5, 0.05));
    sheet.bend_to(most);
    CHECK_THAT(friction_at(most) / (share * friction), WithinAbs(1, 0.05));
    double area = 0, before = friction_at(most);
    constexpr int steps = 40;
    for (const double sign : {-1.0, 1.0})
      for (int k = 1; k <= steps; ++k) {
        const double from = -sign * most + sign * 2 * most * (k - 1) / steps,
                     to = -sign * most + sign * 2 * most * k / steps;
        sheet.yield(to);
        const double now = friction_at(to);
        area += 0.5 * (before + now) * (to - from);
        CHECK(std::abs(now) <= 1.05 * friction);
        before = now;
      }
    // Two branches at ±HB over 2 κ_max, less the slip of 2 κ_s at each reversal.
    CHECK_THAT(area / (share * 4 * friction * (most - slip)), WithinAbs(1, 0.05));
    // Let go: the elastic moment B κ cannot exceed the friction, so at most HB/B of curvature is left.
    sheet.bend_to(most);
    double left = most;
    while (left > 0 && sheet.moment(left) > 0) sheet.yield(left -= 0.5);
    // The elastic moment is larger than HB, so friction has reversed fully: B κ = HB. Steps of 0.5 /m.
    CHECK_THAT(left, WithinAbs(friction / rigidity, 0.5 + 0.05 * friction / rigidity));
  }
}

TEST_CASE("hinges have the stated friction and yield in the mean over the directions", "[bending]") {
  constexpr double friction = 4e-4, slip = 4, most = 60, yield = 15, hardening = 0.25;
  constexpr int directions = 9;
  const MomentTarget rubs{.rigidity = rigidity, .softening = {}, .hysteresis = Hysteresis{friction, slip}},
      folds{.rigidity = rigidity,
            .softening = {},
            .hysteresis = {},
            .plasticity = Plasticity{yield, hardening}},
      linear{.rigidity = rigidity};
  for (const std::string_view model : {"discrete_shells", "dihedral"}) {
    INFO(model);
    double elastic = 0, with_friction = 0, yielded = 0;
    for (int k = 0; k < directions; ++k) {
      const double degrees = 180.0 * k / directions;
      Sheet rubbing(model, mesh(), rubs, degrees), folding(model, mesh(), folds, degrees);
      rubbing.bend_to(most), folding.bend_to(most);
      elastic += Sheet(model, mesh(), linear, degrees).moment(most);
      with_friction += rubbing.moment(most), yielded += folding.moment(most);
    }
    const double share = elastic / (directions * rigidity * most);  // border hinges are missing
    // Hinges that hardly turn have not slipped fully at 15 times the slip.
    CHECK_THAT((with_friction - elastic) / (directions * share * friction), WithinAbs(1, 0.05));
    // The yield is stated for curvatures far above it; at 4 times, flat hinges are still elastic.
    CHECK_THAT(yielded / (directions * share),
               WithinRel(rigidity * (yield + hardening * (most - yield)), 0.1));
  }
}

TEST_CASE("a fold that yields keeps the set that the formula says", "[bending]") {
  constexpr double yield = 15, hardening = 0.25, most = 55;
  const MomentTarget target{
      .rigidity = rigidity, .softening = {}, .hysteresis = {}, .plasticity = Plasticity{yield, hardening}};
  for (const std::string_view model : {"mid_edge", "corotational_face"}) {
    INFO(model);
    Sheet sheet(model, mesh(), target);
    const double share = Sheet(model, mesh(), {.rigidity = rigidity}).moment(1) / rigidity;
    CHECK_THAT(sheet.moment(10) / share, WithinRel(rigidity * 10, 0.01));
    sheet.bend_to(most);
    CHECK_THAT(sheet.moment(most) / share, WithinRel(rigidity * (yield + hardening * (most - yield)), 0.05));
    // Unbent along the first slope, the moment is 0 at κ - M/B.
    double left = most;
    while (sheet.moment(left) > 0) left -= 0.25;
    CHECK_THAT(left, WithinAbs((1 - hardening) * (most - yield), 0.05 * most));
    // Bent again, it yields where it stopped.
    CHECK_THAT(sheet.moment(most - 5) / share,
               WithinRel(rigidity * (yield + hardening * (most - yield) - 5), 0.05));
  }
}

TEST_CASE("yielding never gives energy back that friction took", "[bending]") {
  // Through any path, the work of the moment is at least the change of the energy.
  const MomentTarget target{.rigidity = rigidity, .softening = {}, .hysteresis = Hysteresis{4e-4, 4}};
  Sheet sheet("mid_edge", mesh(), target);
  double lost = 0;
  for (const double to : {30.0, 10.0, 45.0, -20.0, -15.0, 5.0}) {
    const double before = sheet.energy(to);
    sheet.yield(to);
    lost += before - sheet.energy(to);
    CHECK(before >= sheet.energy(to) * (1 - 1e-12));  // rounding
  }
  CHECK(lost > 0);
}

TEST_CASE("models whose curvature is not known refuse nonlinear moments", "[bending]") {
  const MomentTarget friction{.rigidity = rigidity, .softening = {}, .hysteresis = Hysteresis{4e-4, 4}},
      softening{.rigidity = rigidity, .softening = {.half_at = 100, .curvatures = {}, .moments = {}}};
  for (const std::string_view model : {"prestressed", "choi_ko", "dkt"})
    CHECK_THROWS_WITH(Sheet(model, mesh(), softening), ContainsSubstring("hinges or of triangles"));
  for (const std::string_view model : {"isometric", "laplacian", "bridson"})
    CHECK_THROWS_WITH(Sheet(model, mesh(), friction), ContainsSubstring("has a sign"));
}

}  // namespace bendlab::moment_laws_test
