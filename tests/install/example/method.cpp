#include "bendlab/solver/elastic_system.hpp"
#include "bendlab/solver/time_step.hpp"
#include "mine.hpp"

using namespace bendlab;

class ExplicitStep final : public TimeStep<double> {
 public:
  ExplicitStep(const SimulationInput& input, std::vector<Pass<double>> effects)
      : TimeStep(input, {}), system_(input) {
    append_effects(plan_, effects, Stage::force);
    append_effects(plan_, effects, Stage::damp);
    add_pass(plan_, "move", [this](PassContext<double>& now) { move(now.substep); });
    append_effects(plan_, effects, Stage::velocity);
  }

 private:
  void substep(PassContext<double>& now) override { run(plan_, now); }
  std::uint64_t projections_per_substep() const override { return system_.term_count(); }

  void move(double h) {
    const Points<double> forces = system_.forces(positions());
    for (std::size_t v = 0; v < forces.size(); ++v) {
      Point<double>& x = state_.position[v];
      state_.accelerate(v, h * x.w * forces[v].vector());
      x.set(x.vector() + h * state_.velocity[v].vector());
    }
    find_divergence();
  }

  ElasticSystem system_;
  Passes plan_;
};

constexpr std::array passes = {MethodPass{"move", "v += h f / m, then x += h v"}};

const MethodKind SymplecticEuler::kind{
    .name = "symplectic_euler",
    .summary = "forces at the start of a substep change velocities, then velocities change positions",
    .limits = "stable only while substeps resolve the fastest oscillation of the mesh",
    .settings = table_of<SymplecticEuler>({}),
    .passes = passes,
    .needs_compliance = "forces are derivatives of an energy",
    .default_substeps = 64,
    .keeps_momentum = true,
    .mesh_order = true,
    .make_double = make_step<ExplicitStep>};
