#include "bendlab/constraints/yielding.hpp"
#include "bendlab/scene/energy.hpp"
#include "experiments/measures/measure.hpp"

namespace bendlab {
namespace {

// The work of over_time is ∫ E df: E is the elastic energy with the factor 1, and f is the factor. A step
// uses the mean of E before and after it.
class Keyframes final : public Measurement {
 public:
  Keyframes(const RunConfig&, const BuiltScene& scene)
      : scene_(scene), known_(!can_yield(scene.input.elements)) {}

  void step(const Simulation& simulation, const Moment& moment) override {
    if (!known_) return;
    const SimulationInput& input = scene_.input;
    const double time = simulation.time();
    Part membrane{input.strain_schedule.at(time), 0}, bending{input.bending_schedule.at(time), 0};
    const Positions positions = simulation.positions();
    if (input.strain_schedule.is_given()) membrane.energy = membrane_energy(input, positions);
    if (input.bending_schedule.is_given()) bending.energy = bending_energy(input, positions, &directors_);
    if (!moment.is_start) work_ += work_between(membrane_, membrane) + work_between(bending_, bending);
    membrane_ = membrane, bending_ = bending;
  }

  void archive(Archive& state) override {
    state(work_, membrane_.factor, membrane_.energy, bending_.factor, bending_.energy, directors_);
  }

  void finish(const RunEnd& end, Findings& findings) override {
    if (!known_)
      findings.messages.push_back(
          "the work of over_time is not known, because hysteresis and plasticity depend on how the cloth "
          "moved");
    else if (end.status != RunStatus::diverged)
      findings.summary["keyframe_work"] = work_;
  }

 private:
  // Membrane or bending at a time.
  struct Part {
    double factor = 1, energy = 0;  // energy of the stated stiffness, J
  };
  static double work_between(const Part& before, const Part& after) {
    return (after.factor - before.factor) * 0.5 * (before.energy + after.energy);
  }

  const BuiltScene& scene_;
  bool known_;
  double work_ = 0;  // J
  Part membrane_, bending_;
  Positions directors_;  // of the last pose, with the least energy
};

}  // namespace

namespace measure {
extern const Measure keyframes{
    .name = "keyframes",
    .summary = "the energy that over_time adds to the cloth by changing its stiffness",
    .cost = "the time of one energy per step; for models with directors, of a few small Newton steps",
    .applies =
        [](const RunConfig&, const BuiltScene& scene) {
          return scene.input.method.kind().has_motion &&
                 (scene.input.strain_schedule.is_given() || scene.input.bending_schedule.is_given());
        },
    .when = "with over_time",
    .gives = []() -> std::vector<Quantity> {
      return {
          {"keyframe_work", "J",
           "work of over_time on the cloth: ∫ E df, where E is the elastic energy with the factor 1, and f "
           "is the factor; below 0 if the cloth loses energy"}};
    },
    .begin = begun<Keyframes>};
}  // namespace measure
}  // namespace bendlab
