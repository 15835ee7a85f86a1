#include "bendlab/solver/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "bendlab/constraints/kernels.hpp"
#include "bendlab/constraints/reference.hpp"
#include "bendlab/solver/colouring.hpp"
#include "bendlab/solver/tiling.hpp"
#include "bendlab/solver/workers.hpp"

namespace bendlab {
namespace {

// Ranges with less work than this are not worth waking a second thread for (about 10 µs of projections).
constexpr std::size_t worthwhile_lanes = 2048;
constexpr std::size_t worthwhile_vertices = 16384;
// A tile's points take a quarter of a second-level cache of 1 MB.
template <class Real>
constexpr int tile_vertices = 262144 / sizeof(Point<Real>);
constexpr double divergence_bound = 1e6;  // sizes from the origin

template <class Real>
struct PlannedPass {
  std::function<void(PassContext<Real>&)> run;
  std::size_t statistics;  // its row in passes()
};

// A list's constraints by place instead of vertex, in the order of their first place, and where each came
// from.
template <std::size_t arity>
struct Placed {
  std::vector<std::array<int, arity>> vertices;
  std::vector<int> original;

  Placed(const std::vector<std::array<int, arity>>& list, const std::vector<int>& place)
      : original(list.size()) {
    std::vector<std::array<int, arity>> placed(list.size());
    for (std::size_t c = 0; c < list.size(); ++c)
      for (std::size_t i = 0; i < arity; ++i) placed[c][i] = place[static_cast<std::size_t>(list[c][i])];
    const auto first = [&](int c) {
      const auto& corners = placed[static_cast<std::size_t>(c)];
      return *std::min_element(corners.begin(), corners.end());
    };
    std::iota(original.begin(), original.end(), 0);
    std::stable_sort(original.begin(), original.end(), [&](int l, int r) { return first(l) < first(r); });
    for (const int c : original) vertices.push_back(placed[static_cast<std::size_t>(c)]);
  }

  BatchOrder in_terms_of_the_list(BatchOrder order) const {
    for (int& constraint : order.constraint_of_lane)
      if (constraint >= 0) constraint = original[static_cast<std::size_t>(constraint)];
    return order;
  }
};

template <class Real>
class SimulationOf final : public Simulation {
 public:
  SimulationOf(const SimulationInput& input, std::vector<Pass<Real>> effect_passes)
      : settings_(input.settings),
        place_(input.place),
        bound_(static_cast<Real>(divergence_bound * input.size)),
        workers_(input.settings.threads) {
    fill_state(input);
    fill_constraints(input);
    compile_plan(std::move(effect_passes));
  }

  bool step() override {
    const Real h = static_cast<Real>(settings_.dt / settings_.substeps);
    PassContext<Real> context{state_, constraints_, h};
    for (int substep = 0; substep < settings_.substeps; ++substep) {
      run(before_, context);
      for (int iteration = 0; iteration < settings_.iterations; ++iteration) {
        run(forward_, context);
        if (settings_.sweep == Sweep::symmetric) run(backward_, context);
      }
      run(after_, context);
      ++substeps_done_;
    }
    return divergence_.vertex < 0 || (divergence_.time = time(), false);
  }

  double time() const override {
    return static_cast<double>(substeps_done_) * (settings_.dt / settings_.substeps);
  }
  Positions positions() const override { return to_rows(state_.position, state_.origin); }
  Positions velocities() const override { return to_rows(state_.velocity, Vector3::Zero()); }
  const Divergence& divergence() const override { return divergence_; }
  const std::vector<PassStatistics>& passes() const override { return statistics_; }
  double helper_seconds() const override { return workers_.helper_seconds(); }
  std::uint64_t projections() const override {
    return substeps_done_ * static_cast<std::uint64_t>(settings_.projections_per_substep()) *
           constraint_count();
  }
  const BatchOrder& strain_order() const override { return constraints_.strain.order; }
  const BatchOrder& distance_order() const override { return constraints_.distance.order; }
  const BatchOrder& element_order(std::string_view kind) const override {
    const BatchOrder* found = nullptr;
    for_each_kind(constraints_.elements, [&]<class Kind>(const ElementBatch<Real, Kind>& batch) {
      if (Kind::name == kind) found = &batch.order;
    });
    return *found;
  }

 private:
  void fill_state(const SimulationInput& input) {
    const auto count = static_cast<std::size_t>(input.positions.rows());
    state_.vertex_count = static_cast<int>(count);
    state_.origin = input.origin;
    state_.mass.resize(count);
    state_.position.resize(count + dummy_points);
    state_.velocity.resize(count + dummy_points);
    for (std::size_t v = 0; v < count; ++v) {
      const auto row = static_cast<Eigen::Index>(v);
      const std::size_t at = place_of(v);
      state_.mass[at] = input.mass[v];
      state_.position[at].set((input.positions.row(row).transpose() - input.origin).template cast<Real>());
      const bool free = !input.is_pinned[v] && input.mass[v] > 0;
      state_.position[at].w = free ? static_cast<Real>(1 / input.mass[v]) : Real(0);
      if (free && input.velocities.rows() > 0)
        state_.velocity[at].set(input.velocities.row(row).transpose().template cast<Real>());
    }
    state_.previous = state_.position;
  }

  std::size_t place_of(std::size_t vertex) const {
    return place_.empty() ? vertex : static_cast<std::size_t>(place_[vertex]);
  }

  // A batch of a list's constraints, of vertices where they stand, ordered by `colour`; and one thread's way
  // through it. Several threads go colour by colour.
  template <class List, class Colour, class Make>
  auto batch_of(const List& list, Colour colour, Make make, std::vector<RunRange>& tiles) const {
    const auto ordered = [&](const auto& corners) {
      BatchOrder order = colour(corners, state_.vertex_count);
      if (settings_.threads == 1) tiles = tiled(order, corners, state_.vertex_count, tile_vertices<Real>);
      return order;
    };
    const bool in_list_order = settings_.order == ConstraintOrder::mesh;
    if (place_.empty())
      return make(list, in_list_order ? list_order(list.size()) : ordered(list.vertices),
                  state_.vertex_count);
    const Placed placed(list.vertices, place_);
    List in_place = list;
    for (std::size_t c = 0; c < list.size(); ++c)
      in_place.vertices[static_cast<std::size_t>(placed.original[c])] = placed.vertices[c];
    return make(
        in_place,
        in_list_order ? list_order(list.size()) : placed.in_terms_of_the_list(ordered(placed.vertices)),
        state_.vertex_count);
  }

  void fill_constraints(const SimulationInput& input) {
    const int projections = settings_.projections_per_substep();
    StrainBatch<Real>& strain = constraints_.strain;
    strain = batch_of(input.strain, colour_order<3>, make_strain_batch<Real>, strain_tiles_);
    const StrainStiffness& s = input.strain_stiffness;
    const auto fraction = [&](double k) {
      return static_cast<Real>(k_of_projection(s.kind, k, projections));
    };
    strain.form = s.form, strain.kind = s.kind, strain.compliance = static_cast<Real>(s.compliance);
    strain.warp = fraction(s.warp), strain.weft = fraction(s.weft), strain.shear = fraction(s.shear);
    strain.area = fraction(s.area);
    if (s.kind == StiffnessKind::compliance) strain.multiplier.assign(4 * strain.a.size(), 0);

    DistanceBatch<Real>& distance = constraints_.distance;
    distance = batch_of(input.distance, star_order, make_distance_batch<Real>, distance_tiles_);
    const BendingStiffness& d = input.bending_stiffness;
    distance.kind = d.kind, distance.compliance = static_cast<Real>(d.compliance);
    distance.k = static_cast<Real>(k_of_projection(d.kind, d.k, projections));
    if (d.kind == StiffnessKind::compliance) distance.multiplier.assign(distance.b.size(), 0);

    for_each_kind(input.elements, [&]<class Kind>(const ElementList<Kind>& list) {
      auto& batch = std::get<ElementBatch<Real, Kind>>(constraints_.elements);
      batch = batch_of(list, colour_order<Kind::arity>, make_element_batch<Real, Kind>,
                       element_tiles_[kind_index<Kind>]);
      batch.kind = d.kind, batch.compliance = static_cast<Real>(d.compliance);
      batch.k = static_cast<Real>(k_of_projection(d.kind, d.k, projections));
      if (d.kind == StiffnessKind::compliance)
        batch.multiplier.assign(batch.order.constraint_of_lane.size(), 0);
    });
  }

  std::size_t constraint_count() const {
    std::size_t count = 0;
    constraints_.for_each([&](const auto& batch) { count += batch.count; });
    return count;
  }

  void compile_plan(std::vector<Pass<Real>> effect_passes) {
    const auto add_effects = [&](std::vector<PlannedPass<Real>>& passes, Stage stage) {
      for (Pass<Real>& pass : effect_passes)
        if (pass.stage == stage) passes.push_back({std::move(pass.run), add_statistics(pass.name)});
    };
    add_effects(before_, Stage::force);
    add_effects(before_, Stage::damp);
    before_.push_back({[this](PassContext<Real>& c) { predict(c.substep); }, add_statistics("predict")});
    const bool strain_first = settings_.first == FirstConstraint::strain;
    if (strain_first) add_projection(constraints_.strain, strain_tiles_, "strain");
    add_projection(constraints_.distance, distance_tiles_, "bending");
    for_each_kind(constraints_.elements, [&]<class Kind>(ElementBatch<Real, Kind>& batch) {
      add_projection(batch, element_tiles_[kind_index<Kind>], "bending");
    });
    if (!strain_first) add_projection(constraints_.strain, strain_tiles_, "strain");
    std::reverse(backward_.begin(), backward_.end());
    add_effects(forward_, Stage::project);
    for (std::size_t p = backward_.size(); p < forward_.size(); ++p) backward_.push_back(forward_[p]);
    after_.push_back({[this](PassContext<Real>& c) { update(c.substep); }, add_statistics("update")});
    add_effects(after_, Stage::velocity);
  }

  std::size_t add_statistics(const std::string& name) {
    statistics_.push_back({name});
    return statistics_.size() - 1;
  }

  // A kind of constraint that the scene has none of gets no pass.
  template <class Batch>
  void add_projection(Batch& batch, const std::vector<RunRange>& tiles, const char* name) {
    if (batch.count == 0) return;
    const std::size_t row = add_statistics(name);
    forward_.push_back(
        {[this, &batch, &tiles](PassContext<Real>& c) { sweep(batch, tiles, c.substep, false); }, row});
    backward_.push_back(
        {[this, &batch, &tiles](PassContext<Real>& c) { sweep(batch, tiles, c.substep, true); }, row});
  }

  void run(const std::vector<PlannedPass<Real>>& passes, PassContext<Real>& context) {
    for (const PlannedPass<Real>& pass : passes) {
      const auto start = std::chrono::steady_clock::now();
      pass.run(context);
      PassStatistics& statistics = statistics_[pass.statistics];
      statistics.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      ++statistics.calls;
    }
  }

  void predict(Real h) {
    constraints_.for_each(
        [](auto& batch) { std::fill(batch.multiplier.begin(), batch.multiplier.end(), Real(0)); });
    for_vertices([&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        Point<Real>& p = state_.position[v];
        const Point<Real>& velocity = state_.velocity[v];
        state_.previous[v] = p;
        p.x += h * velocity.x, p.y += h * velocity.y, p.z += h * velocity.z;
      }
    });
  }

  template <class Batch>
  void sweep(Batch& batch, const std::vector<RunRange>& tiles, Real h, bool backwards) {
    Point<Real>* const points = state_.position.data();
    if (!batch.order.conflict_free) {
      project_reference(points, batch, h, backwards);
      return;
    }
    for (std::size_t step = 0; step < tiles.size(); ++step) {
      const RunRange& range = tiles[backwards ? tiles.size() - 1 - step : step];
      project(points, batch, range.first, range.last, h, backwards);
    }
    if (!tiles.empty()) return;
    const std::vector<std::size_t>&colours = batch.order.colours, &runs = batch.order.runs;
    for (std::size_t step = 0; step + 1 < colours.size(); ++step) {
      const std::size_t colour = backwards ? colours.size() - 2 - step : step;
      const std::size_t first = colours[colour], last = colours[colour + 1];
      workers_.for_range(
          first, last, runs[last] - runs[first] >= worthwhile_lanes,
          [&](std::size_t from, std::size_t to) { project(points, batch, from, to, h, backwards); });
    }
  }

  void update(Real h) {
    for_vertices([&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        const Point<Real>&p = state_.position[v], &previous = state_.previous[v];
        state_.velocity[v] = {(p.x - previous.x) / h, (p.y - previous.y) / h, (p.z - previous.z) / h, 0};
      }
    });
    find_divergence();
  }

  // One finiteness check per substep: NaN fails every comparison.
  void find_divergence() {
    if (divergence_.vertex >= 0) return;
    bool inside = true;
    for (int v = 0; v < state_.vertex_count; ++v)
      inside &= within_bound(state_.position[static_cast<std::size_t>(v)]);
    if (inside) return;
    std::size_t vertex = 0;
    while (within_bound(state_.position[place_of(vertex)])) ++vertex;
    divergence_.vertex = static_cast<int>(vertex);
    divergence_.position = state_.position[place_of(vertex)].vector().template cast<double>() + state_.origin;
  }

  bool within_bound(const Point<Real>& p) const {
    return (std::abs(p.x) < bound_) & (std::abs(p.y) < bound_) & (std::abs(p.z) < bound_);
  }

  template <class Task>
  void for_vertices(const Task& task) {
    const auto count = static_cast<std::size_t>(state_.vertex_count);
    workers_.for_range(0, count, count >= worthwhile_vertices, task);
  }

  Positions to_rows(const Points<Real>& points, const Vector3& origin) const {
    Positions rows(state_.vertex_count, 3);
    for (int v = 0; v < state_.vertex_count; ++v)
      rows.row(v) = (points[place_of(static_cast<std::size_t>(v))].vector().template cast<double>() + origin)
                        .transpose();
    return rows;
  }

  SolverSettings settings_;
  std::vector<int> place_;  // of each vertex; empty: its own
  Real bound_;
  Workers workers_;
  State<Real> state_;
  Constraints<Real> constraints_;
  std::vector<RunRange> strain_tiles_, distance_tiles_;
  std::array<std::vector<RunRange>, std::tuple_size_v<ElementKinds>> element_tiles_;
  std::vector<PlannedPass<Real>> before_, forward_, backward_, after_;
  std::vector<PassStatistics> statistics_;
  std::uint64_t substeps_done_ = 0;
  Divergence divergence_{.time = 0, .vertex = -1, .position = Vector3::Zero()};
};

}  // namespace

template <class Real>
std::unique_ptr<Simulation> make_simulation(const SimulationInput& input,
                                            std::vector<Pass<Real>> effect_passes) {
  return std::make_unique<SimulationOf<Real>>(input, std::move(effect_passes));
}

template std::unique_ptr<Simulation> make_simulation(const SimulationInput&, std::vector<Pass<float>>);
template std::unique_ptr<Simulation> make_simulation(const SimulationInput&, std::vector<Pass<double>>);

}  // namespace bendlab
