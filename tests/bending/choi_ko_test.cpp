// Choi and Ko's model on meshes: its pairs, their total rigidity, and that the pairs push but never pull.
#include <cmath>
#include <numbers>

#include "bendlab/constraints/energy.hpp"
#include "bendlab/constraints/kernels.hpp"
#include "bendlab/solver/colouring.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::choi_ko_test {
namespace {

using Catch::Matchers::WithinRel;

BendingConstraints choi_ko(const RestMesh& rest, int ring, ArcSpring::Law force = ArcSpring::Law::exact) {
  return constraints_of(ChoiKo{.ring = ring, .force = force}, {rest, make_pins(rest, {}, 0)});
}

// The lattice folded along parallel lattice lines, which lie at `angle` to x and h = √3/2 a apart. Strips
// between two lines stay flat, and neighbouring strips meet at the angle κ h.
Positions folded_in_strips(const RestMesh& rest, double curvature, double angle) {
  Positions positions = rest.positions();
  const double c = std::cos(angle), s = std::sin(angle);
  const double strip = std::numbers::sqrt3 / 2 * rest.mean_edge_length(), turn = curvature * strip;
  const Vector3 first = rest.position(0);  // lattice lines of every direction pass through it
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const Vector3 d = rest.position(v) - first;
    const double along = c * d.x() + s * d.y(), row = std::round((c * d.y() - s * d.x()) / strip);
    // Folded strips are the sides, of length h, of a polygon inscribed in a circle.
    const double radius = strip / (2 * std::sin(turn / 2));
    const double x = radius * std::sin(row * turn), z = radius * (1 - std::cos(row * turn));
    positions.row(v) << c * along - s * x, s * along + c * x, z;
  }
  return positions;
}

// 2 U / (κ² area) times a / k_b, for the pairs in the middle of the lattice. Each vertex has `per_vertex`
// pairs.
double rigidity(int ring, double per_vertex, double angle, ArcSpring::Law force = ArcSpring::Law::exact) {
  const RestMesh rest(equilateral(1, 1, 48));
  const BendingConstraints constraints = choi_ko(rest, ring, force);
  const auto& all = std::get<ElementList<ArcSpring>>(constraints.elements);
  ElementList<ArcSpring> middle{.law = all.law};
  for (std::size_t c = 0; c < all.size(); ++c) {
    // A pair belongs to its end with the lower number, so each vertex has one pair of every direction.
    const Vector3 at = rest.position(std::min(all.vertices[c][0], all.vertices[c][1])) - rest.centre();
    if (at.cwiseAbs().maxCoeff() > 0.25) continue;
    middle.vertices.push_back(all.vertices[c]);
    middle.rest.push_back(all.rest[c]);
    middle.softness.push_back(all.softness[c]);
  }
  const double a = rest.mean_edge_length(), curvature = 0.02 / a;
  const double area = static_cast<double>(middle.size()) / per_vertex * std::numbers::sqrt3 / 2 * a * a;
  const Positions positions = folded_in_strips(rest, curvature, angle);
  return 2 * elastic_energy(middle, positions) / (curvature * curvature * area) * a;
}

}  // namespace

TEST_CASE("choi_ko's flexural rigidity on the equilateral lattice", "[bending]") {
  // A pair of length L crosses n strips of height h, which are n equal sides of a polygon. To leading order
  // the pair shortens by δ = n² (n² - 1) h⁴ κ² / (24 L), and U = 12 k_b δ / L². With h⁴ = 9/16 a⁴ and the
  // area √3/2 a² per vertex, one pair per vertex adds
  //
  //     D = 2 U / (κ² area) = (9/16) (2/√3) n² (n² - 1) / (L/a)³ k_b/a.
  //
  // For a line of t edges in the direction of bending this is k_b / b (t² - 1)/t²: t = n, L = n h, b = √3/2
  // a² / L.
  const auto added = [](double n, double length) {
    return 9.0 / 16 * 2 / std::numbers::sqrt3 * n * n * (n * n - 1) / std::pow(length, 3);
  };
  const double line = std::numbers::sqrt3, width = std::numbers::sqrt3 / 2 / line;
  CHECK_THAT(added(2, line), WithinRel(0.75 / width, 1e-12));
  // (n, L/a) for half of the 12 vertices of ring 2: (0, 2), (1, √3) twice, (2, √3), (2, 2) twice.
  const double ring_2 = added(2, std::sqrt(3)) + 2 * added(2, 2);
  // For half of the 18 vertices of ring 3: (0, 3), (1, √7) twice, (2, √7) twice, (3, √7) twice, (3, 3) twice.
  const double ring_3 = 2 * added(2, std::sqrt(7)) + 2 * added(3, std::sqrt(7)) + 2 * added(3, 3);
  for (const double degrees : {0.0, 60.0, 120.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    INFO(degrees);
    // The next order is about (κ L)² / 40: 10⁻⁴ at κ L = 0.06.
    CHECK_THAT(rigidity(2, 6, angle), WithinRel(ring_2, 2e-4));
    CHECK_THAT(rigidity(3, 9, angle), WithinRel(ring_3, 2e-4));
    CHECK_THAT(rigidity(2, 6, angle, ArcSpring::Law::polynomial), WithinRel(12.112 / 12 * ring_2, 2e-4));
  }
}

TEST_CASE("choi_ko joins the vertices that are exactly `ring` edges apart", "[bending]") {
  // Three by three vertices; all diagonals are parallel to the line from (0, 0) to (1, 1). These pairs are
  // two edges apart: the ends of the six straight lines of two edges (three rows, three columns), the ends of
  // the long diagonal, the four knight's moves along the diagonal ((0,0)-(1,2), (0,0)-(2,1), (0,1)-(2,2),
  // (1,0)-(2,2)), and the four short antidiagonals, whose ends no edge joins.
  const RestMesh rest(grid(2, 2, 2, 2, Diagonal::same));
  const BendingConstraints constraints = choi_ko(rest, 2);
  const auto& list = std::get<ElementList<ArcSpring>>(constraints.elements);
  CHECK(constraints.distance.size() == 0);
  CHECK(list.size() == 6 + 1 + 4 + 4);
  for (std::size_t c = 0; c < list.size(); ++c) {
    const auto [a, b] = list.vertices[c];
    CHECK_THAT(list.rest[c][0], WithinRel((rest.position(a) - rest.position(b)).norm(), 1e-15));
  }
}

TEST_CASE("choi_ko resists closing a curved rest shape, not opening it", "[bending]") {
  const RestMesh flat(equilateral(1, 1, 12));
  TriangleMesh mesh = flat.mesh();
  mesh.positions = folded_in_strips(flat, 0.5 / flat.mean_edge_length(), 0);
  const RestMesh rest(mesh);
  for (const ArcSpring::Law force : {ArcSpring::Law::exact, ArcSpring::Law::polynomial}) {
    const auto energy = [&](const Positions& positions) {
      return elastic_energy(choi_ko(rest, 2, force).elements, positions);
    };
    // Chords of the turned shape equal those at rest up to rounding: 1 - r/L is a few ε, and each pair then
    // has the energy 12 k_b/L times that.
    const Eigen::Matrix3d turned = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized().toRotationMatrix();
    const Positions moved =
        (rest.positions() * turned.transpose()).rowwise() + Eigen::RowVector3d(0.4, -1, 2);
    const double closed = energy(folded_in_strips(flat, 0.7 / flat.mean_edge_length(), 0));
    CHECK(closed > 1);
    CHECK(energy(moved) <= 1e-9 * closed);
    CHECK(energy(flat.positions()) <= 1e-9 * closed);
    // Folding the shape to the other side costs the same energy: the shape opens first, then closes.
    CHECK_THAT(energy(folded_in_strips(flat, -0.7 / flat.mean_edge_length(), 0)), WithinRel(closed, 1e-9));
  }
}

}  // namespace bendlab::choi_ko_test
