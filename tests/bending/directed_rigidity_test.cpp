// Sheets whose rigidity depends on the direction, against the closed form of an orthotropic plate.
#include "bendlab/bending/directed_rigidity.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bendlab/bending/calibration.hpp"
#include "bendlab/mesh/delaunay.hpp"
#include "bendlab/mesh/generators.hpp"
#include "tests/bending/shapes.hpp"
#include "tests/catch.hpp"

namespace bendlab::directed_rigidity_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

constexpr double warp = 3e-5, weft = 1e-5, bias = 1.6e-5;

Vector2 direction(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle)};
}

DirectedSheet sheet(const TriangleMesh& mesh, const Vector3& axis, double poisson_ratio = 0) {
  return {orthotropic_rigidity(warp, weft, bias, poisson_ratio),
          warp_axes(mesh, inverse_rest_from_warp(mesh, axis))};
}

BendingConstraints calibrated(std::string_view model, const RestMesh& rest, const DirectedSheet& directed,
                              double poisson_ratio = 0) {
  const Pins none = make_pins(rest, {}, 0);
  BendingInput input{rest, none};
  input.directed = &directed, input.poisson_ratio = poisson_ratio;
  BendingConstraints constraints = constraints_of(BendingModel(*find_bending_model(model)), input);
  CalibrationTarget target{.flexural_rigidity = directed.rigidity.mean(), .directed = &directed};
  const BendingKind& kind = *find_bending_model(model);
  if (kind.springs_only && !kind.prestressed) target.at_curvature = 20;
  calibrate(constraints, rest, none, target);
  return constraints;
}

// The rigidity of a cylinder whose curved lines are at `degrees` to the x axis.
double rigidity(const BendingConstraints& constraints, const RestMesh& rest, double degrees) {
  const double curvature = 0.01, area = rest.triangle_count() * rest.areas().front();
  const double across = (degrees - 90) * std::numbers::pi / 180;
  return test::energy(constraints, test::bent(rest, curvature, across)) /
         (0.5 * curvature * curvature * area);
}

double fact(const BendingConstraints& constraints, std::string_view name) {
  const auto match = std::ranges::find(constraints.facts, name, &BendingFact::name);
  REQUIRE(match != constraints.facts.end());
  return match->value;
}

std::vector<std::pair<std::string, TriangleMesh>> meshes(int cells) {
  return {
      {"same", grid(1, 1, cells, cells, Diagonal::same)},
      {"alternating", grid(1, 1, cells, cells, Diagonal::alternating)},
      {"both", grid(1, 1, cells, cells, Diagonal::both)},
      {"equilateral", equilateral(1, std::sqrt(0.75), cells, Rows::parallel)},  // exactly `cells` rows
  };
}

}  // namespace

TEST_CASE("an orthotropic rigidity has the stated strips, and the D(φ) of the theory", "[bending]") {
  const OrthotropicRigidity d = orthotropic_rigidity(warp, weft, bias, 0.2);
  CHECK_THAT(d.strip(direction(0)), WithinRel(warp, 1e-14));
  CHECK_THAT(d.strip(direction(90)), WithinRel(weft, 1e-14));
  CHECK_THAT(d.strip(direction(45)), WithinRel(bias, 1e-14));
  double sum = 0;
  constexpr int samples = 12;  // exact for harmonics up to 4
  Eigen::Matrix3d matrix;
  matrix << d.warp, d.coupling, 0, d.coupling, d.weft, 0, 0, 0, d.twist;
  for (int k = 0; k < samples; ++k) {
    const Vector2 n = direction(180.0 * k / samples);
    sum += d.cylinder(n) / samples;
    // A cylinder with curved lines along n has κ = (c², s², 2 c s); a moment along n is (c², s², c s).
    const Eigen::Vector3d curvature(n.x() * n.x(), n.y() * n.y(), 2 * n.x() * n.y()),
        moment(n.x() * n.x(), n.y() * n.y(), n.x() * n.y());
    CHECK_THAT(d.product(curvature, curvature), WithinRel(d.cylinder(n), 1e-13));
    CHECK_THAT(1 / moment.dot(matrix.inverse() * moment), WithinRel(d.strip(n), 1e-13));
  }
  CHECK_THAT(d.mean(), WithinRel(sum, 1e-13));
  // An isotropic sheet has D = B / (1 - ν²) and D66 = (1 - ν) D / 2 without a bias, or with the bias B.
  for (const std::optional<double> stated : {std::optional<double>{}, std::optional(2.0)}) {
    const OrthotropicRigidity same = orthotropic_rigidity(2, 2, stated, 0.3);
    CHECK_THAT(same.twist, WithinRel(0.35 * 2 / 0.91, 1e-13));
    CHECK_THAT(same.cylinder(direction(33)), WithinRel(2 / 0.91, 1e-13));
    CHECK_THAT(same.strip(direction(33)), WithinRel(2.0, 1e-13));
  }
  // With ν = 0, a bias of 4 / (1/warp + 1/weft) needs an infinite resistance to twist.
  const double most = 4 / (1 / warp + 1 / weft);
  CHECK_NOTHROW(orthotropic_rigidity(warp, weft, 0.999 * most, 0));
  CHECK_THROWS_WITH(orthotropic_rigidity(warp, weft, 1.001 * most, 0), ContainsSubstring("below 3e-05"));
}

TEST_CASE("triangles that bend have the stated rigidity in every direction", "[bending]") {
  // Linearised, both models are exact for constant curvature, except in a strip along the border, where
  // directors relax. The strip is as wide as a cell is, so its part of the energy is e h - f h² with the size
  // of a cell h, and three sizes determine the energy without it. The strip ends gradually: at 8 cells, the
  // strips at opposite borders overlap by up to 5e-5 of the energy.
  for (const std::string_view model : {"mid_edge", "dkt"})
    for (std::size_t m = 0; m < meshes(2).size(); ++m) {
      std::vector<std::vector<double>> shares;  // by size of the cells: the shares of the stated rigidity
      for (const int cells : {8, 16, 32}) {
        const TriangleMesh mesh = meshes(cells)[m].second;
        const RestMesh rest(mesh);
        const DirectedSheet directed = sheet(mesh, {std::cos(0.3), std::sin(0.3), 0}, 0.2);
        const BendingConstraints constraints = calibrated(model, rest, directed, 0.2);
        const double turn = 0.3 * 180 / std::numbers::pi;
        shares.emplace_back();
        for (const double degrees : {0.0, 30.0, 45.0, 60.0, 90.0})
          shares.back().push_back(rigidity(constraints, rest, turn + degrees) /
                                  directed.rigidity.cylinder(direction(degrees)));
        for (const char* share : {"share_of_warp", "share_of_weft", "share_of_bias"})
          shares.back().push_back(fact(constraints, share));
      }
      for (std::size_t i = 0; i < shares[0].size(); ++i) {
        INFO(model << " " << meshes(2)[m].first << " " << i << ": " << shares[0][i] << " " << shares[1][i]
                   << " " << shares[2][i]);
        CHECK_THAT((shares[0][i] - 6 * shares[1][i] + 8 * shares[2][i]) / 3, WithinAbs(1, 1e-4));
      }
    }
}

TEST_CASE("a clamp does not change the share of the rigidity that a run reports", "[bending]") {
  // The share is that of the sheet when it is bent as a whole, also at its clamp.
  const RestMesh rest(grid(1, 1, 12, 12, Diagonal::alternating));
  const Pins clamp = make_pins(rest, select_vertices(rest, Place::left), 1);
  BendingConstraints constraints = constraints_of(BendingModel(*find_bending_model("dkt")), {rest, clamp});
  calibrate(constraints, rest, clamp, {.flexural_rigidity = 2e-5});
  CHECK_THAT(fact(constraints, "large_deflection"), WithinAbs(1, 2.0 / 12));  // border: as above
}

TEST_CASE("a sheet that states the same rigidity for all directions is the isotropic sheet", "[bending]") {
  for (const std::string_view model : {"mid_edge", "mid_edge_average", "corotational_face", "dkt"}) {
    const TriangleMesh mesh = delaunay(1, 1, 10, 3);
    const RestMesh rest(mesh);
    const Pins none = make_pins(rest, {}, 0);
    const DirectedSheet directed{orthotropic_rigidity(2e-5, 2e-5, std::nullopt, 0.3),
                                 warp_axes(mesh, inverse_rest_from_warp(mesh, {1, 2, 0}))};
    BendingInput input{rest, none};
    input.poisson_ratio = 0.3;
    BendingConstraints isotropic = constraints_of(BendingModel(*find_bending_model(model)), input);
    calibrate(isotropic, rest, none, {.flexural_rigidity = 2e-5 / (1 - 0.3 * 0.3)});
    const BendingConstraints same = calibrated(model, rest, directed, 0.3);
    const Positions pose = test::bent(rest, 0.5, 0.7);
    INFO(model);
    CHECK_THAT(test::energy(same, pose), WithinRel(test::energy(isotropic, pose), 1e-10));  // rounding
  }
}

TEST_CASE("the fit of hinges and springs reaches a rigidity that depends on the direction", "[bending]") {
  // A hinge of an equilateral lattice folds in proportion to cos² α - ⅓ sin² α, α from the normal of its edge
  // to the direction of bending. With any stiffnesses of the three families of edges at 0 and ±60 degrees,
  // the lattice has D(45°) = D(0°). With D22 = 1, D11 = 3 and D66 = 2 (in 10⁻⁵ N m) it can have all three
  // rigidities.
  const TriangleMesh mesh = equilateral(1, 1, 24, Rows::parallel);
  const RestMesh rest(mesh);
  const DirectedSheet possible{OrthotropicRigidity{3e-5, 1e-5, 0, 2e-5},
                               warp_axes(mesh, inverse_rest_from_warp(mesh, {1, 0, 0}))};
  CHECK_THAT(possible.rigidity.cylinder(direction(45)), WithinRel(3e-5, 1e-12));
  const BendingConstraints hinges = calibrated("discrete_shells", rest, possible);
  for (const char* share : {"share_of_warp", "share_of_weft", "share_of_bias"})
    CHECK_THAT(fact(hinges, share), WithinAbs(1, 0.03));
  // Springs to rings 1 and 2 have six families of directions. They come near a rigidity that hinges cannot
  // have.
  const BendingConstraints springs = calibrated("k_ring", rest, sheet(mesh, {1, 0, 0}));
  for (const char* share : {"share_of_warp", "share_of_weft", "share_of_bias"})
    CHECK_THAT(fact(springs, share), WithinAbs(1, 0.3));
}

TEST_CASE("a rigidity turns with the warp, also if texture coordinates state the warp", "[bending]") {
  TriangleMesh mesh = delaunay(1, 1, 12, 7);
  const double angle = 0.4, c = std::cos(angle), s = std::sin(angle);
  mesh.texture_coordinates.resize(3 * mesh.triangle_count(), 2);
  for (Eigen::Index t = 0; t < mesh.triangle_count(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const auto p = mesh.positions.row(mesh.triangles(t, corner));
      mesh.texture_coordinates.row(3 * t + corner) << 5 * (c * p(0) + s * p(1)), 2 * (c * p(1) - s * p(0));
    }
  const RestMesh rest(mesh);
  const DirectedSheet by_angle = sheet(mesh, {c, s, 0});
  const DirectedSheet by_texture{by_angle.rigidity, warp_axes(mesh, inverse_rest_from_texture(mesh))};
  for (const std::string_view model : {"mid_edge", "discrete_shells", "sparse_lod"}) {
    INFO(model);
    const BendingConstraints first = calibrated(model, rest, by_angle),
                             second = calibrated(model, rest, by_texture);
    const Positions pose = test::bent(rest, 0.5, 1.1);
    CHECK_THAT(test::energy(second, pose), WithinRel(test::energy(first, pose), 1e-9));  // rounding
  }
}

TEST_CASE("hinges of a curved rest shape take a rigidity by direction", "[bending]") {
  // A tube of equilateral triangles with edges around it, and its warp along the axis. It can have D(45°) =
  // D(90°) (as above, with warp and weft exchanged).
  const TriangleMesh mesh = tube(0.1, 0.1, 0.3, 24);
  const RestMesh rest(mesh);
  const DirectedSheet directed{OrthotropicRigidity{1e-5, 3e-5, 0, 2e-5},
                               warp_axes(mesh, inverse_rest_from_warp(mesh, {0, 0, 1}))};
  const BendingConstraints constraints = calibrated("discrete_shells", rest, directed);
  for (const char* share : {"share_of_warp", "share_of_weft", "share_of_bias"})
    CHECK_THAT(fact(constraints, share), WithinAbs(1, 0.1));
}

}  // namespace bendlab::directed_rigidity_test
