// Jolt Physics, soft bodies with dihedral bend constraints: XPBD with C = θ and one projection per substep,
// so no multiplier is stored. A hinge at rest under a load has λ = -C / compliance, hence the energy
// ½ θ² / compliance.
#include "experiments/dialects/dialect.hpp"

namespace bendlab {

namespace dialect {
extern const Dialect jolt{
    .name = "jolt",
    .engine = "Jolt Physics, soft body with EBendType::Dihedral",
    .setting = {.name = "bend-compliance",
                .unit = "1/(N m)",
                .meaning = "mBendCompliance of VertexAttributes, equal at all vertices"},
    .rule = "B = 0.866 / mBendCompliance",
    .depends =
        "substeps (mNumIterations): B is reached if the substeps are so short that one projection of "
        "each hinge per substep converges; with longer substeps the sheet is softer",
    .limits =
        "EBendType::Distance, the default, has no rigidity: its springs between opposite vertices resist "
        "with a moment ∝ κ³. Jolt skips hinges whose product of squared normals is below 1e-24 m⁸ "
        "(cells of about 1 mm)",
    .source =
        "jrouwe/JoltPhysics 3b47ec3 (2026-06): Jolt/Physics/SoftBody/SoftBodyMotionProperties.cpp, "
        "ApplyDihedralBendConstraints(); SoftBodySharedSettings.cpp, CreateConstraints()",
    .stiffness = [](const MeshHinge&, const DialectNumbers&) { return 1.0; },
    .factor = [](double compliance, const DialectNumbers&) { return 1 / compliance; },
    .value = [](double factor, const DialectNumbers&) { return 1 / factor; }};
}  // namespace dialect
}  // namespace bendlab
