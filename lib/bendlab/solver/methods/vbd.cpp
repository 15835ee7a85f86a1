// Implicit steps by vertex block descent (Chen et al. 2024): one vertex after another moves to the minimum of
// the energy as a function of that vertex alone,
//
//   (w 1 + Σ ψ'' ∇C ∇Cᵀ) Δx_i = w (y - x_i) - Σ ψ' ∇C + contact,    ∇ by x_i
//
// while all other vertices stay where they are. The implementation uses C and ∇C of every kind of constraint,
// in double precision and on one thread. So vbd shows how block descent converges, not how fast it can be.
//
// `acceleration` is Chebyshev's method (Wang 2015). From the third iteration on, x_k+1 = x_k-1 + ω (x_k + Δx
// - x_k-1). ω follows from ρ, the spectral radius of an iteration without acceleration.
#include <array>
#include <limits>
#include <utility>

#include "bendlab/solver/elastic_system.hpp"
#include "bendlab/solver/implicit_step.hpp"
#include "bendlab/solver/memory.hpp"
#include "bendlab/solver/methods.hpp"

namespace bendlab {
namespace {

// clang-format off
constexpr std::array own_fields = {
    field<&Vbd::acceleration>({.name = "acceleration", .unit = "1",
              .meaning = "vbd: ρ of Chebyshev's acceleration, the share of the error that remains after an "
                         "iteration without acceleration; 0: no acceleration. Iterations diverge if ρ is too "
                         "large",
              .minimum = 0, .maximum = 0.9999}),
};
// clang-format on
constexpr auto fields = joined(implicit_fields<Vbd>, own_fields);

constexpr std::array<MethodPass, 4> own_passes = implicit_passes("vbd: one vertex after another");

class VbdStep final : public ImplicitStep<double> {
 public:
  VbdStep(const SimulationInput& input, std::vector<Pass<double>> effect_passes)
      : ImplicitStep<double>(input, settings_of<Vbd>(input), {}),
        system_(input),
        positions_(input.points()),
        rho_(settings_of<Vbd>(input).acceleration) {
    compile_plan(std::move(effect_passes), 10, 0);
  }

  void archive(Archive& state) override {
    ImplicitStep<double>::archive(state);
    if (yields()) system_.archive_yields(state);
  }
  std::size_t memory_bytes() const override {
    return ImplicitStep<double>::memory_bytes() + system_.memory_bytes() +
           static_cast<std::size_t>(3 * positions_.size()) * sizeof(double);
  }

 private:
  void scale_stiffness(const StiffnessFactors& factors) override { system_.scale_stiffness(factors); }
  std::size_t yield() override { return system_.yield(in_world(state_.position)); }
  Points<double> elastic_forces(const Points<double>& positions) const override {
    return system_.forces(in_world(positions));
  }
  double iterate() override {
    if (data_.is_first_iteration && !data_.contacts.in_use()) start_lower(system_);
    positions_ = in_world(state_.position);
    const Positions start = positions_;
    double longest = 0;
    for (std::size_t v = 0; v < data_.weight.size(); ++v)
      if (system_.free_index()[v] >= 0) longest = std::max(longest, descend(v));
    if (rho_ > 0) accelerate(start);
    for (std::size_t v = 0; v < data_.weight.size(); ++v)
      if (system_.free_index()[v] >= 0)
        state_.position[v].set(positions_.row(static_cast<Eigen::Index>(v)).transpose() - origin_of(v));
    keep_momentum();
    return data_.is_first_iteration ? first_left(longest) : left_after(longest);
  }

  // How far vertices still are from the minimum, m, if the moves continue to shrink at the present rate. In
  // stiff cloth a move is only a small share of the distance to the minimum.
  double first_left(double longest) {
    last_ = longest;
    return longest > 0 ? std::numeric_limits<double>::infinity() : 0;
  }
  double left_after(double longest) {
    const double rate = longest / std::exchange(last_, longest);
    return rate < 1 ? longest * rate / (1 - rate) : std::numeric_limits<double>::infinity();
  }

  // Halves the step until the energy falls. The matrix leaves out the force of a membrane along the normal of
  // the sheet, which grows as the cube of a move.
  double descend(std::size_t v) {
    auto row = positions_.row(static_cast<Eigen::Index>(v));
    ElasticSystem::AtVertex local = system_.at_vertex(positions_, static_cast<int>(v));
    const Vector3 start = row.transpose();
    Vector3 outside = data_.weight[v] * (data_.target[v].vector() + origin_of(v) - start);
    Eigen::Matrix3d stiffness = data_.weight[v] * Eigen::Matrix3d::Identity();  // of inertia and contact
    if (data_.contacts.in_use() && data_.contacts.pushes(v)) {
      outside += data_.contacts.force_at(v, start - state_.origin);
      stiffness += data_.contacts.stiffness(v);
    }
    local.stiffness += stiffness;
    for (int axis = 0; axis < 3; ++axis)
      if (is_held(v, axis)) {
        local.stiffness.row(axis).setZero(), local.stiffness.col(axis).setZero();
        local.stiffness(axis, axis) = 1, local.force(axis) = outside(axis) = 0;
      }
    const Vector3 step = local.stiffness.llt().solve(local.force + outside);
    constexpr int most_halvings = 10;
    double share = 1;
    for (int halving = 0; halving <= most_halvings; ++halving, share *= 0.5) {
      row = (start + share * step).transpose();
      const double gain = share * step.dot(outside) - 0.5 * share * share * step.dot(stiffness * step);
      if (system_.at_vertex(positions_, static_cast<int>(v)).energy - gain <= local.energy) break;
    }
    return share * step.cwiseAbs().maxCoeff();
  }

  void accelerate(const Positions& start) {
    constexpr int plain = 2;  // iterations before the first that is accelerated
    if (data_.is_first_iteration) iteration_ = 0;
    ++iteration_;
    if (iteration_ > plain) {
      omega_ = iteration_ == plain + 1 ? 2 / (2 - rho_ * rho_) : 4 / (4 - rho_ * rho_ * omega_);
      const Positions plain_result = positions_;
      positions_ = before_ + omega_ * (plain_result - before_);
    }
    before_ = start;
  }

  ElasticSystem system_;
  Positions positions_, before_;       // #P by 3, m, in world coordinates; x_k-1
  double rho_, omega_ = 1, last_ = 0;  // last_: the longest move of the last iteration, m
  int iteration_ = 0;
};

// In one iteration a vertex moves by about 1 / (1 + C²) of its distance to the minimum, because its
// neighbours resist. C is the Courant number of the membrane. The table has the distance from the motion of
// newton after n iterations, in sizes of the cloth, as the mean over 1 and 2 s, for sheets of 8 and 16 cells
// with Y = 10 to 10⁵ N/m:
//
//   n/C²       0.0005-0.005   0.014      0.018         0.045   0.054   0.18          0.54 and more
//   distance   0.31-0.50      0.12-0.19  0.012, lost   0.03    0.005   0.001-0.003   0.001, 0.01 at C² = 6
constexpr double enough_reach = 0.1;

// On a spinning plane the cloth turned by 4, 21, 55, 74 and 94 % of the plane's angle at a residual of 0.38,
// 0.35, 0.32, 0.20 and 0.04.
constexpr double residual_of_lag_on_obstacle = 0.1;

}  // namespace

constinit const MethodKind Vbd::kind{
    .name = "vbd",
    .summary = "implicit steps by vertex block descent; for comparison",
    .source = "Chen et al. 2024; Chebyshev's acceleration: Wang 2015",
    .limits =
        "every compliance must be above 0, because constraints need energies; runs in double precision on "
        "one "
        "thread; a correction reaches one ring of neighbours per iteration, so fine sheets converge slowly",
    .settings = table_of<Vbd>(fields),
    .passes = own_passes,
    .bytes_per_vertex = 1500,
    .holds_axes = true,
    .needs_compliance = "k has no energy that a step could minimise",
    .takes_effects_in_iterations = true,
    .default_substeps = 1,
    .default_iterations = 100,
    .steps_implicitly = true,
    .mesh_order = true,
    .iterations_per_courant = enough_reach,
    .residual_of_lag_on_obstacle = residual_of_lag_on_obstacle,
    .make_double = make_step<VbdStep>,
};
}  // namespace bendlab
