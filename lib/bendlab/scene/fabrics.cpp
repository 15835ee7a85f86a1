#include "bendlab/scene/fabrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace bendlab {
namespace {

// KES: 1 gf cm²/cm of rigidity in N m, and 1 gf cm/cm of 2HB as HB in N.
constexpr double kes_b = gf_cm2_per_cm, kes_hb = gf_cm_per_cm / 2;

constexpr std::string_view
    // One rigidity and one hysteresis are stated for each fabric, without a direction.
    matsudaira =
        "Matsudaira, Masuda, Wada and Yokura 2015, J. Textile Engineering 61(6), doi "
        "10.4188/jte.61.69, tables 1 and 2; read in the transcription of another project",
    petrak =
        "Petrak and others 2025, Sustainability 17, 1388, doi 10.3390/su17041388, tables 1, 2, 4 and 5; "
        "read in the transcription of another project",
    // M = k1 κ + k2 κ² of strips; half_at is k1 / (2 |k2|) of the warp.
    feng =
        "Feng, Huang, Xu and Wang 2022, ACM Transactions on Graphics 41(6), doi "
        "10.1145/3550454.3555464, file dataset.csv of the authors' project DrapeTester/ClothDrapeTester";

// clang-format off
// Name, description, density, rigidity of warp, weft and bias, HB, half_at, thickness, drape, source.
constexpr std::array all_fabrics = {
    Fabric{"cotton_broad", "cotton, plain weave", 0.1238,
           0.118 * kes_b, 0.118 * kes_b, {}, 0.124 * kes_hb, 0, 0.000497, 82.9, matsudaira},
    Fabric{"wool_tropical", "wool, plain weave", 0.1629,
           0.067 * kes_b, 0.067 * kes_b, {}, 0.033 * kes_hb, 0, 0.000407, 49.8, matsudaira},
    Fabric{"polyester_tropical", "polyester", 0.1165,
           0.077 * kes_b, 0.077 * kes_b, {}, 0.029 * kes_hb, 0, 0.00034, 50.7, matsudaira},
    Fabric{"polyester_faille", "polyester", 0.1043,
           0.019 * kes_b, 0.019 * kes_b, {}, 0.007 * kes_hb, 0, 0.000226, 28.3, matsudaira},
    Fabric{"polyester_twill", "polyester, twill 3-1", 0.13517,
           1950e-9, 610e-9, {}, 0, 0, 0.00031, 22.3, petrak},
    Fabric{"polyester_plain", "polyester, plain weave", 0.08366,
           850e-9, 330e-9, {}, 0, 0, 0.00025, 22.8, petrak},
    Fabric{"wool_twill", "75 % wool, 15 % polyester, 10 % elastane, twill 2-1", 0.1787,
           2140e-9, 2000e-9, {}, 0, 0, 0.0004, 34.9, petrak},
    Fabric{"viscose_twill", "63 % polyester, 33 % viscose, 4 % elastane, twill 2-1", 0.28613,
           2970e-9, 2400e-9, {}, 0, 0, 0.00061, 28.6, petrak},
    Fabric{"polyester_stretch", "97 % polyester, 3 % elastane, plain weave", 0.242,
           3220e-9, 3880e-9, {}, 0, 0, 0.00056, 44.3, petrak},
    Fabric{"cotton_twill", "65 % cotton, 31 % polyester, 4 % elastane, twill 2-1", 0.25336,
           7430e-9, 3700e-9, {}, 0, 0, 0.00062, 54.9, petrak},
    Fabric{"feng_1", "row 1 of the data set; fibre and weave are not stated", 0.0673,
           1779.9e-9, 3076.2e-9, {2244.1e-9}, 0, 105, 0, 0, feng},
    Fabric{"feng_2", "row 2 of the data set; fibre and weave are not stated", 0.0585,
           2977.0e-9, 4967.1e-9, {6618.1e-9}, 0, 168.2, 0, 0, feng},
    Fabric{"feng_3", "row 3 of the data set; fibre and weave are not stated", 0.1834,
           61211.1e-9, 24116.1e-9, {23803.5e-9}, 0, 128.4, 0, 0, feng},
    Fabric{"feng_4", "row 4 of the data set; fibre and weave are not stated", 0.2776,
           68681.4e-9, 46805.6e-9, {34174.3e-9}, 0, 129.7, 0, 0, feng},
    Fabric{"feng_6", "row 6 of the data set; fibre and weave are not stated", 0.1972,
           9183.1e-9, 7598.0e-9, {3752.0e-9}, 0, 103, 0, 0, feng},
    Fabric{"feng_8", "row 8 of the data set; fibre and weave are not stated", 0.1893,
           53512.5e-9, 53947.7e-9, {68535.8e-9}, 0, 108.6, 0, 0, feng},
    Fabric{"feng_10", "row 10 of the data set; fibre and weave are not stated", 0.1462,
           3436.1e-9, 2478.2e-9, {4024.7e-9}, 0, 250.7, 0, 0, feng},
    Fabric{"feng_12", "row 12 of the data set; fibre and weave are not stated", 0.1184,
           1337.3e-9, 7502.4e-9, {2602.8e-9}, 0, 111.2, 0, 0, feng},
};
// clang-format on

}  // namespace

std::span<const Fabric> fabrics() {
  return all_fabrics;
}

const Fabric* find_fabric(std::string_view name) {
  const auto found = std::ranges::find(all_fabrics, name, &Fabric::name);
  return found == all_fabrics.end() ? nullptr : &*found;
}

void apply_fabric(const Fabric& fabric, Scene& scene) {
  scene.material.density = fabric.density;
  Bending& bending = scene.bending;
  bending.stiffness = Stiffness::physical;
  const BendingKind& model = bending.model.kind();
  if (model.rigidity_by_formula && !model.takes_directions)
    bending.flexural_rigidity = orthotropic_rigidity(fabric.warp, fabric.weft, fabric.bias, 0).mean();
  else
    bending.rigidity = {fabric.warp, fabric.weft, fabric.bias};
  if (fabric.half_at > 0 && model.softens) {
    // Measured along the warp. In models of triangles, /bending/softening/half_at is that of the mean
    // rigidity, which is divided by √(D / mean) in each direction. Hinges soften at the same curvature in all
    // directions.
    const OrthotropicRigidity d = orthotropic_rigidity(fabric.warp, fabric.weft, fabric.bias, 0);
    bending.softening.half_at = fabric.half_at * (model.takes_directions ? std::sqrt(d.warp / d.mean()) : 1);
  }
  if (fabric.friction > 0 && model.yields && scene.solver.method.kind().has_motion)
    bending.hysteresis.hb = fabric.friction;
}

}  // namespace bendlab
