// Implicit steps by Newton's method: the reference for every motion.
//
//   per iteration:  (H + W) Δx = -(∇E + W (x - y)),   H = Σ ψ'' ∇C ∇Cᵀ + λ ∇²C
//
// λ is 0 except for stretched lengths, so that the matrix is positive definite for any pose and any step
// (Gauss-Newton for bending, no compressive membrane stress). For stretched lengths λ is ψ' + ψ'' ∇C·Δx of
// the last iteration; equilibrium.cpp says why. The right side has the forces of the present pose, so the
// iterations converge to the minimum that implicit_step.hpp states.
//
// The move of an iteration is shortened until no triangle stretches by more than `stretch_per_step` beyond
// the stretch to first order, and until the minimised function falls (Armijo's rule). Without Armijo's rule,
// steps of 0.1 s and more went to and fro between stretched poses, and gained energy. Everything is double
// precision.
#include <array>
#include <stdexcept>

#include "bendlab/solver/elastic_system.hpp"
#include "bendlab/solver/implicit_step.hpp"
#include "bendlab/solver/memory.hpp"
#include "bendlab/solver/methods.hpp"
#include "bendlab/solver/supernodal_solver.hpp"

namespace bendlab {
namespace {

using Eigen::VectorXd;

constexpr double stretch_per_step = 0.05;  // 1
constexpr double least_share = 1e-4;       // 1, of the decrease to first order: Armijo's constant
constexpr double near = 1e-6;  // of the cloth's size: shorter moves change the energy within rounding
constexpr double energy_rounding = 1e-11;  // 1

constexpr auto fields = implicit_fields<Newton>;
constexpr std::array<MethodPass, 4> own_passes = implicit_passes("newton: factorise, solve, move");

class NewtonStep final : public ImplicitStep<double> {
 public:
  NewtonStep(const SimulationInput& input, std::vector<Pass<double>> effect_passes)
      : ImplicitStep<double>(input, settings_of<Newton>(input), {}),
        system_(input),
        positions_(input.points()),
        free_axes_(VectorXd::Ones(system_.unknowns())),
        size_(input.size) {
    system_.drop_held(free_axes_);
    // Contacts are much stiffer than inertia, but softer than the membrane, so that contacts add no rounding.
    const double membrane = input.strain.size() > 0 ? 1 / input.strain_stiffness.compliance : 0;
    compile_plan(std::move(effect_passes), 10, 0.3 * membrane);
  }

  std::size_t memory_bytes() const override {
    return ImplicitStep<double>::memory_bytes() + system_.memory_bytes() + bytes_of(multipliers_) +
           static_cast<std::size_t>(positions_.size()) * sizeof(double) + solver_.memory_bytes();
  }
  void archive(Archive& state) override {
    ImplicitStep<double>::archive(state);
    state(multipliers_);
    if (yields()) system_.archive_yields(state);
  }

 private:
  // Multipliers are the slopes of the energies, so they change with the stiffness.
  void scale_stiffness(const StiffnessFactors& factors) override {
    system_.scale_stiffness(factors);
    multipliers_.resize(0);
  }
  std::size_t yield() override { return system_.yield(in_world(state_.position)); }
  Points<double> elastic_forces(const Points<double>& positions) const override {
    return system_.forces(in_world(positions));
  }
  double iterate() override {
    if (data_.is_first_iteration && !data_.contacts.in_use()) start_lower(system_);
    positions_ = in_world(state_.position);
    if (multipliers_.size() == 0) multipliers_ = system_.multipliers(positions_);
    const VectorXd elastic = -system_.gradient(positions_);
    VectorXd residual = elastic, diagonal(system_.unknowns());
    blocks_.clear();
    for (std::size_t v = 0; v < data_.weight.size(); ++v)
      if (const int at = system_.free_index()[v]; at >= 0) {
        residual.segment<3>(3 * at) -=
            data_.weight[v] * (state_.position[v].vector() - data_.target[v].vector());
        diagonal.segment<3>(3 * at).setConstant(data_.weight[v]);
        if (!data_.contacts.in_use() || !data_.contacts.pushes(v)) continue;
        residual.segment<3>(3 * at) += data_.contacts.force(v);
        const Vector3 free = free_axes_.segment<3>(3 * at);
        blocks_.push_back({3 * at, free.asDiagonal() * data_.contacts.stiffness(v) * free.asDiagonal()});
      }
    system_.drop_held(residual);
    factorise(diagonal);
    const VectorXd direction = solver_.solve(residual);
    const double longest = direction.cwiseAbs().maxCoeff();
    double share = 1;
    while (system_.strain_beyond_first_order(positions_, share * direction) > stretch_per_step) share *= 0.5;
    if (longest > near * size_)
      share = lowering(share, {direction, residual.dot(direction), (residual - elastic).dot(direction),
                               direction.dot(diagonal.cwiseProduct(direction)) + along_blocks(direction)});
    move(direction, share);
    keep_momentum();
    return longest;
  }

  double along_blocks(const VectorXd& direction) const {
    double sum = 0;
    for (const DiagonalBlock& block : blocks_) {
      const Vector3 d = direction.segment<3>(block.at);
      sum += d.dot(block.value * d);
    }
    return sum;
  }

  // An almost collapsed triangle has huge gradients, and the rounding of these gradients may make the matrix
  // indefinite. The matrix is definite again without λ and with an added share of its diagonal.
  void factorise(const VectorXd& diagonal) {
    if (solver_.factorise(system_.hessian(positions_, system_.convex(multipliers_)), diagonal, blocks_))
      return;
    const auto& positive = system_.hessian(positions_, VectorXd::Zero(multipliers_.size()));
    const VectorXd own = positive.diagonal();
    for (const double share : {0.0, 1e-14, 1e-12, 1e-10})
      if (solver_.factorise(positive, diagonal + share * own, blocks_)) return;
    throw std::runtime_error(
        "newton: the stiffness matrix is not finite, because triangles have collapsed. Start from another "
        "pose, or choose quasi_newton");
  }

  // The minimised function along a direction d. The parts from inertia and contacts are quadratic along d.
  struct Descent {
    const VectorXd& direction;
    double slope;      // of the whole function, J, positive downhill
    double push;       // the slope of inertia and contacts alone, J
    double curvature;  // of inertia and contacts, J
  };

  // The largest of share, share / 2, share / 4, … that lowers the energy enough.
  double lowering(double share, const Descent& d) const {
    constexpr int halvings = 30;  // rounding decides whether shorter moves lower it
    const double start = system_.energy(positions_), rounding = energy_rounding * start;
    const auto rise = [&](double s) {
      return system_.energy(system_.moved(positions_, s * d.direction)) - start - s * d.push +
             0.5 * s * s * d.curvature;
    };
    for (int i = 0; i < halvings && !(rise(share) <= rounding - least_share * share * d.slope); ++i)
      share *= 0.5;
    return share;
  }

  void move(const VectorXd& direction, double share) {
    // If the move is shortened to a share, the multipliers change by this share, too.
    multipliers_ = (1 - share) * multipliers_ + share * system_.predicted_multipliers(positions_, direction);
    for (std::size_t v = 0; v < data_.weight.size(); ++v)
      if (const int at = system_.free_index()[v]; at >= 0)
        state_.position[v].set(state_.position[v].vector() + share * direction.segment<3>(3 * at));
  }

  ElasticSystem system_;
  Positions positions_;  // #P by 3, m, in world coordinates
  VectorXd free_axes_;   // 0 for held coordinates, 1 for all other unknowns
  double size_;          // m
  VectorXd multipliers_;
  std::vector<DiagonalBlock> blocks_;  // of contacts
  SupernodalSolver solver_;
};

}  // namespace

constinit const MethodKind Newton::kind{
    .name = "newton",
    .summary = "implicit steps by Newton's method, iterated to the minimum; the reference for motions",
    .source =
        "Baraff and Witkin 1998; as a minimisation: Gast et al. 2015; BDF2: Choi and Ko 2002, §4; CHOLMOD's "
        "supernodal Cholesky factors",
    .limits =
        "needs energies: every stiffness is a compliance above 0; double precision only; factorises a "
        "matrix in every iteration, which costs the most of all methods",
    .settings = table_of<Newton>(fields),
    .passes = own_passes,
    .factorised = Factorised::blocks,
    .bytes_per_vertex = 10e3,
    .holds_axes = true,
    .takes_own_elements = true,
    .needs_compliance = "k has no energy that a step could minimise",
    .takes_effects_in_iterations = true,
    .default_substeps = 1,
    .default_iterations = 20,
    .steps_implicitly = true,
    .keeps_momentum = true,
    .mesh_order = true,
    .make_double = make_step<NewtonStep>,
};
}  // namespace bendlab
