// A bending moment at a border of the cloth, as couples of forces on the triangles at the border.
//
//          top  +f n          m = h f: the moment of the edge, about the edge
//         / | \                h:       height of the triangle above the edge
//        /  |h \               n:       the triangle's present normal, so the forces follow the cloth
//       a---+---b  -f n        (at a and b in the shares that make the couple a pure moment)
//
// The moment acts over the last row of triangles, so a strip of n cells behaves as if it were up to half a
// cell shorter. A positive moment turns the border against the normals, towards the side from which the
// corners of the triangles run clockwise.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bendlab/effects/effects.hpp"
#include "bendlab/effects/named_vertices.hpp"
#include "bendlab/mesh/half_edges.hpp"

namespace bendlab {
namespace moment_effect {

constexpr std::array own_fields = {
    field<&EdgeMoment::vertices>({.name = "vertices",
                                  .meaning =
                                      "vertices of the border on which the moment acts, by the names of "
                                      "/pins/vertices: a whole side, for example. If vertices and indices "
                                      "are empty, the moment acts on the whole border",
                                  .choices = place_names}),
    field<&EdgeMoment::indices>(
        {.name = "indices",
         .unit = "1",
         .meaning = "vertices of the border, by index, in addition to the named vertices",
         .minimum = 0}),
    field<&EdgeMoment::moment>({.name = "moment",
                                .unit = "N m",
                                .meaning =
                                    "total moment. Every border edge between these vertices gets a share "
                                    "in proportion to its length, which acts about the edge as a couple of "
                                    "forces on the triangle there. Above 0, the border turns to the side "
                                    "opposite to the normals of the triangles"}),
};
constexpr auto fields = joined(own_fields, load_fields<EdgeMoment>);

struct Couple {
  std::size_t a, b, top;  // permuted, right-handed about the normal
  double moment;          // N m
};

std::vector<Couple> couples(const EdgeMoment& settings, const EffectInput& input) {
  const std::vector<int> vertices =
      loaded_vertices(input.rest, input.pins, settings.vertices, settings.indices);
  const auto is_listed = [&](int v) { return std::ranges::binary_search(vertices, v); };
  std::vector<Couple> couples;
  double length = 0;
  int pinned = 0;
  const Triangles& triangles = input.rest.triangles();
  for_each_edge(half_edges(triangles), [&](std::span<const HalfEdge<int>> sides) {
    const HalfEdge<int>& side = sides.front();
    if (sides.size() != 1 || !is_listed(side.low) || !is_listed(side.high)) return;
    const int c = side.corner(), t = side.triangle(), a = triangles(t, c), b = triangles(t, (c + 1) % 3),
              top = triangles(t, (c + 2) % 3);
    if (input.pins.pinned(top)) {
      ++pinned;
      return;
    }
    const double of_edge = (input.rest.position(a) - input.rest.position(b)).norm();
    couples.push_back({input.permuted(a), input.permuted(b), input.permuted(top), of_edge});
    length += of_edge;
  });
  if (couples.empty())
    throw std::invalid_argument(
        pinned > 0 ? "vertices: the triangles at this border end in pinned vertices, so a couple of forces "
                     "could not turn these triangles: use more cells between the border and the pins"
                   : "vertices: no border edge joins two of these vertices, so there is no triangle on which "
                     "a couple of forces could act: name neighbours on a border, such as a whole side");
  for (Couple& couple : couples) couple.moment *= settings.moment / length;
  return couples;
}

template <class Real>
std::vector<Pass<Real>> compile(const EdgeMoment& settings, const EffectInput& input) {
  check_schedule(settings);
  if (settings.moment == 0) return {};
  return {{"moment", Stage::force,
           [growth = static_cast<const GrowingLoad&>(settings),
            all = couples(settings, input)](PassContext<Real>& context) {
             State<Real>& state = context.state;
             const double share = share_of_load(growth, context.time + static_cast<double>(context.substep));
             for (const Couple& couple : all) {
               const auto p = [&](std::size_t v) -> Vector3 {
                 return state.position[v].vector().template cast<double>();
               };
               const Vector3 a = p(couple.a), e = p(couple.b) - a, offset = p(couple.top) - a;
               const Vector3 normal = e.cross(offset);
               const double twice_area = normal.norm(), squared = e.squaredNorm();
               if (!(twice_area > 0)) continue;
               // f = m / h, h = 2 A / |e|.
               const Vector3 force =
                   share * couple.moment * std::sqrt(squared) / twice_area * (normal / twice_area);
               const double foot = offset.dot(e) / squared;
               const auto push = [&](std::size_t v, double part) {
                 const Real w = state.position[v].w;
                 if (w > 0) state.accelerate(v, context.substep * w * (part * force).template cast<Real>());
               };
               push(couple.top, 1), push(couple.a, foot - 1), push(couple.b, -foot);
             }
             context.acted += all.size();
           }}};
}

bool idle(const EdgeMoment& settings) {
  return settings.moment == 0;
}

bool drives(const EdgeMoment& settings) {
  return !idle(settings);
}

// A force that does as much work along the sheet's side as the moment does in a turn.
double largest_force(const EdgeMoment& settings, double area) {
  return settings.largest() * 2 * std::numbers::pi * std::abs(settings.moment) / std::sqrt(area);
}

}  // namespace moment_effect

constinit const EffectKind EdgeMoment::kind{
    .name = "moment",
    .summary = "a bending moment at a border of the cloth, as couples of forces on the last row of triangles",
    .source = "couple m = h f on each border triangle, with the present heights and normals",
    .settings = table_of<EdgeMoment>(moment_effect::fields),
    .repeatable = true,
    .keeps_momentum = true,
    .keeps_angular_momentum = false,
    .uses_sides = true,
    .force_follows_pose = true,
    .compile_float = erased<moment_effect::compile<float>>,
    .compile_double = erased<moment_effect::compile<double>>,
    .idle = erased<moment_effect::idle>,
    .drives = erased<moment_effect::drives>,
    .largest_force = erased<moment_effect::largest_force>,
};
}  // namespace bendlab
