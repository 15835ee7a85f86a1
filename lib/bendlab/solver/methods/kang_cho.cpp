// The approximate implicit step of Kang & Cho 2002 for cloth of masses and springs.
//
//   per substep h:  force passes → damp passes → springs → implicit solve → update → velocity passes
//
// This is backward Euler, but a spring's tangent has only its part along the spring, J_ij = k d dᵀ / |d|²:
//
//   (M + h² K) Δv = h f - h² K v
//
// Two steps of block Jacobi from Δv = 0 solve this equation approximately:
//
//   W_i  = m_i 1 + h² Σ_j J_ij
//   p_i  = h f_i + h² Σ_j J_ij (v_j - v_i)
//   Δv_i = W_i⁻¹ (p_i + h² Σ_j J_ij W_j⁻¹ p_j),   v += Δv,   x += h v
//
// f is the sum of the springs' forces and, as in the source, of the scene's forces. The force passes change
// the velocities; these changes are undone, multiplied by m_i and added to p. So a cloth in equilibrium stays
// in equilibrium for any h. Damp passes get the velocities without these forces. A pinned vertex has p = Δv =
// 0 and acts on its neighbours.
//
// Properties of the approximation. G is W⁻¹ h² × the off-diagonal blocks, with eigenvalues within (-1, 1).
//
// * Δv solves backward Euler exactly for another mass, M' = (M + h² K) (1 - G²)⁻¹ - h² K ≥ M. So with fixed J
//   the method is stable at any step. Δv differs from the solution for M by O(h⁵) per step.
// * The added mass M' - M grows with κ = h² k, and acts in the directions of J. Two masses on a spring fall
//   along the spring more slowly than a stone, by the factor 1 - (κ / (m + κ))². M' also changes the momentum
//   Σ m v of a cloth, by a share of O((κ / m)²), but not the momentum of a single spring. M' turns with the
//   cloth, so the energy changes, too: with κ ≫ m a sheet that swings down climbs higher than its start.
// * The source's J leaves out the stiffness of a taut spring across its direction, k (1 - L / |d|). This
//   stiffness is integrated explicitly, so a mass on a taut string is stable only if h² Σ k (1 - L / |d|) <
//   4 m. In a hanging sheet of 32 × 32 cells, steps may be 1.5 to 4 times as long as those of explicit Euler,
//   for h² k / m from 1 to 6. Tangent::taut adds this stiffness to J.
//
// The springs are input.edges, of stiffness 1 / strain_stiffness.compliance, and input.distance, of stiffness
// 1 / bending_stiffness.compliance (N/m).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "bendlab/solver/kang_cho_kernel.hpp"
#include "bendlab/solver/memory.hpp"
#include "bendlab/solver/methods.hpp"
#include "bendlab/solver/time_step.hpp"

namespace bendlab {
namespace {

// The springs of about 10 µs. With fewer springs a second thread saves no time.
constexpr std::size_t worthwhile_lanes = 8192;

using Tangent = KangCho::Tangent;
constexpr std::array<std::string_view, 3> tangent_names = {"along", "taut", "isotropic"};

constexpr std::array own_passes = {
    MethodPass{"start", "kang_cho: stores the velocities before the forces act"},
    MethodPass{"external", "kang_cho: forces act in the implicit solve, not before it"},
    MethodPass{"springs", "kang_cho: forces and tangents of edges and bending springs"},
    MethodPass{"implicit solve", "kang_cho: two steps of block Jacobi"},
    MethodPass{"update", "x += h v; looks for divergence"},
};

// clang-format off
constexpr std::array fields = {
    field<&KangCho::tangent>({.name = "tangent",
              .meaning = "kang_cho: which stiffness of a spring is implicit. along: k along the spring, as "
                         "in the source; taut: also k (1 - L/l) across a spring stretched from L to l; "
                         "isotropic: k in every direction",
              .choices = tangent_names}),
};
// clang-format on

template <class Real>
AcrossTangent<Real> across_tangent(Tangent tangent) {
  return {.least = Real(tangent == Tangent::isotropic), .slope = Real(tangent == Tangent::taut)};
}

template <class Real>
class KangChoStep final : public TimeStep<Real> {
  using Base = TimeStep<Real>;
  using Base::add_pass, Base::append_effects, Base::constraints_, Base::find_divergence, Base::for_points,
      Base::permuted, Base::run, Base::state_, Base::workers_;

 public:
  KangChoStep(const SimulationInput& input, std::vector<Pass<Real>> effect_passes)
      : Base(input, input.permutation),
        spring_count_(input.edges.size() + input.distance.size()),
        across_(across_tangent<Real>(settings_of<KangCho>(input).tangent)) {
    check(input, effect_passes);
    fill_springs(input);
    compile_plan(std::move(effect_passes));
  }

  std::size_t memory_bytes() const override {
    return Base::memory_bytes() + bytes_of(springs_.slices) + bytes_of(springs_.other) +
           bytes_of(springs_.rest_length) + bytes_of(springs_.stiffness) + bytes_of(system_.rows) +
           bytes_of(system_.guess) + bytes_of(external_);
  }

 private:
  static void check(const SimulationInput& input, const std::vector<Pass<Real>>& effect_passes) {
    if (element_count(input.elements) > 0)
      throw std::invalid_argument(
          "kang_cho: takes springs only, but the bending model makes other elements; choose a model made of "
          "springs");
    const auto has_stiffness = [](const auto& s) {
      return s.kind == StiffnessKind::compliance && s.compliance > 0;
    };
    if (!has_stiffness(input.strain_stiffness) ||
        (input.distance.size() > 0 && !has_stiffness(input.bending_stiffness)))
      throw std::invalid_argument("kang_cho: springs need their stiffness as a compliance above 0");
    for (const Pass<Real>& pass : effect_passes)
      if (pass.stage != Stage::force && pass.stage != Stage::damp && pass.stage != Stage::velocity)
        throw std::invalid_argument(
            fmt::format("kang_cho: the pass {} needs a stage that kang_cho does not have", pass.name));
  }

  void fill_springs(const SimulationInput& input) {
    std::vector<Spring> springs;
    const auto add = [&](const DistanceConstraints& list, double compliance) {
      for (std::size_t c = 0; c < list.size(); ++c) {
        const auto [a, b] = list.vertices[c];
        const double softness = list.softness.empty() ? 1 : list.softness[c];
        springs.push_back({static_cast<int>(permuted(static_cast<std::size_t>(a))),
                           static_cast<int>(permuted(static_cast<std::size_t>(b))), list.rest(c),
                           1 / (compliance * softness)});
      }
    };
    add(input.edges, input.strain_stiffness.compliance);
    add(input.distance, input.bending_stiffness.compliance);
    std::vector<char> is_free(static_cast<std::size_t>(state_.vertex_count));
    for (std::size_t v = 0; v < is_free.size(); ++v) is_free[v] = state_.position[v].w > 0;
    springs_ = make_spring_rows<Real>(springs, is_free);
    system_ = ImplicitSystem<Real>(springs_.slice_count(), state_.position.size());
  }

  void compile_plan(std::vector<Pass<Real>> effect_passes) {
    if (std::ranges::any_of(effect_passes, [](const auto& pass) { return pass.stage == Stage::force; })) {
      external_.resize(state_.velocity.size());
      add_pass(plan_, "start", [this](auto&) { remember_velocities(); });
      append_effects(plan_, effect_passes, Stage::force);
      add_pass(plan_, "external", [this](auto&) { take_forces_back(); });
    }
    append_effects(plan_, effect_passes, Stage::damp);
    add_pass(plan_, "springs", [this](auto& c) { assemble_system(c.substep); });
    add_pass(plan_, "implicit solve", [this](auto& c) { solve_system(c.substep); });
    add_pass(plan_, "update", [this](auto& c) { update(c.substep); });
    append_effects(plan_, effect_passes, Stage::velocity);
  }

  void substep(PassContext<Real>& context) override { run(plan_, context); }
  std::uint64_t projections_per_substep() const override { return spring_count_; }

  void remember_velocities() { std::copy(state_.velocity.begin(), state_.velocity.end(), external_.begin()); }

  void take_forces_back() {
    for_points([&](std::size_t first, std::size_t last) {
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
    for_points([&](std::size_t first, std::size_t last) {
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

  std::uint64_t spring_count_;
  AcrossTangent<Real> across_;
  SpringRows<Real> springs_;
  ImplicitSystem<Real> system_;
  Points<Real> external_;  // what the force passes add to the velocities, m/s; empty without such passes
  typename Base::Passes plan_;
};

}  // namespace

constinit const MethodKind KangCho::kind{
    .name = "kang_cho",
    .summary =
        "an approximate implicit step of masses and springs; the membrane is a spring along every edge",
    .source = "Kang and Cho 2002; other tangents are ours",
    .limits =
        "takes only bending models made of springs, and compliances above 0; does not read form, warp, weft, "
        "shear and area of strain; adds mass, so that cloth falls too slowly in long steps; keeps neither "
        "momentum nor energy; takes no effects that act between projections",
    .settings = table_of<KangCho>(fields),
    .passes = own_passes,
    .membrane = Membrane::edges,
    .springs_only = true,
    .needs_compliance = "springs have a stiffness of 1 / compliance in N/m",
    .default_substeps = 8,
    .make_float = make_step<KangChoStep<float>>,
    .make_double = make_step<KangChoStep<double>>,
};
}  // namespace bendlab
