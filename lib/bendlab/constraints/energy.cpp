#include "bendlab/constraints/energy.hpp"

#include "bendlab/constraints/reference.hpp"

namespace bendlab {
namespace {

template <std::size_t N>
std::array<Vector3, N> corners(const Positions& positions, const std::array<int, N>& vertices) {
  std::array<Vector3, N> p;
  for (std::size_t i = 0; i < N; ++i) p[i] = positions.row(vertices[i]).transpose();
  return p;
}

}  // namespace

double elastic_energy(const DistanceConstraints& list, const Positions& positions) {
  double twice = 0;
  for (std::size_t c = 0; c < list.size(); ++c) {
    const auto value = distance_constraint<double>(corners(positions, list.vertices[c]), list.rest_length[c]);
    if (value.defined) twice += value.value * value.value;
  }
  return 0.5 * twice;
}

template <class Kind>
double elastic_energy(const ElementList<Kind>& list, const Positions& positions) {
  double twice = 0;
  for (std::size_t c = 0; c < list.size(); ++c) {
    const auto value =
        Kind::template value<double>(corners(positions, list.vertices[c]), list.rest[c], list.law);
    if (!value.defined) continue;
    double of_one = value.value * value.value;
    if constexpr (OneSided<Kind>) of_one = 2 * Kind::energy(value.value, list.rest[c], list.law);
    twice += of_one / list.softness[c];
  }
  return 0.5 * twice;
}

double elastic_energy(const ElementLists& lists, const Positions& positions) {
  double sum = 0;
  for_each_kind(lists, [&](const auto& list) { sum += elastic_energy(list, positions); });
  return sum;
}

#define BENDLAB_ENERGY(Kind) template double elastic_energy(const ElementList<Kind>&, const Positions&);
BENDLAB_FOR_ELEMENT_KINDS(BENDLAB_ENERGY)

}  // namespace bendlab
