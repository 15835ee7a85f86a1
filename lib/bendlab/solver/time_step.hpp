// What the steps of all solver methods share: the cloth's state, the plan of passes and their times, and the
// test for divergence. A method adds the substep.
#pragma once

#include <algorithm>
#include <array>

#include "bendlab/constraints/yielding.hpp"
#include "bendlab/solver/list_orders.hpp"
#include "bendlab/solver/ordered_constraints.hpp"
#include "bendlab/solver/workers.hpp"

namespace bendlab {

template <class Real>
struct PlannedPass {
  std::function<void(PassContext<Real>&)> run;
  std::size_t statistics;  ///< its row in passes()
  bool counts = true;      ///< whether run() counts as a call of the pass; false: as a part of a call
};

template <class Real>
class TimeStep : public Simulation {
 public:
  bool step() final;
  double time() const final {
    return static_cast<double>(substeps_done_) * (settings_.dt / settings_.substeps);
  }
  Positions positions() const final {
    return to_rows(state_.position, state_.position_remainder, state_.origin);
  }
  Positions velocities() const final {
    return to_rows(state_.velocity, state_.velocity_remainder, Vector3::Zero());
  }
  const Divergence& divergence() const final { return divergence_; }
  const std::vector<PassStatistics>& passes() const final { return statistics_; }
  double helper_seconds() const final { return earlier_helper_seconds_ + workers_.helper_seconds(); }
  std::uint64_t projections() const override { return substeps() * projections_per_substep(); }
  std::uint64_t substeps() const final { return substeps_done_ + cut_substeps_; }
  std::size_t memory_bytes() const override;
  const BatchOrder& strain_order() const final { return lists_ ? lists_->strain : constraints_.strain.order; }
  const BatchOrder& distance_order() const final {
    return lists_ ? lists_->distance : constraints_.distance.order;
  }
  const BatchOrder& element_order(std::string_view kind) const final {
    return lists_ ? lists_->of_elements(kind) : element_order_of(constraints_, kind);
  }
  void archive(Archive& state) override;

 protected:
  using Passes = std::vector<PlannedPass<Real>>;

  /// `permutation`: the index of each vertex in the arrays; empty: vertices keep their indices.
  TimeStep(const SimulationInput& input, std::vector<int> permutation);

  /// Fills constraints_, which effects read. Without this call constraints_ is empty.
  void order_constraints(const SimulationInput& input, const Ordering& ordering = {});

  /// Adds a pass that lets elements yield at the end of a substep, if any element can.
  void add_yield_pass(Passes& passes) {
    if (yields_) add_pass(passes, "yield", [this](auto& c) { c.acted += yield(); });
  }
  /// Lets the elements of constraints_ yield. A method with elements of its own overrides this function, and
  /// adds those elements to archive(). Returns the number of elements that yielded.
  virtual std::size_t yield() { return yield_to<Real>(constraints_.elements, state_.position.data()); }
  bool yields() const { return yields_; }

  /// Multiplies the stated stiffnesses, from now on. A method with elements or factors of its own overrides
  /// this function, which changes constraints_ only. The simulation calls it before a substep if a factor
  /// changes.
  virtual void scale_stiffness(const StiffnessFactors& factors);

  virtual void substep(PassContext<Real>& context) = 0;
  virtual std::uint64_t projections_per_substep() const = 0;

  std::size_t permuted(std::size_t point) const {
    return point < permutation_.size() ? static_cast<std::size_t>(permutation_[point]) : point;
  }
  bool is_vertex(std::size_t point) const { return point < static_cast<std::size_t>(state_.vertex_count); }
  /// What coordinates of a point are relative to: State::origin, but 0 for a director.
  Vector3 origin_of(std::size_t point) const { return is_vertex(point) ? state_.origin : Vector3::Zero(); }

  /// Adds a pass of the method (not of an effect) to the end of `passes`.
  void add_pass(Passes& passes, const std::string& name, std::function<void(PassContext<Real>&)> run) {
    passes.push_back({std::move(run), add_statistics(name)});
  }
  /// Moves the effects' passes of one stage to the end of `passes`.
  void append_effects(Passes& passes, std::vector<Pass<Real>>& effect_passes, Stage stage);
  /// An action of the method before or after `pass`, an effect's pass, whose time includes the action.
  static PlannedPass<Real> part_of(const PlannedPass<Real>& pass, auto action) {
    return {std::move(action), pass.statistics, false};
  }
  void run(const Passes& passes, PassContext<Real>& context);

  /// Tests whether all positions are finite and within bounds. A method calls this at the end of a substep.
  void find_divergence();

  /// Calls task(first, last) on parts of [0, #P), in several threads.
  template <class Task>
  void for_points(const Task& task) {
    // About 10 µs of one thread's work. With less work a second thread saves no time.
    constexpr std::size_t worthwhile_points = 16384;
    const auto count = static_cast<std::size_t>(state_.point_count);
    workers_.for_range(0, count, count >= worthwhile_points, task);
  }

  SolverSettings settings_;
  std::vector<int> permutation_;  ///< #V, the index of each vertex in the arrays; empty: no change
  Workers workers_;
  State<Real> state_;
  Constraints<Real> constraints_;
  std::uint64_t cut_substeps_ = 0;  ///< substeps added by cutting, beyond /solver/substeps

  /// The axes along which each held vertex stays where it is, in the order of state_.position.
  struct Held {
    std::size_t point;
    std::array<bool, 3> axes;
  };
  std::vector<Held> held_;
  bool is_held(std::size_t point, int axis) const {
    return std::ranges::any_of(held_, [&](const Held& held) {
      return held.point == point && held.axes[static_cast<std::size_t>(axis)];
    });
  }
  /// Moves held vertices back along their held axes, to their places before the substep.
  void hold_axes() {
    for (const Held& held : held_) {
      Vector3Of<Real> x = state_.position[held.point].vector();
      const Vector3Of<Real> before = state_.previous[held.point].vector();
      for (int axis = 0; axis < 3; ++axis)
        if (held.axes[static_cast<std::size_t>(axis)]) x(axis) = before(axis);
      state_.position[held.point].set(x);
    }
  }
  /// Sets the coordinates of held axes to 0.
  void drop_held(Points<Real>& vectors) const {
    for (const Held& held : held_) {
      Vector3Of<Real> v = vectors[held.point].vector();
      for (int axis = 0; axis < 3; ++axis)
        if (held.axes[static_cast<std::size_t>(axis)]) v(axis) = 0;
      vectors[held.point].set(v);
    }
  }

  /// The rest shape in the order of state_.position, or null.
  const Point<Real>* rest_points() const { return rest_.empty() ? nullptr : rest_.data(); }

 private:
  void fill_state(const SimulationInput& input);
  std::size_t add_statistics(const std::string& name);  // returns its row in passes()
  bool within_bound(const Point<Real>& p) const;
  Positions to_rows(const Points<Real>& points, const Points<Real>& remainders, const Vector3& origin) const;

  void name_worst_triangle();
  void follow_schedules();

  Real bound_;
  bool yields_;  // whether any element can yield
  Schedule strain_schedule_, bending_schedule_;
  StiffnessFactors factors_;
  Real strain_compliance_ = 0;  // of constraints_ as stated
  double bending_compliance_ = 0;
  Points<Real> rest_;
  std::optional<ListOrders> lists_;  // empty once constraints_ are ordered
  std::vector<PassStatistics> statistics_;
  std::vector<std::function<void(Archive&)>> effect_archives_;
  double earlier_helper_seconds_ = 0;  // before the checkpoint, read from an archive
  std::uint64_t substeps_done_ = 0;
  Divergence divergence_{.time = 0, .vertex = -1, .position = Vector3::Zero()};
};

}  // namespace bendlab
