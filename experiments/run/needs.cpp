#include "experiments/run/needs.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <mutex>

#include "bendlab/bending/model.hpp"
#include "bendlab/io/run_file.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/scene/rules.hpp"
#include "bendlab/scene/start_after.hpp"
#include "bendlab/solver/method.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

// Bytes, from the largest resident sets of processes that compute one run on 64² to 256² cells.
constexpr double of_program = 30e6;
constexpr double per_vertex = 1100;  // mesh, membrane, hinges, frames that wait to be written
constexpr double per_spring = 15;
// While a stiffness is fitted to a stated rigidity: per vertex, of a model with directors, and per spring.
constexpr double fitted_vertex = 3000, fitted_director = 11e3, fitted_spring = 190;

struct MeshSize {
  double vertices = 0, triangles = 0;
  double size = 0, mean_edge = 0;  // m
};

// The size of a mesh with more than `most_cells` follows from the same mesh with fewer cells.
MeshSize size_of(Mesh mesh, const fs::path& folder) {
  constexpr int most_cells = 128;
  mesh.seed = 1, mesh.shuffle.reset(), mesh.offset.setZero(), mesh.jitter.reset();
  const double refined = std::pow(2, mesh.refine.value_or(0));
  mesh.refine.reset();
  const int cells = mesh.cells;
  if (!mesh.file && !mesh.given) mesh.cells = std::min(cells, most_cells);
  const double finer = refined * cells / mesh.cells;
  const RestMesh rest(rest_mesh_of(mesh, folder).mesh);
  return {.vertices = finer * finer * rest.vertex_count(),
          .triangles = finer * finer * rest.triangle_count(),
          .size = rest.size(),
          .mean_edge = rest.mean_edge_length() / finer};
}

// Many runs of a sweep have the same mesh. Nothing if the mesh cannot be made; the run then says why.
std::optional<MeshSize> known_size_of(const RunConfig& config) {
  static std::mutex mutex;
  static std::map<std::string, std::optional<MeshSize>> known;  // by /mesh
  Json settings = config.resolved().at("mesh");
  settings.erase("seed");
  const std::lock_guard lock(mutex);
  const auto [entry, is_new] = known.try_emplace(config.folder().string() + settings.dump());
  if (is_new) try {
      entry->second = size_of(config.scene().mesh, config.folder());
    } catch (const std::exception&) {
    }
  return entry->second;
}

double springs_per_vertex(const BendingModel& model, const MeshSize& mesh) {
  const auto springs = model.kind().springs_per_vertex;
  return springs == nullptr ? 0 : springs(model.settings(), mesh.size, mesh.mean_edge);
}

double memory_of(const Scene& scene, const MeshSize& mesh, double springs) {
  const BendingKind& model = scene.bending.model.kind();
  const double built =
      model.points_per_vertex * scene.solver.method.kind().bytes_per_vertex + springs * per_spring;
  const bool fitted = scene.bending.stiffness == Stiffness::physical && model.bends;
  const double fit =
      std::max(model.points_per_vertex > 1 ? fitted_director : fitted_vertex, springs * fitted_spring);
  return of_program + mesh.vertices * (per_vertex + std::max(built, fitted ? fit : 0));
}

// The layout of a run file: each frame has the positions, and a number of 8 bytes per triangle.
double file_bytes(const RunConfig& config, const MeshSize& mesh) {
  constexpr double head = 36e3, rest_of_vertex = 39, head_of_frame = 560, of_triangle = 8;
  const Scene& scene = config.scene();
  const bool in_double = scene.solver.method.kind().make_float == nullptr ||
                         scene.solver.precision == ChosenPrecision::double_precision;
  const double position = 3 * (in_double ? sizeof(double) : sizeof(float));
  const double frames = std::ceil(1 + std::min(static_cast<double>(step_count(scene)),
                                               scene.duration * config.settings().output.frames_per_second));
  return head + mesh.vertices * rest_of_vertex +
         frames * (head_of_frame + mesh.vertices * position + mesh.triangles * of_triangle);
}

double read_bytes(const fs::path& file) {
  std::ifstream stream(file);
  double value = 0;
  return stream >> value ? value : std::numeric_limits<double>::infinity();  // "max", or no such file
}

double left_in_machine() {
  std::ifstream info("/proc/meminfo");
  std::string name;
  for (double kilobytes = 0; info >> name >> kilobytes; info.ignore(64, '\n'))
    if (name == "MemAvailable:") return kilobytes * 1024;
  return std::numeric_limits<double>::infinity();
}

double left_in_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return std::numeric_limits<double>::infinity();
  double pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

std::optional<Needs> needs_of(const RunConfig& config) {
  const std::optional<MeshSize> mesh = known_size_of(config);
  if (!mesh) return std::nullopt;
  const double springs = springs_per_vertex(config.scene().bending.model, *mesh);
  return Needs{.vertices = mesh->vertices,
               .springs = springs * mesh->vertices,
               .memory_bytes = memory_of(config.scene(), *mesh, springs),
               .disk_bytes = file_bytes(config, *mesh)};
}

double crude_work(const RunConfig& config) {
  const std::optional<MeshSize> mesh = known_size_of(config);
  const Scene& scene = config.scene();
  return (mesh ? mesh->vertices : 1) * substeps_of(scene.solver) * iterations_of(scene.solver) *
         static_cast<double>(step_count(scene));
}

double left_in_group(const fs::path& group) {
  const double most = read_bytes(group / "memory.max"), used = read_bytes(group / "memory.current");
  if (!std::isfinite(most) || !std::isfinite(used)) return std::numeric_limits<double>::infinity();
  double cached = 0;
  std::ifstream info(group / "memory.stat");
  std::string name;
  for (double count = 0; info >> name >> count;)
    if (name == "inactive_file") cached = count;
  return most - used + cached;
}

double available_memory() {
  const double group = left_in_group("/sys/fs/cgroup");  // in a container, this is its own group
  return std::max(0.0, std::min({left_in_machine(), group, left_in_limit()}));
}

std::string bytes_text(double count) {
  constexpr std::array units = {"bytes", "KB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  for (; count >= 999.5 && unit + 1 < units.size(); ++unit) count /= 1000;
  return fmt::format("{:.3g} {}", count, units[unit]);
}

std::string duration_text(double s) {
  if (s < 100) return fmt::format("{:.2g} s", s);
  if (s < 6000) return fmt::format("{:.0f} min", s / 60);
  return s < 100 * 3600 ? fmt::format("{:.2g} h", s / 3600) : fmt::format("{:.3g} days", s / 86400);
}

void require_memory(const RunConfig& config) {
  constexpr double let_through = 1.5;  // because needs are estimates
  const std::optional<Needs> needs = needs_of(config);
  const double available = available_memory();
  if (!needs) return;
  if (constexpr double most = std::numeric_limits<int>::max(); needs->springs > most)
    throw NoRoom(
        fmt::format("the run would have about {:.2g} springs, but at most {:.2g} can be counted: "
                    "choose fewer /mesh/cells, or a /bending/model with fewer springs",
                    needs->springs, most));
  if (needs->memory_bytes <= let_through * available) return;
  throw NoRoom(fmt::format(
      "the run needs about {} of memory, but only {} are available: choose fewer /mesh/cells{}{}",
      bytes_text(needs->memory_bytes), bytes_text(available),
      config.scene().solver.method.kind().factorised == Factorised::blocks ? ", or a method without a matrix"
                                                                           : "",
      needs->springs > 0 ? ", or a /bending/model with fewer springs" : ""));
}

void require_room(const RunConfig& config, const fs::path& folder) {
  require_memory(config);
  const std::optional<Needs> needs = needs_of(config);
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  if (needs && !error && needs->disk_bytes > 1.1 * static_cast<double>(space.available))
    throw RunFileError(fmt::format(
        "{}: the run file needs about {}, but only {} are free on that disk: choose fewer "
        "/output/frames_per_second, a shorter /duration, or another folder (--out)",
        folder.string(), bytes_text(needs->disk_bytes), bytes_text(static_cast<double>(space.available))));
}

}  // namespace bendlab
