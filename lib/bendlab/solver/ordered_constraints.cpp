#include "bendlab/solver/ordered_constraints.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>

#include "bendlab/solver/colouring.hpp"

namespace bendlab {
namespace {

// The points of a tile (tiling.hpp) take a quarter of a second-level cache of 1 MB.
template <class Real>
constexpr int tile_vertices = 262144 / sizeof(Point<Real>);

// The index of a point in the solver's arrays; directors are not permuted.
int permuted(int point, const std::vector<int>& permutation) {
  const auto p = static_cast<std::size_t>(point);
  return p < permutation.size() ? permutation[p] : point;
}

// The list with vertex permutation[v] in place of v.
template <class List>
List renumbered(List list, const std::vector<int>& permutation) {
  for (auto& corners : list.vertices)
    for (int& v : corners) v = permuted(v, permutation);
  return list;
}
DistanceConstraints renumbered(const DistanceConstraints& list, const std::vector<int>& permutation) {
  return list.renumbered(permutation);
}

// Constraints sorted by the lowest of their vertices, and the index of each constraint in the list.
template <class Vertices>
struct SortedByLowest {
  Vertices vertices;
  std::vector<int> original;

  explicit SortedByLowest(const Vertices& list) : original(list.size()) {
    std::vector<int> lowest;
    lowest.reserve(list.size());
    for (const auto& corners : list) lowest.push_back(*std::min_element(corners.begin(), corners.end()));
    std::iota(original.begin(), original.end(), 0);
    std::stable_sort(original.begin(), original.end(), [&](int l, int r) {
      return lowest[static_cast<std::size_t>(l)] < lowest[static_cast<std::size_t>(r)];
    });
    vertices.reserve(list.size());
    for (const int c : original) vertices.push_back(list[static_cast<std::size_t>(c)]);
  }

  BatchOrder in_terms_of_the_list(BatchOrder order) const {
    if (order.at_place.empty()) {
      order.at_place = original;
    } else {
      for (int& constraint : order.at_place) constraint = original[static_cast<std::size_t>(constraint)];
    }
    return order;
  }
};

// The batch of a list's constraints, with permuted vertices, in the order that `colour` gives. If there is
// one thread, also fills `tiles`; several threads work colour by colour.
template <class Real, class List, class Colour, class Make>
auto batch_of(const SimulationInput& input, ConstraintOrder in, const List& list, Colour colour, Make make,
              std::vector<StackRange>* tiles) {
  const auto vertex_count = static_cast<int>(input.point_count());
  const auto ordered = [&](const auto& corners) {
    BatchOrder order = colour(corners, vertex_count);
    if (tiles && input.settings.threads == 1)
      *tiles = tiled(order, corners, vertex_count, tile_vertices<Real>);
    return order;
  };
  const bool in_list_order = in != ConstraintOrder::colour;
  if (input.permutation.empty())
    return make(list, in_list_order ? list_order(list.size()) : ordered(list.vertices), vertex_count);
  const List permuted_list = renumbered(list, input.permutation);
  const SortedByLowest sorted(permuted_list.vertices);
  return make(permuted_list,
              in_list_order ? list_order(list.size()) : sorted.in_terms_of_the_list(ordered(sorted.vertices)),
              vertex_count);
}

// The range of compliances α for which α, α/h² and a force C/α are within the range of Real, with a margin
// for other factors. A softer constraint does nothing in a substep, and a stiffer constraint is rigid.
template <class Real>
class ComplianceRange {
 public:
  explicit ComplianceRange(double substep) : most_(largest / spare * std::min(1.0, substep * substep)) {}

  Real clamped(double compliance) const {
    return static_cast<Real>(compliance > 0 ? std::clamp(compliance, least, most_) : compliance);
  }

  // Changes softness so that softness · compliance is in the range. The compliance is already clamped.
  void clamp(LargeArray<Real>& softness, Real clamped_compliance) const {
    const auto compliance = static_cast<double>(clamped_compliance);
    if (!(compliance > 0)) return;
    for (Real& factor : softness) {
      const double alpha = static_cast<double>(factor) * compliance;
      if (alpha > 0 && !(alpha >= least && alpha <= most_))
        factor = static_cast<Real>(std::min(std::clamp(alpha, least, most_) / compliance, largest));
    }
  }

 private:
  static constexpr double spare = 0x1p24, largest{std::numeric_limits<Real>::max()},
                          least = double{std::numeric_limits<Real>::min()} * spare;
  double most_;
};

template <class Real>
OwnBatch<Real> own_batch(const SimulationInput& input, ConstraintOrder in, int projections) {
  OwnElements list = input.own;
  if (!input.permutation.empty())
    for (int& v : list.vertices) v = permuted(v, input.permutation);
  const std::size_t arity = list.arity;
  std::vector<int> sorted(list.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  if (!input.permutation.empty())
    std::ranges::stable_sort(
        sorted, {}, [&](int c) { return std::ranges::min(list.corners(static_cast<std::size_t>(c))); });
  std::vector<int> vertices;
  vertices.reserve(list.vertices.size());
  for (const int c : sorted)
    std::ranges::copy(list.corners(static_cast<std::size_t>(c)), std::back_inserter(vertices));
  BatchOrder order = in == ConstraintOrder::colour
                         ? colour_order(vertices, arity, static_cast<int>(input.point_count()))
                         : list_order(list.size());
  if (in == ConstraintOrder::colour) order.at_place = std::move(sorted);
  OwnBatch<Real> batch = make_own_batch<Real>(std::move(list), std::move(order));
  const BendingStiffness& stiffness = input.bending_stiffness;
  batch.kind = stiffness.kind, batch.compliance = stiffness.compliance;
  batch.k = k_of_projection(stiffness.kind, stiffness.k, projections);
  if (stiffness.kind == StiffnessKind::compliance) batch.multiplier.assign(batch.count, 0);
  return batch;
}

}  // namespace

template <class Real>
Constraints<Real> ordered_constraints(const SimulationInput& input, const Point<Real>* rest_points,
                                      const Ordering& ordering) {
  Constraints<Real> constraints;
  const int projections = ordering.projections;
  ConstraintTiles* const tiles = ordering.tiles;
  const ComplianceRange<Real> range(input.settings.dt / input.settings.substeps);
  StrainBatch<Real>& strain = constraints.strain;
  strain = batch_of<Real>(input, ordering.order, input.strain, colour_order<3>, make_strain_batch<Real>,
                          tiles ? &tiles->strain : nullptr);
  const StrainStiffness& s = input.strain_stiffness;
  const auto fraction = [&](double k) { return static_cast<Real>(k_of_projection(s.kind, k, projections)); };
  strain.form = s.form, strain.kind = s.kind, strain.compliance = range.clamped(s.compliance);
  strain.warp = fraction(s.warp), strain.weft = fraction(s.weft), strain.shear = fraction(s.shear);
  strain.area = fraction(s.area);
  for (std::size_t i = 0; i < 3; ++i) strain.term_softness[i] = static_cast<Real>(s.softness[i]);
  if (s.kind == StiffnessKind::compliance) strain.multiplier.assign(4 * strain.a.size(), 0);

  DistanceBatch<Real>& distance = constraints.distance;
  distance = batch_of<Real>(input, ordering.order, input.distance, star_order, make_distance_batch<Real>,
                            tiles ? &tiles->distance : nullptr);
  const BendingStiffness& d = input.bending_stiffness;
  strain.rest_points = distance.rest_points = rest_points;
  distance.kind = d.kind, distance.compliance = range.clamped(d.compliance);
  range.clamp(distance.softness, distance.compliance);
  distance.k = static_cast<Real>(k_of_projection(d.kind, d.k, projections));
  if (d.kind == StiffnessKind::compliance) distance.multiplier.assign(distance.b.size(), 0);

  for_each_kind(input.elements, [&]<class Kind>(const ElementList<Kind>& list) {
    auto& batch = std::get<ElementBatch<Real, Kind>>(constraints.elements);
    batch =
        batch_of<Real>(input, ordering.order, list, colour_order<Kind::arity>, make_element_batch<Real, Kind>,
                       tiles ? &tiles->elements[kind_index<Kind>] : nullptr);
    batch.kind = d.kind, batch.compliance = range.clamped(d.compliance);
    range.clamp(batch.softness, batch.compliance);
    batch.rest_points = rest_points;
    batch.k = static_cast<Real>(k_of_projection(d.kind, d.k, projections));
    if (d.kind == StiffnessKind::compliance) batch.multiplier.assign(batch.order.lane_count(), 0);
  });
  if (input.own.size() > 0) constraints.own = own_batch<Real>(input, ordering.order, projections);
  return constraints;
}

template <class Real>
const BatchOrder& element_order_of(const Constraints<Real>& constraints, std::string_view kind) {
  std::array<const BatchOrder*, std::tuple_size_v<ElementKinds>> orders{};
  for_each_kind(constraints.elements, [&]<class Kind>(const ElementBatch<Real, Kind>& batch) {
    orders[kind_index<Kind>] = &batch.order;
  });
  return *orders[index_of_kind(kind)];
}

template Constraints<float> ordered_constraints(const SimulationInput&, const Point<float>*, const Ordering&);
template Constraints<double> ordered_constraints(const SimulationInput&, const Point<double>*,
                                                 const Ordering&);
template const BatchOrder& element_order_of(const Constraints<float>&, std::string_view);
template const BatchOrder& element_order_of(const Constraints<double>&, std::string_view);

}  // namespace bendlab
