#include "bendlab/solver/kang_cho.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "bendlab/solver/colouring.hpp"
#include "bendlab/solver/kang_cho_kernel.hpp"
#include "bendlab/solver/memory.hpp"
#include "bendlab/solver/time_step.hpp"

namespace bendlab {
namespace {

// About 10 µs of springs: less is not worth waking a second thread for.
constexpr std::size_t worthwhile_lanes = 8192;

template <class Real>
AcrossTangent<Real> across_tangent(Tangent tangent) {
  return {.least = Real(tangent == Tangent::isotropic), .slope = Real(tangent == Tangent::taut)};
}

template <class Real>
class KangChoStep final : public TimeStep<Real> {
  using Base = TimeStep<Real>;
  using Base::add_statistics, Base::append_effects, Base::constraints_, Base::find_divergence,
      Base::for_vertices, Base::place_of, Base::run, Base::state_, Base::workers_;

 public:
  KangChoStep(const SimulationInput& input, std::vector<Pass<Real>> effect_passes)
      : Base(input, input.place),
        distance_order_(list_order(input.distance.size())),
        spring_count_(input.edges.size() + input.distance.size()),
        across_(across_tangent<Real>(input.settings.tangent)) {
    check(input, effect_passes);
    fill_springs(input);
    compile_plan(std::move(effect_passes));
  }

  const BatchOrder& strain_order() const override { return constraints_.strain.order; }
  const BatchOrder& distance_order() const override { return distance_order_; }
  const BatchOrder& element_order(std::string_view) const override { return constraints_.strain.order; }
  std::size_t memory_bytes() const override {
    return Base::memory_bytes() + bytes_of(springs_.slices) + bytes_of(springs_.other) +
           bytes_of(springs_.rest_length) + bytes_of(springs_.stiffness) + bytes_of(system_.rows) +
           bytes_of(system_.guess) + bytes_of(external_);
  }

 private:
  static void check(const SimulationInput& input, const std::vector<Pass<Real>>& effect_passes) {
    if (element_count(input.elements) > 0)
      throw std::invalid_argument("kang_cho: works on springs; the bending model gives other elements");
    const auto has_stiffness = [](const auto& s) {
      return s.kind == StiffnessKind::compliance && s.compliance > 0;
    };
    if (!has_stiffness(input.strain_stiffness) ||
        (input.distance.size() > 0 && !has_stiffness(input.bending_stiffness)))
      throw std::invalid_argument("kang_cho: springs need their stiffness as a compliance above 0");
    for (const Pass<Real>& pass : effect_passes)
      if (pass.stage != Stage::force && pass.stage != Stage::damp && pass.stage != Stage::velocity)
        throw std::invalid_argument(
            fmt::format("kang_cho: the pass {} runs at a stage that this step has not", pass.name));
  }

  void fill_springs(const SimulationInput& input) {
    std::vector<Spring> springs;
    const auto add = [&](const DistanceConstraints& list, double compliance) {
      for (std::size_t c = 0; c < list.size(); ++c) {
        const auto [a, b] = list.vertices[c];
        const double softness = list.softness.empty() ? 1 : list.softness[c];
        springs.push_back({static_cast<int>(place_of(static_cast<std::size_t>(a))),
                           static_cast<int>(place_of(static_cast<std::size_t>(b))), list.rest_length[c],
                           1 / (compliance * softness)});
      }
    };
    add(input.edges, input.strain_stiffness.compliance);
    add(input.distance, input.bending_stiffness.compliance);
    std::vector<char> is_free(static_cast<std::size_t>(state_.vertex_count));
    for (std::size_t v = 0; v < is_free.size(); ++v) is_free[v] = state_.position[v].w > 0;
    springs_ = make_spring_rows<Real>(springs, is_free);
    system_ = ImplicitSystem<Real>(springs_.slice_count(), state_.position.size());
    constraints_.for_each([](auto& batch) { batch.order = list_order(0); });  // effects find no constraints
  }

  void compile_plan(std::vector<Pass<Real>> effect_passes) {
    const auto add = [&](const char* name, auto action) {
      plan_.push_back(
          {[this, action](PassContext<Real>& c) { (this->*action)(c.substep); }, add_statistics(name)});
    };
    if (std::ranges::any_of(effect_passes, [](const auto& pass) { return pass.stage == Stage::force; })) {
      external_.resize(state_.velocity.size());
      add("start", &KangChoStep::remember_velocities);
      append_effects(plan_, effect_passes, Stage::force);
      add("external", &KangChoStep::take_forces_back);
    }
    append_effects(plan_, effect_passes, Stage::damp);
    add("springs", &KangChoStep::assemble_system);
    add("implicit solve", &KangChoStep::solve_system);
    add("update", &KangChoStep::update);
    append_effects(plan_, effect_passes, Stage::velocity);
  }

  void substep(PassContext<Real>& context) override { run(plan_, context); }
  std::uint64_t projections_per_substep() const override { return spring_count_; }

  void remember_velocities(Real) {
    std::copy(state_.velocity.begin(), state_.velocity.end(), external_.begin());
  }

  void take_forces_back(Real) {
    for_vertices([&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        const Point<Real> start = external_[v], with_forces = state_.velocity[v];
        external_[v].set(with_forces.vector() - start.vector());
        state_.velocity[v] = start;
      }
    });
  }

  void assemble_system(Real h) {
    const Point<Real>* const external = external_.empty() ? nullptr : external_.data();
    for_slices([&](std::size_t first, std::size_t last) {
      assemble(system_, state_, external, springs_, across_, h, first, last);
    });
  }

  void solve_system(Real h) {
    for_slices([&](std::size_t first, std::size_t last) {
      solve(state_, system_, springs_, across_, h, first, last);
    });
  }

  void update(Real h) {
    for_vertices([&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        state_.previous[v] = state_.position[v];
        state_.position[v].set(state_.position[v].vector() + h * state_.velocity[v].vector());
      }
    });
    find_divergence();
  }

  template <class Task>
  void for_slices(const Task& task) {
    workers_.for_range(0, springs_.slice_count(), springs_.other.size() >= worthwhile_lanes, task);
  }

  BatchOrder distance_order_;
  std::uint64_t spring_count_;
  AcrossTangent<Real> across_;
  SpringRows<Real> springs_;
  ImplicitSystem<Real> system_;
  Points<Real> external_;  // what the force passes add to the velocities, m/s; empty without such passes
  typename Base::Passes plan_;
};

}  // namespace

template <class Real>
std::unique_ptr<Simulation> make_kang_cho_step(const SimulationInput& input,
                                               std::vector<Pass<Real>> effect_passes) {
  return std::make_unique<KangChoStep<Real>>(input, std::move(effect_passes));
}

template std::unique_ptr<Simulation> make_kang_cho_step(const SimulationInput&, std::vector<Pass<float>>);
template std::unique_ptr<Simulation> make_kang_cho_step(const SimulationInput&, std::vector<Pass<double>>);

}  // namespace bendlab
