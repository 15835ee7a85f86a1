// Elastic energy of constraints as XPBD sees them, U = Σ C² / (2 α), with α = softness (of a OneSided kind
// its own energy / softness): divide by the scene's compliance. Undefined (collapsed) constraints count
// nothing.
#pragma once

#include "bendlab/constraints/kinds.hpp"
#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// J times the scene's compliance.
double elastic_energy(const DistanceConstraints& list, const Positions& positions);
template <class Kind>
double elastic_energy(const ElementList<Kind>& list, const Positions& positions);
double elastic_energy(const ElementLists& lists, const Positions& positions);

/// Of warp, weft and shear in the normalised form, α = compliance / rest area.
double elastic_energy(const StrainConstraints& list, const Positions& positions);

}  // namespace bendlab
