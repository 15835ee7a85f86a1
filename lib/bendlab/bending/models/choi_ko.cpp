// Choi and Ko's model: cloth that is pushed together does not shorten, it buckles. The flexion springs of
// this model join vertices two edges apart and push like the ends of a buckled arc.
#include "bendlab/bending/models.hpp"
#include "bendlab/settings/names.hpp"

namespace bendlab {
namespace choi_ko_model {

constexpr std::array fields = {
    field<&ChoiKo::ring>({.name = "ring",
                          .unit = "1",
                          .meaning = "edges between the vertices that a spring joins",
                          .minimum = 2,
                          .maximum = 1000}),
    field<&ChoiKo::force>({.name = "force",
                           .meaning = "force of a buckled arc, or the polynomial of degree 4 that cloth "
                                      "solvers use instead (within 1.6 %); with k the results are equal",
                           .choices = ArcSpring::law_names}),
};

BendingConstraints build(const ChoiKo& settings, const BendingInput& input) {
  const int ring = settings.ring;
  const std::vector<int> levels(static_cast<std::size_t>(input.rest.vertex_count()), ring);
  const DistanceConstraints pairs = ring_springs(input, levels, {.fill = RingFill::last});
  BendingConstraints constraints;
  auto& list = std::get<ElementList<ArcSpring>>(constraints.elements);
  list.law = settings.force;
  for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
    if (!(pairs.rest(pair) > 0)) continue;  // no arc without a length
    list.vertices.push_back(pairs.vertices[pair]);
    list.rest.push_back({pairs.rest(pair)});
    list.softness.push_back(1);
  }
  // Segments a width b apart would have the flexural rigidity k_b / b if the sheet between their ends were an
  // arc. But edges of a mesh stay straight: t edges of length a, bent to curvature κ, shorten by (1 - 1/t²)
  // times L³ κ²/24, the shortening of an arc of length L = t a. The energy U = 12 k_b (1 - r/L)/L falls by
  // the same factor.
  constraints.facts = {{"ring", static_cast<double>(ring), "edges between the vertices that a spring joins"},
                       {"rigidity_factor", 1 - 1.0 / (ring * ring),
                        "flexural rigidity divided by k_b / width, the flexural rigidity of exact arcs"}};
  return constraints;
}

}  // namespace choi_ko_model

constinit const BendingKind ChoiKo::kind{
    .name = "choi_ko",
    .label = "Choi-Ko",
    .summary =
        "post-buckling springs: vertices two edges apart push like the ends of a buckled arc, and never pull",
    .source = "Choi and Ko 2002, §4.2; solved with the jump of the force at r = L, as XPBD",
    .limits =
        "never pulls: a curved rest shape may open freely, and a membrane that fails without bending fails "
        "with this model, too; does not distinguish the two directions of a fold; segments stay straight up "
        "to a push of 12 k_b/L² (an arc buckles at 9.87 k_b/L²); the rigidity depends on the directions of "
        "the mesh's lines; with k it is a one-sided distance constraint",
    .compliance =
        "1 / k_b, k_b in N m² (flexural rigidity 3/4 k_b / width for one line of segments at ring 2)",
    .settings = table_of<ChoiKo>(choi_ko_model::fields),
    .one_sided = true,
    .build = erased<choi_ko_model::build>,
};
}  // namespace bendlab
