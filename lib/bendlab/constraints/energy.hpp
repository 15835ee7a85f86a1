// Elastic energy of XPBD's constraints times the scene's compliance: U = Σ C² / (2 α) with α = softness. A
// OneSided kind adds its own energy / softness. Collapsed constraints, which have no gradient, add nothing.
#pragma once

#include <array>

#include "bendlab/constraints/batches.hpp"
#include "bendlab/constraints/kinds.hpp"
#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Elastic energy (J) multiplied by the scene's compliance.
double elastic_energy(const DistanceConstraints& list, const Positions& positions);
template <class Kind>
double elastic_energy(const ElementList<Kind>& list, const Positions& positions);
double elastic_energy(const ElementLists& lists, const Positions& positions);

/// Elastic energy of warp, weft and shear in the given form, in J times the scene's compliance. The
/// compliance of a constraint is the scene's compliance / rest area, times stretch_softness(),
/// shear_softness() or area_softness(). `area`: ν/(1 - ν) of StrainForm::stvk; other forms have no area.
/// `term_softness`: further factors for the compliances of warp, weft and shear.
double elastic_energy(const StrainConstraints& list, StrainForm form, const Positions& positions,
                      double area = 0, const std::array<double, 3>& term_softness = {1, 1, 1});

}  // namespace bendlab
