// The time step of position-based dynamics (Müller et al. 2007, §3.1).
//
//   per substep h:  force passes → damp passes → predict → predicted passes →
//                   n × (levels, strain, bending, project passes, contact passes) → update →
//                   velocity passes
//
// The plan has only the passes that the scene needs, so other passes take no time.
//
// How the constraints are stored, and why. A projection reads two or three points, does a little arithmetic,
// and writes the points. So moving the points through memory takes most of the time. Therefore
//
// * a vertex is four numbers, the position and the inverse mass. One load or store moves all four, and
//   kernels transpose them in registers. Separate arrays of x, y, z and w would take four loads;
// * constraints without a common vertex are projected at the same time, one in each SIMD lane. Such
//   constraints have the same colour: a greedy first-fit over the list gives the colours, after the pins are
//   known (a constraint between pinned vertices is left out). The colours do not depend on the numbers of
//   lanes and threads, so these numbers change no bit of the result;
// * springs are coloured as stars: one lane has up to four springs of one centre. The centre stays in a
//   register, which halves the memory traffic. The colours are few and large, which suits threads, because
//   threads wait for each other once per colour. Longer stars are faster but converge worse;
// * triangles are coloured one by one, because stars of triangles would be too short to save time;
// * a batch stores offsets, rest values and XPBD's multipliers in the order in which the kernel needs them.
//   Nothing is computed twice, and there are no branches;
// * vertices keep the mesh's numbers if neighbours have close numbers. If not (a scanned or exported mesh may
//   be numbered at random), vertices get the reverse Cuthill-McKee order;
// * a single thread projects all colours of one tile of vertices before the next tile (tiling.hpp). So the
//   points of a large mesh are read from memory once per projection sweep, not once per colour. Several
//   threads project colour after colour; the result has the same bits.
//
// Colours slow down convergence: a correction reaches the neighbours only with the next colour, but in list
// order at once. The page about accuracy compares them. `order: mesh` projects in list order, by scalar code
// (oracle.hpp).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include "bendlab/constraints/kernels.hpp"
#include "bendlab/constraints/oracle.hpp"
#include "bendlab/solver/coarse_levels.hpp"
#include "bendlab/solver/force_steps.hpp"
#include "bendlab/solver/memory.hpp"
#include "bendlab/solver/methods.hpp"
#include "bendlab/solver/order_from_pins.hpp"
#include "bendlab/solver/time_step.hpp"

namespace bendlab {
namespace {

constexpr std::array own_passes = {
    MethodPass{"predict", "x += h v"},
    MethodPass{"levels", "if levels is above 0: projects coarse levels, which move corrections far"},
    MethodPass{"strain", "/material/strain: keeps the triangles' shapes"},
    MethodPass{"hold", "/pins/hold_x, hold_y, hold_z: moves held vertices back along their axes"},
    MethodPass{"update", "v from the change of x; looks for divergence"},
};

// clang-format off
constexpr std::array<std::string_view, 2> sweep_names = {"forward", "symmetric"};
constexpr std::array<std::string_view, 3> order_names = {"colour", "mesh", "pins"};
constexpr std::array<std::string_view, 2> first_names = {"strain", "bending"};

constexpr std::array fields = {
    field<&Pbd::sweep>({.name = "sweep",
        .meaning = "Order within an iteration. forward: from the first constraint to the last; symmetric: "
                   "forward, then backward, which avoids jitter at small time steps and takes twice as many "
                   "projections",
        .choices = sweep_names}),
    field<&Pbd::order>({.name = "order",
        .meaning = "Order of the constraints. colour: in groups in which no two constraints share a vertex; "
                   "mesh: one after another, as the model lists them; pins: one after another, from the "
                   "pinned vertices outwards",
        .choices = order_names}),
    field<&Pbd::first>({.name = "first",
        .meaning = "Which constraints are projected first in an iteration", .choices = first_names}),
    field<&Pbd::flight_limit>({.name = "flight_limit", .unit = "1",
              .meaning = "Largest change of a triangle's deformation gradient by the forces of a substep, "
                         "before constraints are projected. If the change would be larger, near pins for "
                         "example, the substep is cut into equal parts, at most 1000. 0: no substep is cut. "
                         "In a pinned row of triangles of height a, the change by gravity is g h² / a: 0.17 "
                         "for 64 cells per metre and h = 1/60 s",
              .minimum = 0}),
    field<&Pbd::levels>({.name = "levels",
              .meaning = "Largest number of coarse levels. Each iteration projects the levels before the "
                         "constraints. Each level has fewer vertices than the level before, and limits the "
                         "distances between them. With levels the cloth stretches less if substeps are few. "
                         "0: no levels; 12: as many levels as the mesh allows. There are no levels if "
                         "there are at least as many substeps as edges across the cloth",
              .minimum = 0, .maximum = 12}),
};
// clang-format on

int sweeps_per_iteration(const Pbd& settings) {
  return settings.sweep == Sweep::symmetric ? 2 : 1;
}

// With less work than this (about 10 µs of projections) a second thread saves no time.
constexpr std::size_t worthwhile_lanes = 2048;
// Predicts positions from `x`. `remainder` has what rounding cuts off the positions. The arrays have x, y, z
// and w of each point, point after point.
template <class Real>
void predict_numbers(const Real* __restrict x, const Real* __restrict velocity, Real h,
                     Real* __restrict position, Real* __restrict predicted, Real* __restrict remainder,
                     std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    Real sum = x[i];
    remainder[i] = sum_with_remainder<Real>(sum, remainder[i] + h * velocity[i]);
    position[i] = predicted[i] = sum;
  }
}

// Predicts the moves that a substep adds to positions.
template <class Real>
void predict_moves_of_numbers(const Real* __restrict remainder, const Real* __restrict velocity, Real h,
                              Real* __restrict moved, Real* __restrict predicted, std::size_t first,
                              std::size_t last) {
  for (std::size_t i = first; i < last; ++i) moved[i] = predicted[i] = remainder[i] + h * velocity[i];
}

// At the end of a substep, only the moves of projections change velocities, so velocities keep all digits if
// projections move nothing. `velocity_remainder` has what rounding cuts off the velocities. The arrays have
// x, y, z and w of each point, point after point.
template <class Real>
void update_velocities(const Real* __restrict moved, const Real* __restrict predicted, Real per_substep,
                       Real* __restrict velocity, Real* __restrict velocity_remainder, std::size_t first,
                       std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    Real v = velocity[i];
    velocity_remainder[i] =
        sum_with_remainder<Real>(v, (moved[i] - predicted[i]) * per_substep + velocity_remainder[i]);
    velocity[i] = v;
  }
}

// Updates velocities like update_velocities(), and positions. For moves that are stored apart from positions.
template <class Real>
void update_numbers(const Real* __restrict base, const Real* __restrict moved,
                    const Real* __restrict predicted, Real per_substep, Real* __restrict position,
                    Real* __restrict position_remainder, Real* __restrict velocity,
                    Real* __restrict velocity_remainder, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    Real v = velocity[i], x = base[i];
    velocity_remainder[i] =
        sum_with_remainder<Real>(v, (moved[i] - predicted[i]) * per_substep + velocity_remainder[i]);
    position_remainder[i] = sum_with_remainder<Real>(x, moved[i]);
    velocity[i] = v, position[i] = x;
  }
}

// The data of a substep that are not in State or Constraints. In single precision projections change
// positions. If positions have too few digits, projections change moves, which are stored apart from
// positions (see Places).
template <class Real>
struct PbdData {
  Points<Real> before_forces;  // velocities, m/s; with flight_limit only
  Points<Real> predicted;      // single precision: predicted positions or moves (whichever change), m
  Points<Real> moved;          // single precision: moves since the start of the substep, if they change, m
  std::vector<std::size_t> pinned;  // single precision: pinned vertices, permuted
  Points<Real> put;                 // single precision: where effects put pinned vertices in this substep, m
  bool are_put = false;             // whether effects put pinned vertices in this substep
  double last_substep = 0;          // s, of a part if flight_limit cut the substep; 0: no substep yet
};

// Position-based dynamics (Müller et al. 2007): predict, project, update.
template <class Real>
class PbdStep final : public TimeStep<Real> {
  using Base = TimeStep<Real>;
  // Double precision needs no remainders: with 4096 substeps in 1/60 s, velocities are rounded by 3e-11 m/s.
  static constexpr bool keeps_remainders = std::is_same_v<Real, float>;

  using Base::add_pass, Base::append_effects, Base::constraints_, Base::cut_substeps_, Base::find_divergence,
      Base::for_points, Base::run, Base::settings_, Base::state_, Base::workers_;

 public:
  PbdStep(const SimulationInput& input, std::vector<Pass<Real>> effect_passes)
      : Base(input, input.permutation),
        pbd_(settings_of<Pbd>(input)),
        on_moves_(keeps_remainders && input.moves_apart) {
    if constexpr (keeps_remainders) {
      data_.predicted.resize(state_.position.size());
      if (on_moves_) data_.moved = data_.predicted;
      state_.position_remainder = state_.velocity_remainder = data_.predicted;
      for (std::size_t v = 0; v < static_cast<std::size_t>(state_.vertex_count); ++v)
        if (state_.position[v].w == 0) data_.pinned.push_back(v);
      data_.put.resize(data_.pinned.size());
    }
    this->order_constraints(
        input,
        {.order = pbd_.order, .projections = bendlab::projections_per_substep(input), .tiles = &tiles_});
    if (const auto most = pbd_.levels; most > 0 && levels_are_worthwhile(input)) levels_.emplace(input, most);
    compile_plan(std::move(effect_passes));
  }

  std::size_t memory_bytes() const override {
    return Base::memory_bytes() + bytes_of(data_.before_forces) + bytes_of(data_.moved) +
           bytes_of(data_.predicted) + (levels_ ? levels_->memory_bytes() : 0);
  }
  void archive(Archive& state) override {
    Base::archive(state);
    state(data_.last_substep);
  }
  std::optional<EffectiveStiffness> effective_stiffness() const override {
    const auto count = static_cast<std::size_t>(state_.point_count);
    const auto vectors = [&](const Point<Real>* points) {
      std::vector<Vector3> all;
      for (std::size_t v = 0; points != nullptr && v < count; ++v)
        all.push_back(points[v].vector().template cast<double>());
      return all;
    };
    std::vector<Vector3> positions = vectors(state_.position.data());
    if constexpr (keeps_remainders) {
      const std::vector<Vector3> remainders = vectors(state_.position_remainder.data());
      for (std::size_t v = 0; v < count; ++v) positions[v] += remainders[v];
    }
    const std::vector<Vector3> rest = vectors(this->rest_points());
    std::vector<char> is_pinned;
    double largest = 0;
    for (std::size_t v = 0; v < count; ++v) {
      is_pinned.push_back(state_.position[v].w == 0);
      largest = std::max(largest, positions[v].cwiseAbs().maxCoeff());
    }
    const double rounding = largest * static_cast<double>(std::numeric_limits<Real>::epsilon());
    EffectiveStiffness stiffness = bendlab::effective_stiffness(
        constraints_, {positions, rest, is_pinned, data_.last_substep, rounding});
    if (levels_) stiffness.membrane = {};  // levels carry a part of it, which multipliers leave out
    return stiffness;
  }

 private:
  void substep(PassContext<Real>& context) override {
    const Real whole = context.substep;
    const int steps = pbd_.flight_limit > 0 ? needed_force_steps(context) : 1;
    context.substep = whole / static_cast<Real>(steps);
    data_.last_substep = static_cast<double>(context.substep);
    for (int step = 0; step < steps; ++step) {
      run(forces_, context);
      run(before_, context);
      for (int iteration = 0; iteration < settings_.iterations; ++iteration) {
        run(before_sweep_, context);
        run(forward_, context);
        run(after_sweep_, context);
        if (pbd_.sweep != Sweep::symmetric) continue;
        run(backward_, context);
        run(after_sweep_, context);
      }
      run(after_, context);
      context.time += static_cast<double>(context.substep);
    }
    cut_substeps_ += static_cast<std::uint64_t>(steps - 1);
    context.substep = whole;
  }

  // The number of parts into which a substep is cut. The number depends on forces, not on velocities.
  // Otherwise a strained cloth would cut substeps ever finer, because each cut turns strain into speed.
  int needed_force_steps(PassContext<Real>& context) {
    data_.before_forces = state_.velocity;
    const Points<Real> remainder = state_.velocity_remainder;
    run(forces_, context);
    const Real gained =
        largest_gained_gradient(state_.velocity.data(), data_.before_forces.data(), constraints_.strain);
    std::swap(state_.velocity, data_.before_forces);
    state_.velocity_remainder = remainder;
    return force_steps(gained * context.substep, pbd_.flight_limit);
  }

  std::uint64_t projections_per_substep() const override {
    return static_cast<std::uint64_t>(
               static_cast<std::uint64_t>(settings_.iterations * sweeps_per_iteration(pbd_))) *
           constraint_count();
  }

  std::size_t constraint_count() const {
    std::size_t count = constraints_.own.count;
    constraints_.for_each([&](const auto& batch) { count += batch.count; });
    return count + (levels_ ? levels_->span_count() : 0);
  }

  void scale_stiffness(const StiffnessFactors& factors) override {
    Base::scale_stiffness(factors);
    if (levels_) levels_->scale_stiffness(factors.strain);
  }

  void compile_plan(std::vector<Pass<Real>> effect_passes) {
    const auto add_effects = [&](typename Base::Passes& passes, Stage stage) {
      append_effects(passes, effect_passes, stage);
    };
    // Effects that move vertices need positions, so moves are added to positions before these effects.
    const auto add_on_positions = [&](typename Base::Passes& passes, std::initializer_list<Stage> stages) {
      const auto first = static_cast<std::ptrdiff_t>(passes.size());
      for (const Stage stage : stages) add_effects(passes, stage);
      const auto begin = passes.begin() + first;
      if (!on_moves_ || begin == passes.end()) return;
      passes.insert(begin, Base::part_of(*begin, [this](auto&) { sum_up_positions(); }));
      passes.push_back(Base::part_of(passes.back(), [this](auto&) { take_moves_over(); }));
    };
    add_effects(forces_, Stage::force);
    add_effects(before_, Stage::damp);
    add_pass(before_, "predict", [this](auto& c) {
      predict(c.substep);
      hold();
    });
    add_on_positions(before_, {Stage::predicted});
    if (levels_ && levels_->count() > 0)
      add_pass(before_sweep_, "levels", [this](auto& c) { levels_->correct(places(), c.substep, workers_); });
    const bool strain_first = pbd_.first == FirstConstraint::strain;
    if (strain_first) add_projection(constraints_.strain, tiles_.strain, "strain");
    add_projection(constraints_.distance, tiles_.distance, "bending");
    for_each_kind(constraints_.elements, [&]<class Kind>(ElementBatch<Real, Kind>& batch) {
      add_projection(batch, tiles_.elements[kind_index<Kind>], "bending");
    });
    if (constraints_.own.count > 0) {
      add_pass(forward_, "bending",
               [this](auto& c) { project(places(), constraints_.own, c.substep, false); });
      backward_.push_back({[this](auto& c) { project(places(), constraints_.own, c.substep, true); },
                           forward_.back().statistics});
    }
    if (!strain_first) add_projection(constraints_.strain, tiles_.strain, "strain");
    std::reverse(backward_.begin(), backward_.end());
    add_on_positions(after_sweep_, {Stage::project, Stage::contact});
    if (!this->held_.empty()) add_pass(after_sweep_, "hold", [this](auto&) { hold(); });
    add_pass(after_, "update", [this](auto& c) { update(c.substep); });
    this->add_yield_pass(after_);
    add_effects(after_, Stage::velocity);
  }

  // Moves held vertices back along their held axes.
  void hold() { on_moves_ ? this->drop_held(data_.moved) : this->hold_axes(); }

  // A batch without constraints gets no pass.
  template <class Batch>
  void add_projection(Batch& batch, const std::vector<StackRange>& tiles, const char* name) {
    if (batch.count == 0) return;
    add_pass(forward_, name, [this, &batch, &tiles](auto& c) { sweep(batch, tiles, c.substep, false); });
    backward_.push_back({[this, &batch, &tiles](auto& c) { sweep(batch, tiles, c.substep, true); },
                         forward_.back().statistics});
  }

  // Calls action(first, last) on parts of the numbers of all points (four each), and waits for all parts.
  template <class Action>
  void for_numbers(const Action& action) {
    for_points([&](std::size_t first, std::size_t last) { action(4 * first, 4 * last); });
  }

  static Real* numbers(Points<Real>& points) { return &points.front().x; }

  // position = previous + moved, for effects.
  void sum_up_positions() {
    const Real *const base = numbers(state_.previous), *const moved = numbers(data_.moved);
    Real* const position = numbers(state_.position);
    for_numbers([&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) position[i] = base[i] + moved[i];
    });
  }

  // moved = position - previous for vertices that effects have moved.
  void take_moves_over() {
    const Real *const base = numbers(state_.previous), *const position = numbers(state_.position);
    Real* const moved = numbers(data_.moved);
    for_numbers([&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        moved[i] = position[i] == base[i] + moved[i] ? moved[i] : position[i] - base[i];
    });
    for (std::size_t i = 0; i < data_.pinned.size(); ++i) data_.put[i] = state_.position[data_.pinned[i]];
    data_.are_put = true;
  }

  // Predicts moves that are stored apart from positions (see Places). The fourth number of a vertex, the
  // inverse mass, never changes.
  void predict_moves(Real h) {
    std::swap(state_.previous, state_.position);
    for_numbers([&](std::size_t first, std::size_t last) {
      predict_moves_of_numbers(numbers(state_.position_remainder), numbers(state_.velocity), h,
                               numbers(data_.moved), numbers(data_.predicted), first, last);
    });
  }

  // Predicts whole positions. The remainder has what rounding cuts off the positions.
  void predict_positions(Real h) {
    std::swap(state_.previous, state_.position);
    for_numbers([&](std::size_t first, std::size_t last) {
      predict_numbers(numbers(state_.previous), numbers(state_.velocity), h, numbers(state_.position),
                      numbers(data_.predicted), numbers(state_.position_remainder), first, last);
    });
  }

  void update_from_positions(Real h) {
    for_numbers([&](std::size_t first, std::size_t last) {
      update_velocities(numbers(state_.position), numbers(data_.predicted), 1 / h, numbers(state_.velocity),
                        numbers(state_.velocity_remainder), first, last);
    });
    for (const std::size_t v : data_.pinned) put_pin(v, state_.position[v], h);
  }

  // Sets a pinned vertex exactly, because a sum could round the last digit differently.
  void put_pin(std::size_t v, const Point<Real>& where, Real h) {
    const Vector3Of<Real> way = where.vector() - state_.previous[v].vector();
    state_.position[v] = where, state_.velocity[v].set(way / h);
    state_.position_remainder[v] = state_.velocity_remainder[v] = {};
  }

  void update_from_moves(Real h) {
    for_numbers([&](std::size_t first, std::size_t last) {
      update_numbers(numbers(state_.previous), numbers(data_.moved), numbers(data_.predicted), 1 / h,
                     numbers(state_.position), numbers(state_.position_remainder), numbers(state_.velocity),
                     numbers(state_.velocity_remainder), first, last);
    });
    if (!std::exchange(data_.are_put, false)) return;
    for (std::size_t i = 0; i < data_.pinned.size(); ++i) put_pin(data_.pinned[i], data_.put[i], h);
  }

  Places<Real> places() {
    Point<Real>* const positions = state_.position.data();
    return on_moves_ ? Places<Real>(state_.previous.data(), data_.moved.data()) : Places<Real>(positions);
  }

  void predict(Real h) {
    constraints_.for_each(
        [](auto& batch) { std::fill(batch.multiplier.begin(), batch.multiplier.end(), Real(0)); });
    std::ranges::fill(constraints_.own.multiplier, 0.0);
    if (levels_) levels_->begin_substep();
    if constexpr (keeps_remainders) return on_moves_ ? predict_moves(h) : predict_positions(h);
    for_points([&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        Point<Real>& p = state_.position[v];
        const Point<Real>& velocity = state_.velocity[v];
        state_.previous[v] = p;
        p.x += h * velocity.x, p.y += h * velocity.y, p.z += h * velocity.z;
      }
    });
  }

  template <class Batch>
  void sweep(Batch& batch, const std::vector<StackRange>& tiles, Real h, bool backwards) {
    const Places<Real> places = this->places();
    if (!batch.order.conflict_free) {
      project_by_oracle(places, batch, h, backwards);
      return;
    }
    for (std::size_t step = 0; step < tiles.size(); ++step) {
      const StackRange& range = tiles[backwards ? tiles.size() - 1 - step : step];
      project(places, batch, range.first, range.last, h, backwards);
    }
    if (!tiles.empty()) return;
    const std::vector<std::size_t>&colours = batch.order.colours, &stacks = batch.order.stacks;
    for (std::size_t step = 0; step + 1 < colours.size(); ++step) {
      const std::size_t colour = backwards ? colours.size() - 2 - step : step;
      const std::size_t first = colours[colour], last = colours[colour + 1];
      workers_.for_range(
          first, last, stacks[last] - stacks[first] >= worthwhile_lanes,
          [&](std::size_t from, std::size_t to) { project(places, batch, from, to, h, backwards); });
    }
  }

  void update(Real h) {
    if constexpr (keeps_remainders) {
      on_moves_ ? update_from_moves(h) : update_from_positions(h);
      return find_divergence();
    }
    for_points([&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        const Point<Real>&p = state_.position[v], &previous = state_.previous[v];
        state_.velocity[v] = {(p.x - previous.x) / h, (p.y - previous.y) / h, (p.z - previous.z) / h, 0};
      }
    });
    find_divergence();
  }

  // force_steps.hpp explains how flight_limit cuts substeps.
  Pbd pbd_;
  // Single precision: whether projections change moves that are stored apart from positions (see Places);
  // false: projections change whole positions.
  bool on_moves_;
  ConstraintTiles tiles_;
  std::optional<CoarseLevels<Real>> levels_;
  typename Base::Passes forces_, before_, before_sweep_, forward_, backward_, after_sweep_, after_;
  PbdData<Real> data_;
};

bool carries_stretch(const Pbd& settings) {
  return settings.levels > 0;
}

void sort(const Pbd& settings, SimulationInput& input, const RestMesh& rest) {
  if (settings.order == ConstraintOrder::pins) order_from_pins(input, rest);
}

}  // namespace

constinit const MethodKind Pbd::kind{
    .name = "pbd",
    .summary =
        "position-based dynamics: predicts positions, projects every constraint several times, and takes "
        "velocities from the moves",
    .source = "Müller et al. 2007, §3; XPBD: Macklin et al. 2016; strain: Müller et al. 2014",
    .limits =
        "stiffness given as k depends on substeps and iterations, and a compliance is exact only if the "
        "iterations converge; energy is not conserved; forward sweeps gain energy in short substeps",
    .settings = table_of<Pbd>(fields),
    .passes = own_passes,
    .holds_axes = true,
    .takes_own_elements = true,
    .projects = true,
    .default_substeps = 8,
    .default_iterations = 1,
    .keeps_momentum = true,
    .keeps_moves_apart = true,
    .sweeps_per_iteration = erased<sweeps_per_iteration>,
    .carries_stretch = erased<carries_stretch>,
    .sort = erased<sort>,
    .make_float = make_step<PbdStep<float>>,
    .make_double = make_step<PbdStep<double>>,
};
}  // namespace bendlab
