// Meshes are laid on the curve of a strip whose stiffness is known, and the stiffness is measured from this
// shape.
#include "bendlab/metrics/stiffness.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "bendlab/mesh/generators.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/metrics/elastica.hpp"
#include "tests/catch.hpp"

namespace bendlab::metrics_stiffness_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

struct CurvePoint {
  double gamma, reach, drop;  // Γ, W/L, H/L
};

// Ten rows of the curve, computed for this project by collocation (scipy's solve_bvp, tolerance 1e-10).
// Shooting with DOP853 agrees to ten digits.
constexpr CurvePoint linear_curve[] = {
    {1.00000000e-02, 0.9999991071, 0.0012499984}, {5.01187234e-02, 0.9999775736, 0.0062646437},
    {1.99526231e-01, 0.9996448313, 0.0249283786}, {1.00000000e+00, 0.9912463953, 0.1234714020},
    {5.01187234e+00, 0.8461406066, 0.4966640005}, {1.99526231e+01, 0.4458927273, 0.8295707210},
    {1.00000000e+02, 0.1592233826, 0.9375239354}, {5.01187234e+02, 0.0658083125, 0.9731497422},
    {1.99526231e+03, 0.0322767134, 0.9867209813}, {1.00000000e+04, 0.0142608898, 0.9941099339},
};

// Ten rows of the curve of m = C κ³ (θ'³' = -Γ (1 - s) cos θ), computed by shooting with DOP853. The minimum
// of the energy of a chain of 400 links agrees to five digits. From Γ = 178 on, the free end hangs exactly
// straight.
constexpr CurvePoint cubic_curve[] = {
    {1.00000000e-03, 0.9994551293, 0.0297509922}, {1.00000000e-02, 0.9974757815, 0.0639965627},
    {1.00000000e-01, 0.9883869536, 0.1368868325}, {1.00000000e+00, 0.9482195963, 0.2854808190},
    {1.00000000e+01, 0.7970303033, 0.5380737481}, {1.00000000e+02, 0.4645137229, 0.7762458838},
    {1.00000000e+03, 0.2358171060, 0.8823034913}, {1.00000000e+04, 0.1283063303, 0.9354718926},
    {1.00000000e+05, 0.0710349236, 0.9641622489}, {1.00000000e+06, 0.0396239115, 0.9799786779},
};

// The middle line of a strip of length 1 with m = κ^p / Γ under unit weight. It is integrated by the midpoint
// rule from the clamp on, and bisection finds the moment at the clamp. The program uses another method and
// the other direction.
struct Curve {
  std::vector<double> x, z;  // at equal steps of s, z downward

  Vector3 at(double s, double y) const {
    if (s <= 0) return {s, y, 0};
    const double place = s * static_cast<double>(x.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(place), x.size() - 2);
    const double part = place - static_cast<double>(i);
    return {x[i] + part * (x[i + 1] - x[i]), y, -(z[i] + part * (z[i + 1] - z[i]))};
  }
};

Curve integrated(double gamma, double p, double clamp_moment, double& end_moment) {
  constexpr int steps = 20000;
  constexpr double ds = 1.0 / steps;
  const auto curvature = [&](double m) { return std::copysign(std::pow(std::abs(m) * gamma, 1 / p), m); };
  Curve curve{{0}, {0}};
  double angle = 0, m = clamp_moment;
  for (int i = 0; i < steps; ++i) {
    const double s = i * ds;
    const double half_angle = angle + 0.5 * ds * curvature(m),
                 half_m = m - 0.5 * ds * (1 - s) * std::cos(angle);
    angle += ds * curvature(half_m);
    m -= ds * (1 - s - 0.5 * ds) * std::cos(half_angle);
    curve.x.push_back(curve.x.back() + ds * std::cos(half_angle));
    curve.z.push_back(curve.z.back() + ds * std::sin(half_angle));
  }
  end_moment = m;
  return curve;
}

Curve heavy_curve(double gamma, double p) {
  double low = 0, high = 0.5, end = 0;  // the moment of a horizontal strip is 1/2
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    integrated(gamma, p, middle, end);
    (end > 0 ? high : low) = middle;
  }
  return integrated(gamma, p, 0.5 * (low + high), end);
}

// A strip of free length 1. The edge of its clamp is at x = 0.
struct Strip {
  std::string name;
  RestMesh rest;
  std::vector<char> pinned;
};

// `edge` of the clamp and `last` pinned vertices are x coordinates from the left end of the mesh. The free
// end zigzags by `zigzag`.
Strip strip(std::string name, TriangleMesh mesh, double edge, double last, double zigzag = 0) {
  auto x = mesh.positions.col(0).array();
  x -= x.minCoeff() + edge;
  const double length = x.maxCoeff() - 0.5 * zigzag;
  mesh.positions /= length;
  Strip result{std::move(name), RestMesh(std::move(mesh)), {}};
  for (int v = 0; v < result.rest.vertex_count(); ++v)
    result.pinned.push_back(result.rest.position(v).x() < (last - edge) / length + 1e-9);
  return result;
}

// The same strip on every kind of mesh, about 48 edges long. If the rows of a lattice run along the strip,
// the edge of the clamp and the free end zigzag by half an edge.
std::vector<Strip> strips() {
  constexpr double cell = 1.0 / 50, along = 1.0 / 50, across = 1.0 / 44,
                   row = across * std::numbers::sqrt3 / 2;
  std::vector<Strip> all;
  all.push_back(strip("grid", grid(1, 0.6, 50, 30), 2 * cell, 2 * cell));
  all.push_back(strip("grid, both diagonals", grid(1, 0.6, 50, 30, Diagonal::both), 2 * cell, 2 * cell));
  all.push_back(
      strip("lattice, rows across", equilateral(1, 0.6, 44, Rows::perpendicular), 3 * row, 3 * row));
  all.push_back(strip("lattice, rows along", equilateral(1, 0.6, 50, Rows::parallel), 1.75 * along, 2 * along,
                      0.5 * along));
  all.push_back(strip("delaunay", delaunay(1, 0.6, 48, 7), 0, 0));
  return all;
}

Positions laid_on(const Curve& curve, const Strip& strip) {
  Positions positions = strip.rest.positions();
  for (int v = 0; v < strip.rest.vertex_count(); ++v)
    if (const Vector3 at = strip.rest.position(v); !strip.pinned[static_cast<std::size_t>(v)])
      positions.row(v) = curve.at(at.x(), at.y()).transpose();
  return positions;
}

const StripLoad unit_load{1, Vector3(0, 0, -1)};

std::string refusal(const RestMesh& rest, std::vector<int> pins, int ring,
                    const StripLoad& load = unit_load) try {
  const StiffnessMeter meter(rest, make_pins(rest, std::move(pins), ring).is_pinned, load);
  return "none";
} catch (const std::invalid_argument& error) {
  return error.what();
}

}  // namespace

TEST_CASE("the curves of the hanging strip agree with tables and asymptotes", "[stiffness]") {
  // The tables have ten decimals, 4e-8 of the smallest drop. Γ of the cubic law depends on up to the fourth
  // power of the drop.
  for (const CurvePoint& point : linear_curve) {
    const HangingStrip strip = hanging_strip(BendingLaw::linear, point.drop / point.reach);
    CHECK_THAT(strip.gamma, WithinRel(point.gamma, 1e-6));
    CHECK_THAT(strip.reach, WithinRel(point.reach, 1e-6));
  }
  for (const CurvePoint& point : cubic_curve) {
    const HangingStrip strip = hanging_strip(BendingLaw::cubic, point.drop / point.reach);
    CHECK_THAT(strip.gamma, WithinRel(point.gamma, 1e-6));
    CHECK_THAT(strip.reach, WithinRel(point.reach, 1e-6));
  }
  // ASTM D1388: a strip whose chord falls by 41.5° is twice as long as its bending length, so Γ = 8 (exactly
  // 8.0042).
  CHECK_THAT(hanging_strip(BendingLaw::linear, std::tan(41.5 * std::numbers::pi / 180)).gamma,
             WithinAbs(8.004, 0.005));
  // For small loads H/L = Γ/8 and (3/8) (Γ/2)^(1/3); the next order is about (H/W)². For large loads the
  // moment acts only at the clamp, H/W = √(Γ/2) and W/L = 1.2408 Γ^(-1/4); the next order is about 1 / (H/W).
  for (const double ratio : {1e-5, 1e-3}) {
    CHECK_THAT(hanging_strip(BendingLaw::linear, ratio).gamma, WithinRel(8 * ratio, 1e-5));
    CHECK_THAT(hanging_strip(BendingLaw::cubic, ratio).gamma,
               WithinRel(2 * std::pow(8 * ratio / 3, 3), 1e-5));
  }
  const HangingStrip limp = hanging_strip(BendingLaw::linear, 300),
                     limp_springs = hanging_strip(BendingLaw::cubic, 300);
  CHECK_THAT(std::sqrt(limp.gamma / 2), WithinRel(300, 0.01));
  CHECK_THAT(limp_springs.reach * std::pow(limp_springs.gamma, 0.25), WithinRel(1.2408, 0.005));
  // The exponents of the asymptotes.
  CHECK_THAT(amplification(BendingLaw::linear, 1e-3), WithinAbs(1, 1e-4));
  CHECK_THAT(amplification(BendingLaw::linear, 300), WithinAbs(2, 0.01));
  CHECK_THAT(amplification(BendingLaw::cubic, 1e-3), WithinAbs(3, 1e-4));
  CHECK_THAT(amplification(BendingLaw::cubic, 300), WithinAbs(4, 0.02));
  for (const double outside : {0.0, -1.0, 1e3, std::nan("")})
    CHECK_THROWS_AS(hanging_strip(BendingLaw::linear, outside), std::invalid_argument);
}

TEST_CASE("the curve of springs is smooth where the free end begins to hang straight", "[stiffness]") {
  // At Γ = 178 the free end is described differently. The slope there is still between the slopes on both
  // sides. Steps are small enough for the bend of the curve and large compared with the error of 1e-7.
  double before = 0, last = 0;
  for (double ratio = 1.5; ratio < 2.6; ratio *= 1.002) {
    const double gamma = std::log(hanging_strip(BendingLaw::cubic, ratio).gamma);
    const double slope = (gamma - last) / std::log(1.002);
    if (before > 0) CHECK_THAT(slope, WithinAbs(before, 0.02));
    if (last > 0) before = slope;
    last = gamma;
  }
}

TEST_CASE("a strip laid on the heavy elastica has its flexural rigidity", "[stiffness]") {
  for (const double gamma : {1.0, 10.0, 100.0}) {
    const Curve curve = heavy_curve(gamma, 1);
    for (const Strip& strip : strips()) {
      INFO(strip.name << ", gamma " << gamma);
      const StiffnessMeter meter(strip.rest, strip.pinned, unit_load);
      const StripStiffness stiffness = meter.measure(laid_on(curve, strip), {.exclude = 0.06});
      CHECK_THAT(stiffness.length, WithinRel(1, 1e-9));
      // The curve is replaced by 50 chords, whose middle is off by h²κ/8. The error is a few thousandths.
      CHECK_THAT(stiffness.flexural_rigidity, WithinRel(1 / gamma, 0.005));
      CHECK_THAT(stiffness.fit.exponent, WithinAbs(1, 0.01));
      CHECK_THAT(stiffness.fit.rigidity, WithinRel(1 / gamma, 0.005));
    }
  }
}

TEST_CASE("a strip laid on the curve of springs has the cubic law of springs", "[stiffness]") {
  for (const double gamma : {1.0, 10.0, 100.0}) {
    const Curve curve = heavy_curve(gamma, 3);
    for (const Strip& strip : strips()) {
      INFO(strip.name << ", gamma " << gamma);
      const StiffnessMeter meter(strip.rest, strip.pinned, unit_load);
      const StripStiffness stiffness = meter.measure(laid_on(curve, strip), {.exclude = 0.06});
      CHECK_THAT(stiffness.quartic, WithinRel(1 / gamma, 0.01));
      CHECK_THAT(stiffness.fit.exponent, WithinAbs(3, 0.03));
      CHECK_THAT(stiffness.fit.quartic, WithinRel(1 / gamma, 0.01));
    }
  }
}

// The angles of a chain of rigid links in equilibrium, from the clamp on. Rows are h = 1 / links apart. At
// each row, also at the clamp, the moment per width is m = κ^p / Γ with κ = turn / h. Hinges on rows of a
// lattice, or springs over two rows, behave like this. The equilibrium is computed link by link from the free
// end, whose angle is such that the clamp is horizontal.
std::vector<double> chain_in_balance(const std::vector<double>& stiffness_of_row, double gamma, double p) {
  const int links = static_cast<int>(stiffness_of_row.size());
  const double h = 1.0 / links;
  std::vector<double> angles(static_cast<std::size_t>(links));
  double low = 0, high = 0.5 * std::numbers::pi;
  for (int halving = 0; halving < 60; ++halving) {
    double angle = 0.5 * (low + high), moment = 0;
    for (int link = links - 1; link >= 0; --link) {
      angles[static_cast<std::size_t>(link)] = angle;
      moment +=
          h * std::cos(angle) * h * (links - 1 - link + 0.5);  // weight beyond the link, and half its own
      angle -= h * std::pow(moment * gamma / stiffness_of_row[static_cast<std::size_t>(link)], 1 / p);
    }
    (angle > 0 ? high : low) = 0.5 * (low + high);
  }
  return angles;
}

// The measured stiffness of a grid laid on this chain. The clamp acts half a row behind its edge.
StripStiffness measured_chain(const std::vector<double>& stiffness_of_row, double gamma, double p) {
  const int links = static_cast<int>(stiffness_of_row.size());
  const double clamped = 2.0 / (links + 2);
  const Strip strip =
      metrics_stiffness_test::strip("", grid(1, 0.6, links + 2, 3 * (links + 2) / 5), clamped, clamped);
  std::vector<Vector3> rows = {Vector3::Zero()};
  for (const double angle : chain_in_balance(stiffness_of_row, gamma, p))
    rows.push_back(rows.back() + Vector3(std::cos(angle), 0, -std::sin(angle)) / links);
  Positions shape = strip.rest.positions();
  for (int v = 0; v < strip.rest.vertex_count(); ++v)
    if (const auto row = std::lround(strip.rest.position(v).x() * links); row > 0) {
      shape.row(v) = rows[static_cast<std::size_t>(row)].transpose();
      shape(v, 1) = strip.rest.position(v).y();
    }
  return StiffnessMeter(strip.rest, strip.pinned, unit_load).measure(shape, {.clamp_offset = 0.5 / links});
}

TEST_CASE("a chain of rigid links in equilibrium has the measured stiffness of its hinges", "[stiffness]") {
  for (const double p : {1.0, 3.0})
    for (const double gamma : {1.0, 10.0}) {
      INFO("p " << p << ", gamma " << gamma);
      const StripStiffness stiffness = measured_chain(std::vector<double>(25, 1.0), gamma, p);
      // The moment comes from the weight of the chain, so the fit is exact, except that slices are slightly
      // off the rows.
      CHECK_THAT(stiffness.fit.exponent, WithinAbs(p, 1e-5));
      CHECK_THAT(stiffness.fit.coefficient * gamma, WithinRel(1, 1e-5));
      CHECK(stiffness.fit.residual < 1e-5);
      // With the clamp half a row behind its edge, the error is of second order in h = 1/25. Without this
      // offset, the errors of B and C are 8 and 15 %.
      CHECK_THAT((p == 1 ? stiffness.flexural_rigidity : stiffness.quartic) * gamma, WithinRel(1, 0.005));
    }
}

TEST_CASE("the fit finds the law although every second row is stiffer", "[stiffness]") {
  // The same chain with every second hinge 1.5 times as stiff. Hinges in series have a mean of 1.2; the
  // geometric mean √1.5 is 2 % larger. If each row were fitted alone, the residual would be a fifth.
  constexpr int links = 49;
  std::vector<double> stiffness_of_row(links);
  for (int row = 0; row < links; ++row)
    stiffness_of_row[static_cast<std::size_t>(row)] = row % 2 == 0 ? 1 : 1.5;
  const MomentCurvatureFit fit = measured_chain(stiffness_of_row, 10, 1).fit;
  CHECK_THAT(fit.exponent, WithinAbs(1, 0.005));
  CHECK_THAT(fit.rigidity * 10, WithinRel(std::sqrt(1.5), 0.005));
  CHECK(fit.residual < 0.01);
}

TEST_CASE("bending across a strip does not change the measured bending along it", "[stiffness]") {
  // κ_y = 0.3 lowers the sides more than the middle. Every second row is an edge wider, so its mean is lower.
  // If whole rows were used, the measured curvature would jump by more than its value from row to row.
  const Curve curve = heavy_curve(1, 1);
  const auto all = strips();
  const Strip& strip = *std::ranges::find(all, "lattice, rows across", &Strip::name);
  Positions shape = laid_on(curve, strip);
  const StiffnessMeter meter(strip.rest, strip.pinned, unit_load);
  const MomentCurvatureFit straight = meter.measure(shape, {.exclude = 0.06}).fit;
  for (int v = 0; v < strip.rest.vertex_count(); ++v)
    if (!strip.pinned[static_cast<std::size_t>(v)])
      shape(v, 2) -= 0.15 * std::pow(strip.rest.position(v).y(), 2);
  const MomentCurvatureFit across = meter.measure(shape, {.exclude = 0.06}).fit;
  CHECK_THAT(across.exponent, WithinAbs(straight.exponent, 0.01));
  CHECK_THAT(across.rigidity, WithinRel(straight.rigidity, 0.005));
  CHECK(across.residual < 0.01);
}

TEST_CASE("the measured stiffness does not depend on place, direction and unit of length", "[stiffness]") {
  const Curve curve = heavy_curve(10, 1);
  const Strip at_home = strip("", grid(1, 0.6, 26, 15), 2.0 / 26, 2.0 / 26);
  constexpr double unit = 0.02;  // m
  const Positions shape = laid_on(curve, at_home);
  const StripStiffness here = StiffnessMeter(at_home.rest, at_home.pinned, unit_load).measure(shape);
  CHECK_THAT(here.amplification, WithinAbs(1.2042, 1e-3));  // the table's slope at Γ = 10
  // Rounding moves vertices of a row to either side of the row, and differently for each direction.
  for (const double angle : {1.1, 0.3, 0.7, 1.9, 2.3, 2.9}) {
    CAPTURE(angle);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vector3(1, 2, 3).normalized()).toRotationMatrix();
    const auto moved = [&](const Positions& positions) {
      return Positions((unit * positions * turn.transpose()).rowwise() + Eigen::RowVector3d(3, -1, 2));
    };
    const RestMesh rest({moved(at_home.rest.positions()), at_home.rest.triangles(), {}});
    const StripStiffness there =
        StiffnessMeter(rest, at_home.pinned, {0.2, 9.81 * turn * Vector3(0, 0, -1)}).measure(moved(shape));
    constexpr double rounding = 1e-8;  // 10⁻¹⁶ · 3 m / 0.02 m, squared for a curvature
    for (std::size_t i = 0; i < here.profile.size(); ++i)
      CHECK(there.profile.at(i).fitted == here.profile[i].fitted);
    CHECK_THAT(there.height_over_width, WithinRel(here.height_over_width, rounding));
    CHECK_THAT(there.flexural_rigidity,
               WithinRel(0.2 * 9.81 * std::pow(unit, 3) * here.flexural_rigidity, rounding));
    CHECK_THAT(there.quartic, WithinRel(0.2 * 9.81 * std::pow(unit, 5) * here.quartic, rounding));
    CHECK_THAT(there.fit.quartic, WithinRel(0.2 * 9.81 * std::pow(unit, 5) * here.fit.quartic, rounding));
    CHECK_THAT(there.fit.exponent, WithinRel(here.fit.exponent, rounding));
    CHECK_THAT(there.bending_length, WithinRel(unit * std::cbrt(here.flexural_rigidity), rounding));
  }
}

TEST_CASE("the offset of a clamp that acts behind its edge is added to the length", "[stiffness]") {
  // The curve of Γ = 1 begins a hundredth of its length behind the edge. Without the offset the error of B
  // would be 4 %.
  constexpr double offset = 0.01;
  const Curve curve = heavy_curve(1, 1);
  const Strip strip = strips().front();
  Positions shape = strip.rest.positions();
  for (int v = 0; v < strip.rest.vertex_count(); ++v)
    if (!strip.pinned[static_cast<std::size_t>(v)]) {
      const Vector3 at = curve.at((strip.rest.position(v).x() + offset) / (1 + offset), 0) * (1 + offset);
      shape.row(v) << at.x() - offset, strip.rest.position(v).y(), at.z();
    }
  const StiffnessMeter meter(strip.rest, strip.pinned, unit_load);
  const StripStiffness stiffness = meter.measure(shape, {.clamp_offset = offset});
  CHECK_THAT(stiffness.effective_length, WithinRel(1 + offset, 1e-12));
  // At the edge the curve has dropped by κ offset² / 2 = 2e-5, while its whole drop is 0.12.
  CHECK_THAT(stiffness.flexural_rigidity, WithinRel(std::pow(1 + offset, 3), 1e-3));
  CHECK(meter.height_over_width(shape, offset) == stiffness.height_over_width);
}

TEST_CASE("the fit leaves out curvatures near rounding, near the clamp and near the free end",
          "[stiffness]") {
  const Strip strip = strips().front();
  const Positions shape = laid_on(heavy_curve(1, 1), strip);
  const auto fitted = [&](const StripOptions& options) {
    std::vector<double> s;
    for (const ProfileRow& row :
         StiffnessMeter(strip.rest, strip.pinned, unit_load).measure(shape, options).profile)
      if (row.fitted) s.push_back(row.s);
    return s;
  };
  CHECK(fitted({}).front() < 0.03);
  CHECK(fitted({.exclude = 0.1}).front() > 0.1);
  CHECK(fitted({.exclude = 0.1}).back() < 0.9);
  // At Γ = 1 the curvature falls from about 0.49 to 0 like (1 - s)². A stated rounding of 0.12 h² / 80 leaves
  // only the first half for the fit.
  const double row = 1.0 / 48;
  CHECK_THAT(fitted({.rounding = 0.12 * row * row / 80}).back(), WithinAbs(0.5, 0.03));
  CHECK(fitted({.rounding = 1}).empty());
}

TEST_CASE("a scene that is no clamped strip is refused with the reason", "[stiffness]") {
  const RestMesh rest(grid(1, 0.5, 16, 8));
  const auto left = select_vertices(rest, Place::left), right = select_vertices(rest, Place::right);
  std::vector<int> both = left;
  both.insert(both.end(), right.begin(), right.end());
  CHECK(refusal(rest, left, 0) == "none");
  CHECK(refusal(rest, left, 2) == "none");
  CHECK(refusal(rest, right, 1) == "none");
  CHECK(refusal(rest, select_vertices(rest, Place::bottom), 1) == "none");
  CHECK_THAT(refusal(rest, {}, 0), ContainsSubstring("no vertex is pinned"));
  CHECK_THAT(refusal(rest, both, 1), ContainsSubstring("more than one side"));
  CHECK_THAT(refusal(rest, select_vertices(rest, Place::centre), 2), ContainsSubstring("in the middle"));
  CHECK_THAT(refusal(rest, select_vertices(rest, Place::upper_right), 0), ContainsSubstring("no side"));
  CHECK_THAT(refusal(rest, select_vertices(rest, Place::upper_right), 3), ContainsSubstring("not straight"));
  CHECK_THAT(refusal(rest, select_vertices(rest, Place::upper_right), 1),
             ContainsSubstring("pin one whole side"));
  CHECK_THAT(refusal(rest, left, 13), ContainsSubstring("edges long"));
  CHECK_THAT(refusal(rest, left, 16), ContainsSubstring("no side"));
  CHECK_THAT(refusal(rest, left, 1, {0, Vector3(0, 0, -9.81)}), ContainsSubstring("density"));
  CHECK_THAT(refusal(rest, left, 1, {0.2, Vector3::Zero()}), ContainsSubstring("no gravity"));
  CHECK_THAT(refusal(rest, left, 1, {0.2, Vector3(0, -9.81, 0)}), ContainsSubstring("flat and horizontal"));
  TriangleMesh tapered = rest.mesh();
  tapered.positions.col(1).array() *= 0.55 - tapered.positions.col(0).array();  // 1.05 to 0.05 wide
  CHECK_THAT(refusal(RestMesh(tapered), left, 1), ContainsSubstring("same width"));

  const StiffnessMeter meter(rest, make_pins(rest, left, 1).is_pinned, unit_load);
  Positions shape = rest.positions();
  CHECK(std::isnan(meter.measure(shape).flexural_rigidity));  // the strip has not dropped
  CHECK(meter.measure(shape).fit.samples == 0);
  shape.row(rest.vertex_count() - 1).setConstant(std::nan(""));
  CHECK_THROWS_AS(meter.measure(shape), std::invalid_argument);
  CHECK_THROWS_AS(meter.measure(Positions(shape.topRows(5))), std::invalid_argument);
  shape = rest.positions().array() + 1e-3;
  CHECK_THROWS_AS(meter.measure(shape), std::invalid_argument);  // the clamp has moved
}

}  // namespace bendlab::metrics_stiffness_test
