// Implicit steps by L-BFGS on a constant metric (Liu et al. 2017).
//
//   per iteration:  g = ∇E + W (x - y) → two loops over the last m pairs around A⁻¹ → move
//
//   A = W + Σ k DᵀD + Σ κ κᵀ / α
//
// A is a matrix of scalars, the same for x, y and z (elastic_metric.hpp), so it is factorised once and its
// factor serves every iteration of the run. It holds what a membrane resists in its plane and how bending
// resists in the rest shape. What it gets wrong (a sheet has no stiffness across itself) the pairs of moves
// and gradients correct. They are kept from substep to substep: G = ∇E + W x does not depend on y, so a pair
// of two substeps is as good as one of two iterations. A history that starts anew with every substep takes
// many times the iterations.
//
// No line search: A is stiffer than the cloth in most directions, and an energy in single precision could not
// tell. A pair is kept unless it shows less curvature than inertia alone. An iteration that would move a
// vertex by more than `longest_move` is shortened, and if gradients grow, the pairs are forgotten.
//
// Without pins the cloth is shifted so that W (x - y) sums to the contacts' force: linear momentum then
// changes by forces alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bendlab/constraints/kernels.hpp"
#include "bendlab/parameters/names.hpp"
#include "bendlab/solver/elastic_metric.hpp"
#include "bendlab/solver/implicit_step.hpp"
#include "bendlab/solver/memory.hpp"
#include "bendlab/solver/ordered_constraints.hpp"
#include "bendlab/solver/pair_history.hpp"
#include "bendlab/solver/push_tension.hpp"
#include "bendlab/solver/sparse_factor.hpp"

namespace bendlab {
namespace {

// Two threads pay off for more lanes than this (about 10 µs of work).
constexpr std::size_t worthwhile_lanes = 4096;
constexpr double longest_move = 0.1;      // of the cloth's size, per iteration
constexpr double contact_per_weight = 5;  // stiffer contacts overshoot: the metric does not follow them
constexpr double growth = 10;             // of the gradient over one iteration: the pairs mislead

constexpr std::array<std::string_view, 3> shared = {"substeps", "iterations", "precision"};

enum class MembraneChoice { stated, automatic };
constexpr std::array<std::string_view, 2> membrane_names = {"stated", "auto"};

// BDF2 gains energy where iterations have not converged.
constexpr Parameter euler_parameter = [] {
  Parameter parameter = integrator_parameter;
  parameter.default_value = "euler";
  return parameter;
}();

// clang-format off
constexpr std::array parameters = {
    euler_parameter,
    tolerance_parameter,
    Parameter{.name = "history", .type = ParameterType::integer, .unit = "", .default_value = 10,
              .meaning = "Pairs of moves and gradients that are kept (m of L-BFGS); 0: the metric alone",
              .minimum = 0, .maximum = 100},
    Parameter{.name = "membrane", .type = ParameterType::text, .unit = "", .default_value = "stated",
              .meaning = "auto: a membrane that is stiffer than membrane_error asks for is softened to that. "
                         "Iterations grow as the square root of its stiffness",
              .choices = membrane_names},
    Parameter{.name = "membrane_error", .type = ParameterType::number, .unit = "1", .default_value = 3e-3,
              .meaning = "membrane auto: how far the softer membrane may move the cloth at rest under the "
                         "first step's forces, in sizes of the cloth",
              .minimum = 0, .above = true},
};
// clang-format on

constexpr std::array own_passes = [] {
  const auto [start, target, iterate, update] =
      implicit_passes("quasi_newton: gradient, metric and pairs, move");
  return std::array{start, target,
                    MethodPass{"factorise", "the constant metric, once, when the first forces are known"},
                    iterate, update};
}();

template <class Real>
class QuasiNewtonStep final : public ImplicitStep<Real> {
  using Base = ImplicitStep<Real>;
  using Base::settings_, Base::state_, Base::constraints_, Base::weights, Base::target;

 public:
  QuasiNewtonStep(const SimulationInput& input, std::vector<Pass<Real>> effect_passes)
      : Base(input, input.permutation),
        metric_(elastic_metric(input)),
        pairs_(4 * input.mass.size(), static_cast<std::size_t>(own_settings(input).integer("history"))),
        size_(input.size),
        longest_move_(static_cast<Real>(longest_move * input.size)),
        strain_compliance_(input.strain.size() > 0 ? input.strain_stiffness.compliance : 0),
        push_tension_(input.push_tension) {
    const ParameterValues own = own_settings(input);
    if (named<MembraneChoice>(own.text("membrane"), membrane_names) == MembraneChoice::automatic)
      membrane_error_ = own.number("membrane_error");
    constraints_ = ordered_constraints<Real>(input, this->rest_points(), nullptr);
    force_.resize(state_.position.size());
    gradient_ = direction_ = force_;
    free_direction_.resize(metric_.vertices.size());
    for (int& v : metric_.vertices) v = static_cast<int>(this->permuted(static_cast<std::size_t>(v)));
    this->prepare_by({"factorise", [this] {
                        if (!factor_) prepare(needed_softness());
                      }});
    this->compile_plan(std::move(effect_passes), contact_per_weight, 0);
  }

  const BatchOrder& strain_order() const override { return constraints_.strain.order; }
  const BatchOrder& distance_order() const override { return constraints_.distance.order; }
  const BatchOrder& element_order(std::string_view kind) const override {
    return element_order_of(constraints_, kind);
  }
  std::optional<double> membrane_softness() const override { return softness_; }

  std::size_t memory_bytes() const override {
    return Base::memory_bytes() + bytes_of(metric_.membrane) + bytes_of(metric_.bending) +
           bytes_of(metric_.vertices) + pairs_.memory_bytes() + bytes_of(force_) + bytes_of(gradient_) +
           bytes_of(direction_) + bytes_of(free_direction_) + (factor_ ? factor_->memory_bytes() : 0);
  }
  void archive(Archive& state) override {
    Base::archive(state);
    pairs_.archive(state);
    state(softness_);
    if (state.reads() && softness_) prepare(*softness_);
  }

 private:
  Real iterate() override {
    // G has another W from BDF2's second substep on, and where contacts begin or end. Gradients change with
    // pins, too.
    if (this->is_first_iteration() && this->weights_changed()) pairs_.clear(), pairs_.forget_last();
    if (this->is_first_iteration() && this->pins_moved()) pairs_.forget_last();
    find_gradient();
    pairs_.add(&state_.position.front().x, &gradient_.front().x, weights().data());
    const double norm = find_residual();
    if (!this->is_first_iteration() && norm > growth * last_norm_) pairs_.clear();
    last_norm_ = norm;
    return move(find_direction());
  }

  // The membrane moves the cloth at rest by at most `per_load` F / Y sizes under loads of F newtons in all:
  // in tests 3.5 on a sheet that hangs by patches at two corners, and a tenth of that by its upper or left
  // side.
  double needed_softness() const {
    constexpr double per_load = 5;
    if (!(membrane_error_ > 0) || !(strain_compliance_ > 0)) return 1;
    const double stiffness = std::max(per_load * this->total_force() / (size_ * membrane_error_),
                                      membrane_for_push(push_tension_, membrane_error_));  // N/m
    return stiffness > 0 ? std::max(1.0, 1 / (strain_compliance_ * stiffness)) : 1;
  }

  void prepare(double softness) {
    softness_ = softness;
    constraints_.strain.compliance = static_cast<Real>(softness * strain_compliance_);
    Eigen::SparseMatrix<double> matrix = metric_.membrane / softness + metric_.bending;
    const std::vector<Real> lasting = this->lasting_weights();
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      matrix.coeffRef(i, i) +=
          (this->has_contacts() ? 1 + contact_per_weight : 1) *
          static_cast<double>(
              lasting[static_cast<std::size_t>(metric_.vertices[static_cast<std::size_t>(i)])]);
    factor_.emplace(matrix);
  }

  Points<Real> elastic_forces(const Points<Real>& positions) const override {
    Points<Real> forces(positions.size());
    constraints_.for_each([&](const auto& batch) {
      add_forces(positions.data(), forces.data(), batch, 0, batch.order.stack_count());
    });
    return forces;
  }

  void find_gradient() {
    std::fill(force_.begin(), force_.end(), Point<Real>{});
    constraints_.for_each([&](const auto& batch) {
      const std::vector<std::size_t>&colours = batch.order.colours, &stacks = batch.order.stacks;
      for (std::size_t colour = 0; colour + 1 < colours.size(); ++colour) {
        const std::size_t first = colours[colour], last = colours[colour + 1];
        this->workers_.for_range(first, last, stacks[last] - stacks[first] >= worthwhile_lanes,
                                 [&](std::size_t from, std::size_t to) {
                                   add_forces(state_.position.data(), force_.data(), batch, from, to);
                                 });
      }
    });
    for (std::size_t v = 0; this->has_contacts() && v < weights().size(); ++v)
      if (this->contacts().pushes(v)) force_[v].set(force_[v].vector() + this->contacts().force(v));
    for (std::size_t v = 0; v < weights().size(); ++v)
      gradient_[v].set(weights()[v] > 0 ? weights()[v] * state_.position[v].vector() - force_[v].vector()
                                        : Vector3Of<Real>::Zero().eval());
  }

  // Fills direction_ with the gradient and returns its norm, N.
  double find_residual() {
    double squared = 0;
    for (std::size_t v = 0; v < weights().size(); ++v) {
      const Vector3Of<Real> g = gradient_[v].vector() - weights()[v] * target()[v].vector();
      direction_[v].set(g);
      squared += static_cast<double>(g.squaredNorm());
    }
    return std::sqrt(squared);
  }

  // Turns it into the direction, and returns its longest move, m.
  Real find_direction() {
    pairs_.direct(&direction_.front().x, [&](Real*) {
      for (std::size_t i = 0; i < free_direction_.size(); ++i)
        free_direction_[i] = direction_[static_cast<std::size_t>(metric_.vertices[i])];
      factor_->solve(free_direction_.data());
      for (std::size_t i = 0; i < free_direction_.size(); ++i)
        direction_[static_cast<std::size_t>(metric_.vertices[i])].set(free_direction_[i].vector());
    });
    Real longest = 0;
    for (const int v : metric_.vertices)
      longest = std::max(longest, direction_[static_cast<std::size_t>(v)].vector().cwiseAbs().maxCoeff());
    return longest;
  }

  Real move(Real longest) {
    const Real share = longest > longest_move_ ? longest_move_ / longest : Real(1);
    for (const int free : metric_.vertices) {
      const auto v = static_cast<std::size_t>(free);
      Point<Real>& p = state_.position[v];
      p.set(p.vector() - share * direction_[v].vector());
    }
    this->keep_momentum();
    return share * longest;
  }

  ElasticMetric metric_;  // its vertices are slots
  std::optional<SparseFactor<Real>> factor_;
  PairHistory<Real> pairs_;
  double size_, membrane_error_ = 0;
  Real longest_move_;
  double last_norm_ = 0;  // of the gradient in this substep, N
  double strain_compliance_, push_tension_;
  std::optional<double> softness_;             // of the membrane, times the stated compliance
  Points<Real> force_, gradient_, direction_;  // by slot; gradient_ is W x - force
  Points<Real> free_direction_;                // by metric_.vertices
};

template <class Real>
std::unique_ptr<Simulation> make(const SimulationInput& input, std::vector<Pass<Real>> effect_passes) {
  return std::make_unique<QuasiNewtonStep<Real>>(input, std::move(effect_passes));
}

}  // namespace

namespace method {
extern constinit const Method quasi_newton{
    .name = "quasi_newton",
    .summary = "implicit steps by L-BFGS on a metric that is factorised once; the fastest to a pose at rest",
    .source = "Liu, Bouaziz and Kavan 2017; pairs are kept over steps and the membrane is softened: ours",
    .limits =
        "of energies only: every stiffness is a compliance above 0; a step of few iterations lags behind the "
        "motion, the more the stiffer the membrane; takes no model whose force jumps",
    .parameters = parameters,
    .shared = shared,
    .passes = own_passes,
    .factorised = Factorised::scalars,
    .needs_compliance = "k has no energy that a step could minimise",
    .takes = effects_of_iterations,
    .default_substeps = 1,
    .default_iterations = 10,
    .steps_implicitly = true,
    .keeps_momentum = true,
    .make_float = make<float>,
    .make_double = make<double>,
};
}  // namespace method
}  // namespace bendlab
