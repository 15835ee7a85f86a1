// Elastic energy of XPBD's constraints times the scene's compliance: U = Σ C² / (2 α) with α = softness; for
// a OneSided kind its own energy / softness. Undefined (collapsed) constraints do not count.
#pragma once

#include "bendlab/constraints/batches.hpp"
#include "bendlab/constraints/kinds.hpp"
#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// J times the scene's compliance.
double elastic_energy(const DistanceConstraints& list, const Positions& positions);
template <class Kind>
double elastic_energy(const ElementList<Kind>& list, const Positions& positions);
double elastic_energy(const ElementLists& lists, const Positions& positions);

/// Of warp, weft and shear in this form. α is compliance / rest area, and stretch_softness() times that for
/// warp and weft.
double elastic_energy(const StrainConstraints& list, StrainForm form, const Positions& positions);

}  // namespace bendlab
