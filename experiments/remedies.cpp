#include "experiments/remedies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <tuple>
#include <vector>

namespace bendlab {
namespace {

// The trials: scenes that broke a bound, each with one thing changed. Numbers are the worst stretch of any
// triangle in any frame of 2 s. A sheet of 1 m under gravity, steps of 1/60 s × 10 iterations, normalised
// form, single precision, k = 0.5, unless it says otherwise.
//
//   a  crossover, 64 cells, one corner's vertex pinned (the paper's)    e  dihedral, k = 0.01, 24 cells alternating, hung from
//   b  none, 32 cells, pinned so                                           its top at 90 degrees, 0.05 m/s sideways
//   c  k_ring, 64 cells, pinned so                                      f  as e in double precision: diverges in its first step
//   d  adaptive, 32 cells, pinned so, steps of 1/15 s                   g  bridson, k = 1, 16 cells, as f: diverges, too
//                                                                       h  crossover, k = 1, 16 cells, two corners, 1 s a step
//
//   changed                        a      b      c      d      e      f         g         h       time
//   nothing                      390   1132     40    120   1463  diverges  diverges    494       1
//   tethers                      1.5    1.5    1.5    1.4    4.4    2.9        41       2.8       1.0 to 1.15
//   4 substeps × 10               13    2.6    4.0    5.8   1.03   9276     diverges     28       4
//   10 substeps × 10             1.9    1.3    1.5    1.8   1.00  diverges  diverges    6.5       10
//   10 substeps × 1               16   1233    6.0    9.4  30760  diverges  diverges    507       1.2
//   10 × 1, tethers, angle       1.7    1.3    1.5    1.6    2.4    2.7        33       2.9       1.1 to 1.6
//   40 iterations                 78     11     11     19   2779  diverges  diverges     98       4
//   dt / 4                        13    2.6    4.0    5.8   1.03   9276     diverges     84       4
//   form: angle                   76     18     41     63  17150   6881      9795       466       1.0
//   flight_limit 0.25            390   1132     40    9.6   1463  diverges  diverges    2.1       1 where it cuts nothing, a 1.0,
//                                                                                                d 3, h 10
//   the other precision          381   1099     40    183  diverges  1463    2e6         491      1.5
//   k / 10                       973      -    864    915   2877    2e6      3e5        1680      1.0
//   order: pins                  130    482     51    173    1.5    1.5     diverges    444       15 to 25
//   sweep: symmetric             970   1192   1063    657  diverges 12330   diverges   1008       1.9
//   pins/ring 1                   37   1111     19     96  10050   9697     diverges      -       1.0
//   model: isometric               -      -      -      -      -    1.6       1.2         -       1.2
//
// Tethers mend what tears at a pin, for nothing; substeps, each with all its iterations, mend it at their
// price; neither mends hinges, and another model does. What is in the table and not named below did not help,
// or not in most.
//
// Besides: a free sheet stretched 100 times both ways (dihedral, k = 1, 16 cells, no gravity) ends with a
// mean strain of 1260; with form: angle 0.04, with k = 0.1 0.12, with isometric 0.05; 10 substeps × 10 1260,
// the other precision 1240. prestressed with an excess of 1 and k = 1 (16 cells, one corner) ends with a mean
// strain of 1.3; with k = 0.1 0.57, 10 substeps × 10 1.33, isometric 0.04.

bool lists(const Scene& scene, std::string_view type) {
  return std::ranges::find(scene.effects, type, &EffectSettings::type) != scene.effects.end();
}

bool has_hinges(const SimulationInput& input) {
  return std::get<kind_index<HingeAngle>>(input.elements).size() > 0;
}

// Whether springs are longer at rest than their vertices are apart in the rest shape.
bool is_prestressed(const Scene& scene) {
  constexpr double longer = 1.001;
  const DistanceConstraints& springs = scene.input.distance;
  for (std::size_t c = 0; c < springs.size(); ++c) {
    const auto& [a, b] = springs.vertices[c];
    if (springs.rest_length[c] > longer * (scene.rest.position(a) - scene.rest.position(b)).norm())
      return true;
  }
  return false;
}

// Short substeps of forward sweeps, which add energy: a level sheet of 16 cells without pins and bending that falls for 0.5 s
// in 1024 substeps × 1 had a mean strain of 4e-4 to 7e-4 and gained 1.3 to 7 times its energy scale, in both precisions and
// forms; symmetric, 1e-7 and nothing. With 256 substeps neither gained any.
bool is_pumped(const Scene& scene) {
  constexpr int many = 300;
  const SolverSettings& solver = scene.input.settings;
  return solver.sweep == Sweep::forward && solver.substeps >= many;
}

std::vector<std::string_view> of_a_tear(const Scene& scene) {
  const SimulationInput& input = scene.input;
  const bool pinned = !scene.pins.all.empty();
  constexpr double long_step = 1.0 / 20;  // s: between d's and the others'
  std::vector<std::string_view> texts;
  if (has_hinges(input))
    texts.push_back(
        "another /bending/model than one on hinges: isometric (two sheets that diverged or had a "
        "triangle 1463 times as long: 1.2 and 1.6)");
  if (is_prestressed(scene))
    texts.push_back("/bending/k: 0.1 (mean strain 1.3: 0.57) or another /bending/model, isometric (0.04)");
  if (pinned && !lists(scene, "tethers"))
    texts.push_back("the effect tethers (a triangle 40 to 1132 times as long: 1.5, in the same time)");
  if (input.settings.flight_limit == 0 && input.settings.dt / input.settings.substeps > long_step)
    texts.push_back("/solver/flight_limit: 0.25 (steps of 1/15 s: 120 times to 9.6, of 1 s: 494 to 2.1)");
  if (!pinned && input.strain_stiffness.form == StrainForm::normalised)
    texts.push_back("/material/strain/form: angle (a stretched free sheet's mean strain 1260: 0.04)");
  if (pinned && !has_hinges(input) && input.settings.substeps < 10)
    texts.push_back(
        "/solver/substeps: 10 with all /solver/iterations (40 to 1132 times: 1.3 to 1.9, in ten "
        "times the time)");
  return texts;
}

}  // namespace

std::string remedies_for(Bound bound, const Scene& scene) {
  std::vector<std::string_view> texts;
  if (scene.input.settings.method != Method::pbd) return "";  // nothing was tried there
  if (bound == Bound::momentum || bound == Bound::fall) {
    if (scene.precision == Precision::single_precision)
      texts.push_back(
          "/solver/precision: double (a fall of 1.226 m in 1024 substeps: 0.144 m in single precision, "
          "1.226 m in double) or fewer /solver/substeps (64: 1.218 m)");
  } else {
    if (is_pumped(scene))
      texts.push_back(
          "/solver/sweep: symmetric (a free sheet with 1024 substeps gained 1.3 to 7 times its energy: none)");
    for (const std::string_view text : of_a_tear(scene)) texts.push_back(text);
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string remedies_for_divergence(const Scene& scene) {
  return remedies_for(Bound::finite, scene);
}

}  // namespace bendlab
