#include "bendlab/constraints/energy.hpp"

#include "bendlab/constraints/corners.hpp"
#include "bendlab/constraints/oracle.hpp"

namespace bendlab {
namespace {

template <class SoftnessOf>
double twice_energy(const DistanceConstraints& list, const Positions& positions, SoftnessOf softness_of) {
  double twice = 0;
  for (std::size_t c = 0; c < list.size(); ++c) {
    const auto value = distance_constraint<double>(corners(positions, list.vertices[c]), list.rest(c));
    if (value.defined) twice += value.value * value.value / softness_of(c);
  }
  return twice;
}

}  // namespace

double elastic_energy(const DistanceConstraints& list, const Positions& positions) {
  return 0.5 * (list.softness.empty()
                    ? twice_energy(list, positions, [](std::size_t) { return 1.0; })
                    : twice_energy(list, positions, [&](std::size_t c) { return list.softness[c]; }));
}

template <class Kind>
double elastic_energy(const ElementList<Kind>& list, const Positions& positions) {
  double twice = 0;
  for (std::size_t c = 0; c < list.size(); ++c) {
    const auto value =
        Kind::template value<double>(corners(positions, list.vertices[c]), list.rest[c], list.law);
    if (!value.defined) continue;
    double twice_of_element = value.value * value.value;
    if constexpr (OneSided<Kind>) twice_of_element = 2 * Kind::energy(value.value, list.rest[c], list.law);
    if (!list.moment.empty()) twice_of_element = 2 * resistance(list.moment, c, value.value).energy;
    twice += twice_of_element / list.softness[c];
  }
  return 0.5 * twice;
}

double elastic_energy(const ElementLists& lists, const Positions& positions) {
  double sum = 0;
  for_each_kind(lists, [&](const auto& list) { sum += elastic_energy(list, positions); });
  return sum;
}

double elastic_energy(const StrainConstraints& list, StrainForm form, const Positions& positions,
                      double area_stiffness, const std::array<double, 3>& term_softness) {
  double sum = 0;
  for (std::size_t t = 0; t < list.size(); ++t) {
    const std::array<double, 4>& q = list.inverse_rest[t];
    const auto p = corners(positions, list.vertices[t]);
    const double area =
        0.5 / std::abs(q[0] * q[3] - q[1] * q[2]) / (list.softness.empty() ? 1 : list.softness[t]);
    const auto add = [&](const ConstraintValue<double, 3>& term, double softness) {
      if (term.defined) sum += 0.5 * area / softness * term.value * term.value;
    };
    for (const int column : {0, 1})
      add(stretch_constraint(p, q, column, form),
          term_softness[static_cast<std::size_t>(column)] * stretch_softness(form));
    add(shear_constraint(p, q, form), term_softness[2] * shear_softness(form));
    if (form == StrainForm::stvk && area_stiffness > 0)
      add(trace_constraint(p, q), area_softness(form, area_stiffness));
  }
  return sum;
}

#define BENDLAB_ENERGY(Kind) template double elastic_energy(const ElementList<Kind>&, const Positions&);
BENDLAB_FOR_ELEMENT_KINDS(BENDLAB_ENERGY)

}  // namespace bendlab
