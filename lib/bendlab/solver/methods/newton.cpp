// Implicit steps by Newton's method: the reference for every motion.
//
//   per iteration:  (H + W) Δx = -(∇E + W (x - y)),   H = Σ ψ'' ∇C ∇Cᵀ + λ ∇²C
//
// λ is kept only where a length pulls, so that the matrix is positive definite for any pose and any step
// (Gauss-Newton for bending, no compressive membrane stress). λ is what the last iteration aimed at, as if
// force and position were both unknowns: equilibrium.cpp says why. The forces on the right are those of the
// pose itself, so what the iterations converge to is the minimum that implicit_step.hpp states.
//
// An iteration is shortened until it stretches no triangle by more than `stretch_per_step` beyond its aim. In
// double precision.
#include <array>
#include <stdexcept>

#include "bendlab/solver/colouring.hpp"
#include "bendlab/solver/elastic_system.hpp"
#include "bendlab/solver/implicit_step.hpp"
#include "bendlab/solver/list_orders.hpp"
#include "bendlab/solver/memory.hpp"
#include "bendlab/solver/supernodal_solver.hpp"

namespace bendlab {
namespace {

using Eigen::VectorXd;

constexpr double stretch_per_step = 0.05;  // 1

constexpr std::array<std::string_view, 2> shared = {"substeps", "iterations"};
constexpr std::array parameters = {integrator_parameter, tolerance_parameter};
constexpr std::array<MethodPass, 4> own_passes = implicit_passes("newton: factorise, solve, move");

class NewtonStep final : public ImplicitStep<double> {
 public:
  NewtonStep(const SimulationInput& input, std::vector<Pass<double>> effect_passes)
      : ImplicitStep<double>(input, {}), system_(input), positions_(input.positions), orders_(input) {
    constraints_.for_each([](auto& batch) { batch.order = list_order(0); });
    // Far above the weights, and below the stiffness of the membrane, which rounding already bears.
    const double membrane = input.strain.size() > 0 ? 1 / input.strain_stiffness.compliance : 0;
    compile_plan(std::move(effect_passes), 10, 0.3 * membrane);
  }

  const BatchOrder& strain_order() const override { return orders_.strain; }
  const BatchOrder& distance_order() const override { return orders_.distance; }
  const BatchOrder& element_order(std::string_view kind) const override { return orders_.of_elements(kind); }

  std::size_t memory_bytes() const override {
    return ImplicitStep<double>::memory_bytes() + system_.memory_bytes() + bytes_of(multipliers_) +
           static_cast<std::size_t>(positions_.size()) * sizeof(double) + solver_.memory_bytes();
  }
  void archive(Archive& state) override {
    ImplicitStep<double>::archive(state);
    state(multipliers_);
  }

 private:
  double iterate() override {
    for (std::size_t v = 0; v < weights().size(); ++v)
      positions_.row(static_cast<Eigen::Index>(v)) =
          (state_.position[v].vector() + state_.origin).transpose();
    if (multipliers_.size() == 0) multipliers_ = system_.multipliers(positions_);
    VectorXd residual = -system_.gradient(positions_), diagonal(system_.unknowns());
    for (std::size_t v = 0; v < weights().size(); ++v)
      if (const int at = system_.free_index()[v]; at >= 0) {
        residual.segment<3>(3 * at) -= weights()[v] * (state_.position[v].vector() - target()[v].vector());
        diagonal.segment<3>(3 * at).setConstant(weights()[v]);
        if (const auto& contacts = contact_forces(); !contacts.empty()) {
          const Vector3 force = contacts[v].vector();
          residual.segment<3>(3 * at) += force;
          if (force.squaredNorm() > 0)
            diagonal.segment<3>(3 * at) += contact_stiffness(v) * force.normalized().cwiseAbs();
        }
      }
    const auto& hessian = system_.hessian(positions_, system_.convex(multipliers_));
    if (!solver_.factorise(hessian, diagonal))
      throw std::runtime_error("newton: the stiffness matrix is not finite");
    return move(solver_.solve(residual));
  }

  double move(const VectorXd& direction) {
    double share = 1;
    while (system_.strain_beyond_first_order(positions_, share * direction) > stretch_per_step) share *= 0.5;
    // A shortened step takes its share of what the whole one aimed at.
    multipliers_ = (1 - share) * multipliers_ + share * system_.predicted_multipliers(positions_, direction);
    for (std::size_t v = 0; v < weights().size(); ++v)
      if (const int at = system_.free_index()[v]; at >= 0)
        state_.position[v].set(state_.position[v].vector() + share * direction.segment<3>(3 * at));
    return direction.cwiseAbs().maxCoeff();
  }

  ElasticSystem system_;
  Positions positions_;  // #V by 3, m, in world coordinates
  VectorXd multipliers_;
  SupernodalSolver solver_;
  ListOrders orders_;
};

std::unique_ptr<Simulation> make(const SimulationInput& input, std::vector<Pass<double>> effect_passes) {
  return std::make_unique<NewtonStep>(input, std::move(effect_passes));
}

}  // namespace

namespace method {
extern constinit const Method newton{
    .name = "newton",
    .summary = "implicit steps, each solved to its minimum by Newton's method; the reference for motions",
    .source =
        "Baraff and Witkin 1998; as a minimisation: Gast et al. 2015; BDF2: Choi and Ko 2002, §4; CHOLMOD's "
        "supernodal Cholesky factors",
    .limits =
        "of energies only: every stiffness is a compliance above 0; in double precision; factorises in every "
        "iteration, which costs the most of all methods",
    .parameters = parameters,
    .shared = shared,
    .passes = own_passes,
    .factorised = Factorised::blocks,
    .needs_compliance = "k has no energy that a step could minimise",
    .takes = effects_of_iterations,
    .default_substeps = 1,
    .default_iterations = 20,
    .keeps_momentum = true,
    .make_double = make,
};
}  // namespace method
}  // namespace bendlab
