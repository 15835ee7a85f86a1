// Implicit steps by L-BFGS with a constant matrix A, the metric (Liu et al. 2017).
//
//   per iteration:  g = ∇E + W (x - y) → A⁻¹ g → corrected by the last m pairs → move
//
//   A = W + Σ k DᵀD + Σ κ κᵀ / α
//
// A approximates the Hessian by scalars that are the same for x, y and z (elastic_metric.hpp). A is constant,
// so A is factorised once, and every iteration of the run uses the factor. A contains the stiffness of the
// membrane in its plane, and of bending in the rest shape. Pairs of moves and gradients correct the errors of
// A: for example, A resists moves along the normal, but a flat sheet does not. Pairs of earlier substeps are
// used, too: G = ∇E + W x does not depend on y, so a pair across two substeps is as good as a pair across two
// iterations. Without earlier pairs many times the iterations would be needed.
//
// There is no line search, because A is stiffer than the cloth in most directions, and energies in single
// precision are too inexact to compare. PairHistory::add() says which pairs are used. A move is shortened if
// a vertex would move by more than `longest_move`. The slope of the energy at the end of a move is known
// without another pass. If the energy rises there, the move was too long, and the next iteration goes back to
// where a line through the slopes at both ends is 0. Large moves cause additional iterations.
//
// Without pins the whole cloth is shifted until W (x - y) sums to the force of the contacts. So only forces
// change momentum.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bendlab/constraints/kernels.hpp"
#include "bendlab/solver/elastic_metric.hpp"
#include "bendlab/solver/implicit_step.hpp"
#include "bendlab/solver/memory.hpp"
#include "bendlab/solver/methods.hpp"
#include "bendlab/solver/pair_history.hpp"
#include "bendlab/solver/soft_membrane.hpp"
#include "bendlab/solver/sparse_factor.hpp"

namespace bendlab {
namespace {

// With more lanes than this (about 10 µs of work) two threads save time.
constexpr std::size_t worthwhile_lanes = 4096;
constexpr double longest_move = 0.1;      // of the cloth's size, per iteration
constexpr double contact_per_weight = 5;  // stiffer contacts overshoot, because A does not follow them
constexpr double larger_load = 2;         // times the load that the membrane was softened for
constexpr double settled_move = 0.1;      // of an edge
// The largest slope at the end of a move, relative to the slope at the start. If the slope at the end is
// larger, a quadratic energy has risen.
constexpr double most_overshoot = 1;

constexpr std::array<std::string_view, 2> membrane_names = {"stated", "auto"};

// clang-format off
constexpr std::array own_fields = {
    field<&QuasiNewton::history>({.name = "history",
              .meaning = "Number of pairs of moves and gradients that L-BFGS stores (its m); 0: only the "
                         "constant matrix is used",
              .minimum = 0, .maximum = 100}),
    field<&QuasiNewton::membrane>({.name = "membrane",
              .meaning = "stated: the stiffness of the material; auto: softer than the material as far as "
                         "membrane_error allows, except near pins. The number of iterations that a step "
                         "needs grows as the square root of the membrane's stiffness",
              .choices = membrane_names}),
    field<&QuasiNewton::membrane_error>({.name = "membrane_error", .unit = "1",
              .meaning = "With membrane auto: how far the softer membrane may move the cloth at rest under "
                         "the first step's forces, as a share of the cloth's size",
              .minimum = 0, .above = true}),
};
// clang-format on
constexpr auto fields = joined(implicit_fields<QuasiNewton>, own_fields);

constexpr std::array own_passes = [] {
  const auto [start, target, iterate, update] =
      implicit_passes("quasi_newton: computes the gradient and the direction, and moves the cloth");
  return std::array{start, target,
                    MethodPass{"factorise", "the constant matrix, once, when the first forces are known"},
                    iterate, update};
}();

// The short side of a half square that has the mean area of the triangles, m.
double mean_edge(const StrainConstraints& strain) {
  double twice_area = 0;
  for (const auto& q : strain.inverse_rest) twice_area += 1 / std::abs(q[0] * q[3] - q[1] * q[2]);
  return strain.size() > 0 ? std::sqrt(twice_area / static_cast<double>(strain.size())) : 0;
}

template <class Real>
class QuasiNewtonStep final : public ImplicitStep<Real> {
  using Base = ImplicitStep<Real>;
  using Base::settings_, Base::state_, Base::constraints_, Base::data_;

 public:
  QuasiNewtonStep(const SimulationInput& input, std::vector<Pass<Real>> effect_passes)
      : Base(input, settings_of<QuasiNewton>(input), input.permutation),
        metric_(input),
        pairs_(input.point_count(), static_cast<std::size_t>(settings_of<QuasiNewton>(input).history)),
        longest_move_(static_cast<Real>(longest_move * input.size)) {
    const QuasiNewton& settings = settings_of<QuasiNewton>(input);
    if (settings.membrane == QuasiNewton::Membrane::automatic)
      membrane_error_ = settings.membrane_error, soft_membrane_.emplace(input);
    this->order_constraints(input);
    force_.resize(state_.position.size());
    edge_ = static_cast<Real>(mean_edge(input.strain));
    gradient_ = applied_ = direction_ = target_change_ = applied_change_ = last_target_ = force_;
    for (const int v : metric_.vertices())
      free_.push_back(static_cast<int>(this->permuted(static_cast<std::size_t>(v))));
    for (std::size_t v = 0; v < static_cast<std::size_t>(state_.vertex_count); ++v)
      if (state_.position[v].w > 0)
        mass_ += state_.mass[v];
      else
        pinned_.push_back(v);
    pin_move_.resize(pinned_.size());
    this->compile_plan(std::move(effect_passes), contact_per_weight, 0);
  }

  std::optional<double> membrane_softness() const override { return softness_; }

  std::size_t memory_bytes() const override {
    return Base::memory_bytes() + metric_.memory_bytes() + bytes_of(free_) + bytes_of(pinned_) +
           pairs_.memory_bytes() + 6 * bytes_of(force_) + bytes_of(pin_move_) +
           (factor_ ? factor_->memory_bytes() : 0);
  }
  void archive(Archive& state) override {
    Base::archive(state);
    pairs_.archive(state);
    state(softness_, load_, last_target_, pin_move_, factorised_);
    if (!state.reads() || !softness_) return;
    const StiffnessFactors now = scaled_;
    scaled_ = factorised_, factorise(), scaled_ = now;
  }

 private:
  // The matrix A stays while the stiffness differs little from that of A.
  void scale_stiffness(const StiffnessFactors& factors) override {
    Base::scale_stiffness(factors);
    pairs_.forget_last();
    constexpr double far = 1.25;
    const auto is_far = [](double now, double before) { return now > far * before || before > far * now; };
    scaled_ = factors;
    if (!factor_ ||
        !(is_far(factors.strain, factorised_.strain) || is_far(factors.bending, factorised_.bending)))
      return;
    factorise();
    pairs_.clear();
  }
  const char* preparation() const override { return "factorise"; }
  void prepare() override {
    if (!factor_) load_ = data_.total_force, factorise();
  }

  Real iterate() override {
    const bool first = data_.is_first_iteration;
    if (first) prepare_for_pins();
    // W, and with it the Hessian, changes in BDF2's second substep, and where contacts begin or end.
    // Gradients also change when pins move.
    if (first && data_.weights_changed) pairs_.clear();
    if (first && (data_.weights_changed || this->pins_moved())) pairs_.forget_last();
    find_gradient();
    factor_->solve(gradient_.data(), applied_.data());
    typename PairHistory<Real>::Place place{state_.position, gradient_, applied_};
    if (first) {
      find_target_change();
      place.gradient_before = &target_change_, place.applied_before = &applied_change_;
    }
    const auto along = pairs_.add(place, data_.weight);
    if (!first && along && along->after > most_overshoot * std::abs(along->before)) return step_back(*along);
    pairs_.direct(applied_, direction_);
    return move(1);
  }

  // A large move may have been too long, and only the next iteration finds this out.
  bool must_go_on() const override {
    return stepped_back_ || last_longest_ > static_cast<Real>(settled_move) * edge_;
  }

  // g = ∇E + W (x - y) changes from substep to substep, because y changes. Computes the change of g, which is
  // -W times the change of y, and A⁻¹ times the change of g.
  void find_target_change() {
    for (std::size_t v = 0; v < data_.weight.size(); ++v)
      target_change_[v].set(data_.weight[v] * (last_target_[v].vector() - data_.target[v].vector()));
    factor_->solve(target_change_.data(), applied_change_.data());
    last_target_ = data_.target;
  }

  // If the energy rises at the end of a move: goes back to where a line through the slopes at both ends is 0.
  Real step_back(const typename PairHistory<Real>::Along& along) {
    const auto share = static_cast<Real>(along.after / (along.after - std::min(along.before, 0.0)));
    for (std::size_t v = 0; v < data_.weight.size(); ++v)
      direction_[v].set(share * last_share_ * -direction_[v].vector());
    const Real longest = move(1);
    stepped_back_ = true;
    return longest;
  }

  // A membrane that was softened for the first loads is too soft for far larger loads, such as the inertia of
  // a cloth whose pin suddenly moves. For such loads the membrane is softened less.
  void prepare_for_pins() {
    if (!soft_membrane_ || !(softness_ > 1)) return;
    const double h = settings_.dt / settings_.substeps;
    double fastest = 0;  // the largest change of a pin's move since the last substep, m
    for (std::size_t i = 0; i < pinned_.size(); ++i) {
      const std::size_t v = pinned_[i];
      const Vector3Of<Real> move = state_.position[v].vector() - state_.previous[v].vector();
      fastest = std::max(fastest, static_cast<double>((move - pin_move_[i].vector()).norm()));
      pin_move_[i].set(move);
    }
    const double load = mass_ * fastest / (h * h);
    if (load <= larger_load * load_) return;
    load_ = load;
    factorise();
    pairs_.clear(), pairs_.forget_last();
  }

  void factorise() {
    std::vector<double> softness(metric_.triangle_count(), 1);
    if (soft_membrane_) softness = soft_membrane_->softness(membrane_error_, load_);
    softness_ = softness.empty() ? 1 : *std::ranges::max_element(softness);
    StrainBatch<Real>& strain = constraints_.strain;
    const std::vector<double>& stated = metric_.stated_softness();
    strain.softness.clear();
    if (softness_ > 1 || !stated.empty()) {
      strain.softness.assign(strain.a.size(), 1);
      const std::vector<int> triangle = strain.order.constraint_of_lane();
      for (std::size_t lane = 0; lane < triangle.size(); ++lane)
        if (triangle[lane] >= 0)
          strain.softness[lane] =
              static_cast<Real>(softness[static_cast<std::size_t>(triangle[lane])] *
                                (stated.empty() ? 1 : stated[static_cast<std::size_t>(triangle[lane])]));
    }
    factorised_ = scaled_;
    for (double& of_triangle : softness) of_triangle /= scaled_.strain;
    Eigen::SparseMatrix<double> matrix = metric_.matrix(softness, scaled_.bending);
    const std::vector<Real> lasting = this->lasting_weights();
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      matrix.coeffRef(i, i) +=
          (data_.contacts.in_use() ? 1 + contact_per_weight : 1) *
          static_cast<double>(lasting[static_cast<std::size_t>(free_[static_cast<std::size_t>(i)])]);
    factor_.emplace(matrix);
    factor_->renumber(free_);
  }

  Points<Real> elastic_forces(const Points<Real>& positions) const override {
    Points<Real> forces(positions.size());
    constraints_.for_each([&](const auto& batch) {
      add_forces(positions.data(), forces.data(), batch, 0, batch.order.stack_count());
    });
    add_forces(positions.data(), forces.data(), constraints_.own);
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
    add_forces(state_.position.data(), force_.data(), constraints_.own);
    for (std::size_t v = 0; data_.contacts.in_use() && v < data_.weight.size(); ++v)
      if (data_.contacts.pushes(v)) force_[v].set(force_[v].vector() + data_.contacts.force(v));
    for (std::size_t v = 0; v < data_.weight.size(); ++v)
      gradient_[v].set(data_.weight[v] > 0
                           ? data_.weight[v] * (state_.position[v].vector() - data_.target[v].vector()) -
                                 force_[v].vector()
                           : Vector3Of<Real>::Zero().eval());
    this->drop_held(gradient_);
  }

  // Moves the cloth by -share direction_, or by less, so that no vertex moves by more than longest_move_.
  // Returns the longest move, m.
  Real move(Real share) {
    this->drop_held(direction_);
    Real longest = 0;
    for (const int v : free_)
      longest = std::max(longest, direction_[static_cast<std::size_t>(v)].vector().cwiseAbs().maxCoeff());
    if (share * longest > longest_move_) share = longest_move_ / longest;
    last_share_ = share;
    for (const int free : free_) {
      const auto v = static_cast<std::size_t>(free);
      Point<Real>& p = state_.position[v];
      p.set(p.vector() - share * direction_[v].vector());
    }
    this->keep_momentum();
    last_longest_ = share * longest;
    stepped_back_ = false;
    return share * longest;
  }

  ElasticMetric metric_;
  std::vector<int> free_;            // slots of the free vertices
  std::vector<std::size_t> pinned_;  // slots of the pinned vertices
  std::optional<SoftMembrane> soft_membrane_;
  std::optional<SparseFactor<Real>> factor_;
  PairHistory<Real> pairs_;
  double membrane_error_ = 0;
  double load_ = 0, mass_ = 0;  // load that the membrane is softened for, N; mass of the free vertices, kg
  Real longest_move_;
  std::optional<double> softness_;                       // of the softest triangle, in stated compliances
  Points<Real> force_, gradient_, applied_, direction_;  // by slot; applied_ is A⁻¹ gradient_
  Points<Real> target_change_, applied_change_, last_target_;  // by slot
  Points<Real> pin_move_;                                      // of pinned_ in the last substep, m
  Real edge_ = 0;                                              // of a mean triangle at rest, m
  StiffnessFactors scaled_, factorised_;                       // of the stiffness now, and of A
  Real last_share_ = 0, last_longest_ = 0;  // the last move as a share of direction_; its length, m
  bool stepped_back_ = false;
};

double error_of_membrane(const QuasiNewton& settings) {
  return settings.membrane == QuasiNewton::Membrane::automatic ? settings.membrane_error : 0;
}

}  // namespace

constinit const MethodKind QuasiNewton::kind{
    .name = "quasi_newton",
    .summary =
        "implicit steps by L-BFGS with a constant matrix that is factorised once; the fastest way to a pose "
        "at rest",
    .source = "Liu, Bouaziz and Kavan 2017; ours: pairs are used across steps, and the membrane is softened",
    .limits =
        "needs energies: every stiffness is a compliance above 0; a step with few iterations lags behind "
        "the motion, more so with a stiffer membrane; takes no model whose force jumps",
    .settings = table_of<QuasiNewton>(fields),
    .passes = own_passes,
    .factorised = Factorised::scalars,
    .bytes_per_vertex = 2000,
    .holds_axes = true,
    .takes_own_elements = true,
    .needs_compliance = "k has no energy that a step could minimise",
    .takes_effects_in_iterations = true,
    .default_substeps = 1,
    .default_iterations = 5,
    .steps_implicitly = true,
    .keeps_momentum = true,
    .membrane_error = erased<error_of_membrane>,
    .make_float = make_step<QuasiNewtonStep<float>>,
    .make_double = make_step<QuasiNewtonStep<double>>,
};
}  // namespace bendlab
