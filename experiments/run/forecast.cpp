#include "experiments/run/forecast.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>

#include "bendlab/bending/model.hpp"
#include "bendlab/constraints/stiffness.hpp"
#include "bendlab/effects/effect.hpp"
#include "bendlab/io/run_file.hpp"
#include "bendlab/mesh/single_precision.hpp"
#include "bendlab/scene/rules.hpp"
#include "bendlab/scene/start_after.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/run/run_control.hpp"
#include "experiments/run/run_size.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

// Bytes, measured as the largest resident set of a process, for 12 models on grids of 32 to 1024 cells.
namespace bytes {
constexpr double of_program = 26e6;
constexpr double per_vertex = 1130;  // mesh, membrane, frames that wait to be written
constexpr double padding = 1.3;      // of constraints, which kernels take in groups
// Memory while the stiffness of pairs of vertices is fitted: `fitted` per pair, or, if larger, the sparse
// factor of the bent sheet (`bent_sheet` per vertex minus `bent_sheet_less`).
constexpr double bent_sheet = 3900, bent_sheet_less = 1e7, fitted = 190;
constexpr double factor_of_scalars = 110,
                 factor_of_blocks = 700;  // per unknown block, times log2 of their count
constexpr double levels_per_vertex = 330;
constexpr double file = 36e3, small_file = 8e3;
constexpr double file_per_vertex = 39, file_per_regular_vertex = 5.5;  // the rest pose is compressed
constexpr double frame_per_vertex = 12, frame_per_triangle = 8, frame = 560;
constexpr double compressed = 0.65, most_compressed = 32768;  // frame arrays in small files
}  // namespace bytes

// Seconds of CPU time, on the processor of results/performance: fitted to the models on grids of 32 to 256
// cells.
namespace seconds {
constexpr double of_run = 3e-3;
constexpr double set_up_per_vertex = 6e-6, levels_per_vertex = 3.5e-5, scalars_per_vertex = 1e-5;
constexpr double set_up_per_constraint = 2e-7, bent_sheet_per_vertex = 2e-5, fitted = 3e-6;
constexpr double frame_per_triangle = 1.2e-7;
constexpr double vertex = 8e-9;              // in a substep, besides the effects
constexpr double number = 1e-9;              // a projection, per number that the constraint keeps
constexpr double factor_of_blocks = 3.2e-7;  // per block of three unknowns, times the root of their count
constexpr double director = 1e-7;            // as `number`, per coordinate of a director
// To find the Hessian of a constraint: per square of the count of numbers that it keeps. `own`: to evaluate
// an element of dkt or of a user once, per corner.
constexpr double hessian = 8e-8, own = 1.5e-7;
}  // namespace seconds

struct Parts {
  double mesh = 0, bending = 0, factor = 0;
};

bool has_levels(const Method& method) {
  return method.kind().carries_stretch != nullptr && method.kind().carries_stretch(method.settings());
}

// The factor of a matrix has more entries if there are more constraints, or if constraints join more points,
// or more distant points, than hinges do.
double fill(const RunSize& size) {
  constexpr double of_hinge = 4;  // vertices
  return std::max({1.0, 0.35 * size.reach * std::cbrt(size.pairs / size.vertices), size.corners / of_hinge});
}

// The unknowns of the matrix, three to a block.
double blocks_of(const RunSize& size) {
  return size.vertices + size.directors / 3;
}

Parts memory_parts(const RunConfig& config, const RunSize& size, bool in_double) {
  const Solver& solver = config.scene().solver;
  const MethodKind& method = solver.method.kind();
  Parts parts{.mesh = size.vertices *
                      (bytes::per_vertex + (has_levels(solver.method) ? bytes::levels_per_vertex : 0)),
              .bending = size.list_bytes + size.numbers * bytes::padding * (in_double ? 6 : 4)};
  const auto factor = [](double unknowns) { return unknowns * std::log2(unknowns); };
  if (method.factorised == Factorised::scalars)
    parts.factor = factor(size.vertices) * bytes::factor_of_scalars;
  if (method.factorised == Factorised::blocks)
    parts.factor = factor(blocks_of(size)) * bytes::factor_of_blocks * fill(size);
  if (config.scene().bending.stiffness != Stiffness::physical || size.pairs == 0) return parts;
  // The fit frees its memory before the solver factorises its matrix.
  const double fit =
      std::max(size.vertices * bytes::bent_sheet - bytes::bent_sheet_less, size.pairs * bytes::fitted);
  parts.bending = std::max(parts.bending, fit - parts.factor);
  return parts;
}

std::string advice_for(const Parts& parts, const RunConfig& config, bool fitted) {
  if (parts.factor > parts.bending + parts.mesh)
    return "choose fewer /mesh/cells, or a method without a matrix";
  if (parts.bending < parts.mesh) return "choose fewer /mesh/cells";
  std::string advice =
      fmt::format("choose fewer /mesh/cells, a smaller radius or level of {}, or the model sparse_lod",
                  config.scene().bending.model.name());
  if (fitted)
    advice +=
        "; /bending/stiffness \"compliance\" or \"k\" needs less memory than \"physical\", which fits each "
        "spring";
  return advice;
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

double disk_bytes(const RunConfig& config, const RunSize& size, double frames, double cpu_s, bool in_double) {
  const Mesh& mesh = config.scene().mesh;
  // The largest coordinate, except if a mesh file has coordinates far from the origin.
  const double farthest = std::max(size.size / 2, mesh.offset.cwiseAbs().maxCoeff());
  in_double = in_double || farthest * 0x1p-24 > tolerated_rounding * size.mean_edge;
  const bool regular = !mesh.file && mesh.generator != Generator::delaunay;
  const double points = size.vertices * bytes::frame_per_vertex * (in_double ? 2 : 1);
  const double fields = size.triangles * bytes::frame_per_triangle;
  // Positions are doubles until they are written.
  const double kept = frames * (bytes::frame + size.vertices * 3 * sizeof(double) + fields);
  const bool is_small = kept <= static_cast<double>(in_memory.bytes) && cpu_s < in_memory.seconds;
  const bool is_compressed = is_small && frames * points <= bytes::most_compressed;
  return (is_small ? bytes::small_file : bytes::file) +
         size.vertices * (regular ? bytes::file_per_regular_vertex : bytes::file_per_vertex) +
         frames * (bytes::frame + points + fields) * (is_compressed ? bytes::compressed : 1);
}

double set_up_seconds(const Scene& scene, const RunSize& size) {
  const bool fitted = scene.bending.stiffness == Stiffness::physical && size.pairs > 0;
  double vertex = seconds::set_up_per_vertex + (fitted ? seconds::bent_sheet_per_vertex : 0);
  if (has_levels(scene.solver.method)) vertex += seconds::levels_per_vertex;
  if (scene.solver.method.kind().factorised == Factorised::scalars) vertex += seconds::scalars_per_vertex;
  return size.vertices * vertex + size.constraints * seconds::set_up_per_constraint +
         (fitted ? size.pairs * seconds::fitted : 0);
}

double solver_seconds(const Scene& scene, const RunSize& size) {
  constexpr double strain_numbers = 7, equilibrium_iterations = 30, coordinates = 18;
  const MethodKind& method = scene.solver.method.kind();
  const double substeps = static_cast<double>(step_count(scene)) * substeps_of(scene.solver);
  const double iterations =
      method.has_motion ? substeps * iterations_of(scene.solver) : equilibrium_iterations;
  const double of_hessian =
      size.constraints > 0 ? seconds::hessian * size.numbers * size.numbers / size.constraints : 0;
  const double blocks = blocks_of(size);
  // The Hessian of an own element comes from its gradients at two places along each coordinate.
  const double iteration =
      method.factorised == Factorised::blocks
          ? seconds::factor_of_blocks * blocks * std::sqrt(blocks) * fill(size) + of_hessian +
                2 * coordinates * seconds::own * size.own
          : method.cost * (seconds::number * (size.triangles * strain_numbers + size.numbers) +
                           seconds::director * size.directors) +
                seconds::own * size.own;
  double vertex = seconds::vertex;
  for (const Effect& effect : scene.effects) vertex += effect.kind().vertex_seconds;
  return substeps * size.vertices * vertex + iterations * iteration;
}

}  // namespace

std::optional<Forecast> forecast(const RunConfig& config) {
  const std::optional<RunSize> size = size_of(config);
  if (!size) return std::nullopt;
  const Scene& scene = config.scene();
  const MethodKind& method = scene.solver.method.kind();
  const bool fitted = scene.bending.stiffness == Stiffness::physical;
  const bool in_double =
      method.make_float == nullptr || scene.solver.precision == ChosenPrecision::double_precision;
  const double steps = static_cast<double>(step_count(scene));
  const double frames =
      std::ceil(1 + std::min(steps, scene.duration * config.settings().output.frames_per_second));
  const Parts parts = memory_parts(config, *size, in_double);
  Forecast needs{.memory_bytes = bytes::of_program + parts.mesh + parts.bending + parts.factor,
                 .set_up_s = set_up_seconds(scene, *size),
                 .constraints = size->constraints,
                 .advice = advice_for(parts, config, fitted && size->pairs > 0)};
  needs.cpu_s = seconds::of_run + needs.set_up_s + frames * size->triangles * seconds::frame_per_triangle +
                solver_seconds(scene, *size);
  needs.disk_bytes = disk_bytes(config, *size, frames, needs.cpu_s, in_double);
  return needs;
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

namespace {

constexpr double let_through = 1.1;  // because a forecast is not exact

void require_memory(const Forecast& needs) {
  constexpr double most = std::numeric_limits<int>::max();
  if (needs.constraints > most)
    throw NoRoom(fmt::format(
        "the run would have about {:.2g} bending constraints, but at most {:.2g} can be counted: {}",
        needs.constraints, most, needs.advice));
  if (const double available = available_memory(); needs.memory_bytes > let_through * available)
    throw NoRoom(fmt::format("the run needs about {} of memory, but only {} are available: {}",
                             bytes_text(needs.memory_bytes), bytes_text(available), needs.advice));
}

}  // namespace

void require_memory(const RunConfig& config) {
  if (const std::optional<Forecast> needs = forecast(config)) require_memory(*needs);
}

void require_room(const RunConfig& config, const fs::path& folder) {
  const std::optional<Forecast> needs = forecast(config);
  if (!needs) return;
  require_memory(*needs);
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  if (!error && needs->disk_bytes > let_through * static_cast<double>(space.available))
    throw RunFileError(fmt::format(
        "{}: the run file needs about {}, but only {} are free on that disk: choose fewer "
        "/output/frames_per_second, a shorter /duration, or another folder (--out)",
        folder.string(), bytes_text(needs->disk_bytes), bytes_text(static_cast<double>(space.available))));
}

}  // namespace bendlab
