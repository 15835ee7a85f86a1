#include "experiments/run/run_size.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bendlab/scene/built_scene.hpp"

namespace bendlab {
namespace {

constexpr int counted_whole = 2000;    // vertices; on a larger mesh the constraints are sampled
constexpr double large_patch = 10000;  // vertices

// A patch of the mesh with half as many edges along its sides, and the same edge length. Nothing if the patch
// would have too few edges.
std::optional<Mesh> half(Mesh mesh) {
  constexpr int fewest_cells = 16;
  const double scale = mesh.scale;
  if (mesh.refine.value_or(0) > 0) {
    --*mesh.refine;
    mesh.scale = scale / 2;
  } else {
    if (mesh.file || mesh.given || mesh.cells <= fewest_cells) return std::nullopt;
    const int cells = (mesh.cells + 1) / 2;
    mesh.scale = scale * cells / mesh.cells;
    mesh.cells = cells;
  }
  return mesh;
}

Pins pins_of(const Pinning& pinning, const RestMesh& rest) {
  std::vector<int> seeds;
  for (const Place place : pinning.vertices)
    for (const int vertex : select_vertices(rest, place)) seeds.push_back(vertex);
  for (const int vertex : pinning.indices)
    if (vertex < rest.vertex_count()) seeds.push_back(vertex);
  return make_pins(rest, std::move(seeds), pinning.ring, pinning.distance);
}

// How many points a constraint joins. Constraints of laplacian repeat a vertex, so that all have the same
// length.
double distinct(std::span<const int> vertices) {
  return static_cast<double>(std::set<int>(vertices.begin(), vertices.end()).size());
}

// The size of the whole mesh if the whole mesh were like the patch. `whole`: length of the mesh divided by
// length of the patch.
RunSize size_by(const Scene& scene, const Mesh& patch, double whole) {
  AcceptedMesh accepted = rest_mesh_of(patch, scene.folder);
  const RestMesh rest(std::move(accepted.mesh), std::move(accepted.named));
  // A prime number, because few grids have a row length that is a multiple of 17.
  const int stride = rest.vertex_count() > counted_whole ? 17 : 1;
  const BendingConstraints built =
      constraints_of(scene.bending.model, {rest, pins_of(scene.pins, rest), whole * rest.size(), stride});
  RunSize size{.vertices = whole * whole * rest.vertex_count(),
               .triangles = whole * whole * rest.triangle_count(),
               .size = whole * rest.size(),
               .mean_edge = rest.mean_edge_length()};
  // Spring models build only the springs of every stride-th vertex; other models build all constraints.
  bool is_sample = true;
  const auto look_at = [&](const auto& list) {
    for (const auto& vertices : list) is_sample = is_sample && vertices.front() % stride == 0;
  };
  look_at(built.distance.vertices);
  for_each_kind(built.elements, [&](const auto& list) { look_at(list.vertices); });
  is_sample = is_sample && built.own.size() == 0;
  const double weight = whole * whole * (is_sample ? stride : 1);
  const auto add = [&](std::span<const int> vertices, std::size_t bytes, std::size_t numbers) {
    size.constraints += weight;
    size.corners += weight * distinct(vertices);
    size.list_bytes += weight * static_cast<double>(bytes);
    size.numbers += weight * static_cast<double>(numbers);
    if (vertices.size() != 2) return;
    size.pairs += weight;
    size.reach += weight * (rest.position(vertices[0]) - rest.position(vertices[1])).norm() / size.mean_edge;
  };
  for (const auto& pair : built.distance.vertices) add(pair, sizeof(int), 2);  // the first vertex is shared
  for_each_kind(built.elements, [&]<class Kind>(const ElementList<Kind>& list) {
    for (const auto& vertices : list.vertices)
      add(vertices, sizeof(vertices) + sizeof(list.rest[0]) + sizeof(double),
          Kind::arity + Kind::rest_values + 2);  // softness, multiplier
  });
  size.directors =
      whole * whole * static_cast<double>(built.directors.vertices.size()) * built.directors.coordinates;
  size.own = whole * whole * static_cast<double>(built.own.size() * built.own.arity);
  const std::size_t vertices_of_own = built.own.arity - built.own.directors;  // the normals are theirs
  for (std::size_t c = 0; c < built.own.size(); ++c)
    add(built.own.corners(c).first(vertices_of_own), built.own.arity * sizeof(int) + sizeof(double),
        built.own.arity + 2);
  if (size.pairs > 0) size.reach /= size.pairs;
  if (size.constraints > 0) size.corners /= size.constraints;
  return size;
}

RunSize size_of(const Scene& scene, Mesh mesh) {
  mesh.seed = 1, mesh.shuffle.reset(), mesh.offset.setZero();
  std::vector<Mesh> patches{mesh};
  while (const std::optional<Mesh> next = half(patches.back())) patches.push_back(*next);
  std::optional<RunSize> smaller, size;
  double share = 0;  // length of the patch over length of the mesh
  while (!patches.empty() && !(size && share * share * size->vertices > large_patch)) {
    share = patches.back().scale / mesh.scale;
    smaller = size, size = size_by(scene, patches.back(), 1 / share);
    patches.pop_back();
  }
  // Extrapolates the effect of the border: in a patch of half the length, the border has twice the share of
  // all counts. In the whole mesh, the border has a smaller share than in the patch.
  if (smaller)
    for (double RunSize::*amount :
         {&RunSize::vertices, &RunSize::triangles, &RunSize::constraints, &RunSize::pairs,
          &RunSize::list_bytes, &RunSize::own, &RunSize::directors, &RunSize::numbers})
      *size.*amount += (1 - share) * (*size.*amount - *smaller.*amount);
  return *size;
}

}  // namespace

std::optional<RunSize> size_of(const RunConfig& config) {
  static std::mutex mutex;
  static std::map<std::string, std::optional<RunSize>> known;  // key: the settings that decide the size
  const Json& settings = config.resolved();
  const std::string model = settings.at("bending").at("model");
  Json deciding = {settings.at("mesh"), settings.at("pins"), model,
                   settings.at("bending").value(model, Json())};
  deciding[0].erase("seed");
  const std::string key = config.folder().string() + deciding.dump();
  const std::lock_guard lock(mutex);
  const auto [entry, is_new] = known.try_emplace(key);
  if (is_new) try {
      entry->second = size_of(config.scene(), config.scene().mesh);
    } catch (const std::exception&) {
    }
  return entry->second;
}

}  // namespace bendlab
