#include "experiments/run/run_header.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <array>
#include <cmath>
#include <memory>
#include <tuple>

#include "bendlab/constraints/pack.hpp"
#include "bendlab/mesh/single_precision.hpp"
#include "bendlab/settings/input_file.hpp"
#include "bendlab/settings/names.hpp"
#include "bendlab/solver/colouring.hpp"
#include "experiments/config/config_tables.hpp"
#include "experiments/config/schema.hpp"
#include "experiments/config/settings_by_pointer.hpp"
#include "experiments/measures/measure.hpp"
#include "experiments/run/machine.hpp"
#include "experiments/run/run_id.hpp"
#include "experiments/run/version.hpp"

namespace bendlab {
namespace {

// The constraint's own softness; null if the list has no softness for single constraints.
template <class List>
const double* softness_of(const List& list, std::size_t constraint) {
  if constexpr (requires { list.softness; })
    return list.softness.empty() ? nullptr : &list.softness[constraint];
  else
    return nullptr;
}

// Records the vertices, rest values and softness (if the list has it) of every constraint, in the order in
// which the solver projects them, without padding. `rest_of` and `hashed_of` give a constraint's rest values
// as an array: the values to record, and the values to hash. Constraints are hashed one by one, because a
// copy of millions of springs would be the largest object in memory.
template <class List, class RestOf, class HashedOf>
ConstraintRecord record_of(const std::string& kind, const List& list, const BatchOrder& order, bool in_full,
                           RestOf rest_of, HashedOf hashed_of) {
  ConstraintRecord record{.kind = kind, .count = list.size()};
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash(XXH3_createState(), &XXH3_freeState);
  XXH3_64bits_reset(hash.get());
  for_each_lane(order, [&](std::size_t, int constraint) {
    if (constraint < 0) return;
    const auto& vertices = list.vertices[static_cast<std::size_t>(constraint)];
    const auto hashed = hashed_of(static_cast<std::size_t>(constraint));
    const double* const softness = softness_of(list, static_cast<std::size_t>(constraint));
    XXH3_64bits_update(hash.get(), vertices.data(), sizeof(vertices));
    XXH3_64bits_update(hash.get(), hashed.data(), sizeof(hashed));
    if (softness) XXH3_64bits_update(hash.get(), softness, sizeof(*softness));
    record.vertices_per_constraint = static_cast<int>(vertices.size());
    record.rest_per_constraint = static_cast<int>(std::tuple_size_v<decltype(rest_of(0))>);
    if (!in_full) return;
    const auto rest = rest_of(static_cast<std::size_t>(constraint));
    record.vertices.insert(record.vertices.end(), vertices.begin(), vertices.end());
    record.rest.insert(record.rest.end(), rest.begin(), rest.end());
    if (softness) record.softness.push_back(*softness);
  });
  record.hash = fmt::format("{:016x}", XXH3_64bits_digest(hash.get()));
  return record;
}

template <class List, class RestOf>
ConstraintRecord record_of(const std::string& kind, const List& list, const BatchOrder& order, bool in_full,
                           RestOf rest_of) {
  return record_of(kind, list, order, in_full, rest_of, rest_of);
}

// Records elements in the order of the list, without rest values, because only their function knows these.
ConstraintRecord record_of(const OwnElements& own, bool in_full) {
  const std::string_view vertices(reinterpret_cast<const char*>(own.vertices.data()),
                                  own.vertices.size() * sizeof(int));
  ConstraintRecord record{.kind = std::string(own.function->name()), .count = own.size()};
  record.vertices_per_constraint = static_cast<int>(own.arity);
  record.hash = fmt::format(
      "{:016x}",
      XXH3_64bits_withSeed(vertices.data(), vertices.size(),
                           XXH3_64bits(own.softness.data(), own.softness.size() * sizeof(double))));
  if (in_full) record.vertices = own.vertices, record.softness = own.softness;
  return record;
}

std::vector<ObstacleRecord> obstacles_of(const BuiltScene& scene) {
  const Vector3 low = scene.rest.positions().colwise().minCoeff(),
                high = scene.rest.positions().colwise().maxCoeff();
  std::vector<ObstacleRecord> records;
  for (std::size_t index = 0; index < scene.effects.size(); ++index) {
    const Effect& effect = scene.effects[index];
    if (effect.kind().surface == nullptr) continue;
    const Vector3 velocity = effect.kind().motion(effect.settings()).velocity;
    const TriangleMesh mesh = effect.kind().surface(
        effect.settings(), {.folder = scene.folder, .centre = (low + high) / 2, .size = (high - low).norm()});
    records.push_back({.effect = index,
                       .positions = {mesh.positions.data(), mesh.positions.data() + mesh.positions.size()},
                       .triangles = {mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size()},
                       .velocity = {velocity.x(), velocity.y(), velocity.z()}});
  }
  return records;
}

// Units and meanings of the metrics that the run's summary may have, and of the run's settings.
Json about(const RunConfig& config, const BuiltScene& scene) {
  Json summary = Json::object(), settings = Json::object();
  const auto add = [&](const Column& metric) { summary[metric.name] = {metric.unit, metric.meaning}; };
  std::ranges::for_each(numbers_of_scene(), add);
  for (const Measure* measure : measures())
    if (applies(*measure, config, scene)) std::ranges::for_each(measure->gives(), add);
  for (const BendingFact& fact : scene.bending_facts) add({"model_" + fact.name, fact.unit, fact.meaning});
  const Json resolved = config.resolved();
  for (const auto& [pointer, value] : flattened(resolved))
    if (const Field* field = find_setting(resolved, pointer); field != nullptr && !field->unit.empty())
      settings[pointer] = {field->unit, field->meaning};
  for (std::size_t i = 0; i < scene.effects.size(); ++i)
    for (const Field& field : scene.effects[i].kind().settings.fields)
      if (!field.unit.empty())
        settings[fmt::format("/effects/{}/{}", i, field.name)] = {field.unit, field.meaning};
  return {{"summary", std::move(summary)}, {"settings", std::move(settings)}};
}

}  // namespace

RunHeader header_of(const Experiment& experiment, const RunConfig& config, const std::string& id,
                    const BuiltScene& scene, const Simulation& simulation, const Recorder& recorder) {
  const BuildInfo& build = build_info();
  const RestMesh& rest = scene.rest;
  const bool in_full = config.settings().output.constraints;
  RunHeader header;
  header.id = id;
  header.name = experiment.name;
  header.rest_positions.assign(rest.positions().data(), rest.positions().data() + rest.positions().size());
  header.triangles.assign(rest.triangles().data(), rest.triangles().data() + rest.triangles().size());
  header.pinned.assign(scene.pins.is_pinned.begin(), scene.pins.is_pinned.end());
  header.pin_seeds = scene.pins.seeds;
  header.metrics = recorder.metrics();
  header.cell_fields = recorder.cell_fields();
  header.constraints = {record_of(
                            "strain", scene.input.strain, simulation.strain_order(), in_full,
                            [&](std::size_t c) {  // rest area: 1 / (2 |det Q⁻¹|)
                              const InverseRest& q = scene.input.strain.inverse_rest[c];
                              return std::array{0.5 / std::abs(q[0] * q[3] - q[1] * q[2])};
                            },
                            [&](std::size_t c) { return scene.input.strain.inverse_rest[c]; }),
                        record_of("distance", scene.input.distance, simulation.distance_order(), in_full,
                                  [&](std::size_t c) { return std::array{scene.input.distance.rest(c)}; })};
  if (const DistanceConstraints& edges = scene.input.edges; edges.size() > 0)
    header.constraints.push_back(record_of("edge", edges, list_order(edges.size()), in_full,
                                           [&](std::size_t c) { return std::array{edges.rest(c)}; }));
  for_each_kind(scene.input.elements, [&]<class Kind>(const ElementList<Kind>& list) {
    if (list.size() > 0)
      header.constraints.push_back(record_of(std::string(Kind::name), list,
                                             simulation.element_order(Kind::name), in_full,
                                             [&](std::size_t c) { return list.rest[c]; }));
  });
  if (const OwnElements& own = scene.input.own; own.size() > 0)
    header.constraints.push_back(record_of(own, in_full));
  header.obstacles = obstacles_of(scene);
  std::string ordering_hash;
  for (const ConstraintRecord& record : header.constraints) ordering_hash += record.hash;
  header.provenance = {{"version", std::string(build.version)},
                       {"git_commit", std::string(build.git_commit)},
                       {"git_dirty", build.git_dirty ? "yes" : "no"},
                       {"source_hash", std::string(build.source_hash)},
                       {"compiler", std::string(build.compiler)},
                       {"compiler_flags", std::string(build.flags)},
                       {"build_type", std::string(build.build_type)},
                       {"vector_bits", std::to_string(8 * pack_bytes)},
                       {"processor", processor_name()},
                       {"host", host_name()},
                       {"libraries", library_versions()},
                       {"blas_kernels", blas_kernels()},
                       {"threads", std::to_string(scene.input.settings.threads)},
                       {"precision", std::string(name_in(precision_names, scene.precision))},
                       {"ordering_hash", ordering_hash},
                       {"point", point_json(config).dump()},
                       {"models", model_traits_json().dump()},
                       {"methods", method_traits_json().dump()},
                       {"started", utc_now()}};
  if (!scene.mesh_notes.empty())
    header.provenance["mesh_notes"] = fmt::format("{}", fmt::join(scene.mesh_notes, "; "));
  if (!build.changes_id.empty()) header.provenance["git_changes"] = changes_file_name();
  if (const std::string own = own_code_hash(config); !own.empty()) header.provenance["own_code"] = own;
  header.config = config.resolved().dump(2);
  header.about = about(config, scene).dump();
  for (const NamedFile& file : input_files(config))
    header.inputs.push_back({file.pointer, file.name, read_input_file(file.path)});
  header.double_positions =
      scene.precision == Precision::double_precision || needs_double(rest.positions(), rest.triangles());
  return header;
}

}  // namespace bendlab
