// Quadratic bending of inextensible sheets.
#include <Eigen/Geometry>

#include "bendlab/bending/models.hpp"
#include "bendlab/bending/rest_hinges.hpp"
#include "bendlab/settings/names.hpp"

namespace bendlab {
namespace isometric_model {

constexpr std::array fields = {
    field<&Isometric::constraint>(
        {.name = "constraint",
         .meaning = "C = |Kx|, whose XPBD energy is Bergou's energy; or C = ½ xᵀQx, Bergou's energy itself "
                    "as in other libraries, whose XPBD energy is quartic in the angle",
         .choices = QuadraticBend::law_names}),
};

double cotangent(const Vector3& a, const Vector3& b) {
  return a.dot(b) / a.cross(b).norm();
}

// The weights K_i of Kx = Σ K_i p_i, sums of cotangents at the ends of the edge.
std::array<double, 4> weights_of(const RestHinge& h) {
  const auto& [p0, p1, p2, p3] = h.position;
  const double c01 = cotangent(p1 - p0, p2 - p0), c02 = cotangent(p1 - p0, p3 - p0),
               c03 = cotangent(p0 - p1, p2 - p1), c04 = cotangent(p0 - p1, p3 - p1);
  return {c03 + c04, c01 + c02, -c01 - c03, -c02 - c04};
}

BendingConstraints build(const Isometric& settings, const BendingInput& input) {
  BendingConstraints constraints;
  auto& list = std::get<ElementList<QuadraticBend>>(constraints.elements);
  list.law = settings.constraint;
  const bool norm = list.law == QuadraticBend::Law::norm;
  for (const RestHinge& h : rest_hinges(input.rest, input.pins, input.is_flat)) {
    const std::array<double, 4> k = weights_of(h);
    Vector3 bend = Vector3::Zero();
    for (std::size_t i = 1; i < 4; ++i) bend += k[i] * (h.position[i] - h.position[0]);
    // Rounding of the sum must not count as rest curvature, so flat hinges get exactly 0.
    const double rest_bend = !input.is_flat && bend.norm() > 1e-12 * h.edge ? bend.norm() : 0;
    list.vertices.push_back(h.vertices);
    list.rest.push_back({k[0], k[1], k[2], k[3], rest_bend, h.edge});
    // Q = q KᵀK with q = 3 / area. So C = |Kx| has the energy ½ k q C², and C = ½ |Kx|² is ½ xᵀQx / q.
    const double q = 3 / h.area;
    list.softness.push_back(norm ? 1 / q : 1 / (q * q));
  }
  return constraints;
}

}  // namespace isometric_model

constinit const BendingKind Isometric::kind{
    .name = "isometric",
    .label = "isometric",
    .summary = "quadratic bending energy with the cotangents of the rest shape, over every interior edge",
    .source = "Bergou et al. 2006, eqs. 2 to 5; constraint as |Kx|",
    .limits =
        "moment ∝ sin θ, so nothing unfolds a sheet that is folded flat onto itself; does not distinguish "
        "the two directions of a fold, so a curved rest shape may snap to the other side; assumes that "
        "triangles keep their shape; with physical stiffness, a sheet that is bent a little has 0.75 of the "
        "stated rigidity on alternating diagonals and 0.93 on irregular meshes (see /bending/deflection)",
    .compliance = "1 / k of the energy ½ k xᵀQx, k in N m; flexural rigidity 3 k on equilateral triangles",
    .settings = table_of<Isometric>(isometric_model::fields),
    .softness_needs_compliance = true,
    .softens = true,
    .build = erased<isometric_model::build>,
};
}  // namespace bendlab
