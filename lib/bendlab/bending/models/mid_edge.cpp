// The curvature of each triangle from normals at the middles of its edges, which are unknowns.
#include <algorithm>
#include <cmath>

#include "bendlab/bending/models.hpp"
#include "bendlab/bending/rest_faces.hpp"
#include "bendlab/constraints/corners.hpp"

namespace bendlab {
namespace mid_edge_model {

constexpr std::array fields = {
    field<&MidEdge::measure>(
        {.name = "measure",
         .meaning =
             "How the turn φ of the normal at an edge, away from the normal of the triangle, enters the "
             "curvature: tan φ, which grows without bound as a fold closes; sin φ; or theta: φ itself",
         .choices = turn_names}),
};

// Numbers the edges whose normal is an unknown. Returns -1 for all other edges.
std::vector<int> directors_of_edges(const std::vector<RestFace>& faces, const Pins& pins,
                                    Directors& directors) {
  std::vector<int> director(static_cast<std::size_t>(edge_count(faces)), -1);
  for (const RestFace& face : faces) {
    if (std::ranges::all_of(face.vertices, [&](int v) { return pins.pinned(v); })) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      int& of_edge = director[static_cast<std::size_t>(face.edge[i])];
      if (face.side[i] == EdgeSide::clamped || of_edge >= 0) continue;
      of_edge = directors.count();
      directors.vertices.push_back({face.vertices[(i + 1) % 3], face.vertices[(i + 2) % 3]});
    }
  }
  directors.rest = Positions::Zero(directors.count(), 3);
  directors.is_pinned.assign(directors.vertices.size(), 0);
  return director;
}

// Begins with the clamped edges: they have no director, so their elements name that of a later edge, and
// kernels write the corners in order.
RestFace clamped_first(RestFace face) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (face.side[i] == EdgeSide::clamped && face.side[(i + 2) % 3] != EdgeSide::clamped) first = i;
  const auto rotate = [&](auto&... values) {
    (std::rotate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(first), values.end()), ...);
  };
  rotate(face.vertices, face.beyond, face.edge, face.side, face.turns, face.height, face.height_beyond,
         face.inwards);
  return face;
}

BendingConstraints build(const MidEdge& settings, const BendingInput& input) {
  BendingConstraints constraints;
  std::vector<RestFace> faces = rest_faces(input.rest, input.pins);
  std::ranges::transform(faces, faces.begin(), clamped_first);
  const std::vector<int> director = directors_of_edges(faces, input.pins, constraints.directors);
  auto& list = std::get<ElementList<MidEdgeBend>>(constraints.elements);
  list.law = settings.measure;
  for (const RestFace& face : faces) {
    if (std::ranges::all_of(face.vertices, [&](int v) { return input.pins.pinned(v); })) continue;
    std::array<double, MidEdgeBend::rest_values> rest{};
    std::array<double, 3> curvature{};
    std::array<int, 9> corner = {face.beyond[0],   face.beyond[1],   face.beyond[2],
                                 face.vertices[0], face.vertices[1], face.vertices[2]};
    for (std::size_t i = 0; i < 3; ++i) {
      const double height = face.height[i];
      curvature[i] = 2 / (height * height);
      rest[i] = face.side[i] == EdgeSide::border ? 0 : face.side[i] == EdgeSide::inside ? 0.5 : 1;
      const int d = director[static_cast<std::size_t>(face.edge[i])];
      const bool has_director = face.side[i] != EdgeSide::clamped;
      // The angle of a director is its value divided by the mean height of the edge's triangles. A clamped
      // edge has no director; the element names any director, and does not read it.
      const double mean_height =
          face.side[i] == EdgeSide::inside ? 0.5 * (height + face.height_beyond[i]) : height;
      rest[13 + i] = has_director ? face.turns[i] / mean_height : 0;
      corner[6 + i] = has_director ? input.rest.vertex_count() + d : -1;
    }
    for (std::size_t i = 3; i-- > 0;)
      if (corner[6 + i] < 0)
        for (std::size_t j = 0; j < 3; ++j)
          if (corner[6 + j] >= 0) corner[6 + i] = corner[6 + j];
    if (corner[6] < 0) continue;  // all three neighbours are clamped, so all vertices are pinned
    std::ranges::copy(upper_factor(face, curvature, input), rest.begin() + 6);
    rest[12] = std::sqrt(2 * face.area);
    list.vertices.push_back(corner);
    list.rest.push_back(rest);
    list.softness.push_back(1);
  }
  if (input.is_flat) return constraints;
  // The normals of a curved rest shape are those with the least curvature.
  const Positions& rest = input.rest.positions();
  Directors& directors = constraints.directors;
  directors.rest = relaxed_directors(directors, constraints.elements, {}, rest, directors.rest);
  const Positions points = joined(rest, directors.rest);
  for (std::size_t c = 0; c < list.size(); ++c)
    std::ranges::copy(MidEdgeBend::turns(corners(points, list.vertices[c]), list.rest[c], list.law),
                      list.rest[c].begin() + 3);
  return constraints;
}

}  // namespace mid_edge_model

constinit const BendingKind MidEdge::kind{
    .name = "mid_edge",
    .label = "mid-edge",
    .summary =
        "the curvature of each triangle, from the sheet's normals at the middles of its edges, which are "
        "unknowns",
    .source =
        "Grinspun et al. 2006, Computing discrete shape operators; tan: Weischedel 2012 and Chen et al. "
        "2018 (libshell); linearised, it is the Morley triangle",
    .limits =
        "has three unknowns per vertex more than other models, so a step takes longer; projections "
        "converge slowly",
    .compliance = "1 / D, D the flexural rigidity in N m of a cylinder (a narrow strip: D (1 - ν²))",
    .settings = table_of<MidEdge>(mid_edge_model::fields),
    .softness_needs_compliance = true,
    .rigidity_by_formula = true,
    .takes_poisson_ratio = true,
    .takes_directions = true,
    .softens = true,
    .yields = true,
    .build = erased<mid_edge_model::build>,
    .points_per_vertex = 4,
};
}  // namespace bendlab
