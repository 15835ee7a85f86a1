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
#include "experiments/run/expected_mesh.hpp"
#include "experiments/run/run_control.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

// Bytes, measured as a process's largest resident set over 12 models on grids of 32 to 1024 cells.
namespace bytes {
constexpr double of_program = 26e6;
constexpr double per_vertex = 1130;  // mesh, membrane, frames on their way to the file
// As a list, and in the order of the kernels; springs on grids of 64 to 512 cells.
constexpr double per_spring = 15, per_spring_in_double = 20, per_arc = 32;
constexpr double per_hinge = 105;
constexpr double fitted = 85, fitted_by_reach = 16, most_fitted = 213;
constexpr double bent_sheet = 3900;  // per vertex: the sheet bent, for a fit of pairs (a sparse factor)
constexpr double bent_sheet_less = 1e7;
constexpr double factor_per_vertex = 4700, factor_growth = 310;  // of `equilibrium`; + growth · log2 V
// Of `quasi_newton`, likewise, with its pairs, where bending is small beside the membrane: 32 to 256 cells.
// Where it is not, it takes 2900 on 128 cells.
constexpr double metric_per_vertex = 1000, metric_growth = 30;
constexpr double levels_per_vertex = 330;
constexpr double file = 36e3, small_file = 8e3;
constexpr double file_per_vertex = 39, file_per_regular_vertex = 5.5;  // the rest pose is compressed
constexpr double frame_per_vertex = 12, frame_per_triangle = 8, frame = 560;
constexpr double compressed = 0.65, most_compressed = 32768;  // a small file's arrays of frames
}  // namespace bytes

// Seconds of CPU time, on the processor of results/performance: fitted to the models on grids of 32 to 256
// cells.
namespace seconds {
constexpr double of_run = 3e-3;
constexpr double set_up_per_vertex = 6e-6, set_up_per_pair = 2e-7;
constexpr double choice_by_reach = 7e-7;  // per chosen spring and edge of its reach
// A fit bends the sheet, per vertex and, for the factor of its matrix, per vertex and √V; then fits each.
constexpr double bent_sheet = 7e-6, bent_sheet_factor = 1e-7, fitted_by_reach = 6.5e-7, fitted_hinge = 3e-6;
constexpr double vertex = 8e-9;                                 // in a substep, whatever effects there are
constexpr double triangle = 6e-9, pair = 2.2e-9, hinge = 9e-9;  // a projection
constexpr double levels_per_vertex = 3.5e-5, spans_per_vertex = 4e-9;  // once; an iteration
constexpr double frame_per_triangle = 1.2e-7;
constexpr double equilibrium_per_vertex = 4e-4;
constexpr double factor_per_vertex = 1e-6, factor_growth = 3e-7;  // of blocks; + growth · √V
constexpr double metric_per_vertex = 2e-5, iteration_per_vertex = 1.2e-7;
}  // namespace seconds

struct Parts {
  double program = 0, mesh = 0, bending = 0, factor = 0;
};

// A fit needs the response of the whole sheet where pairs are fitted to one.
double bent_sheet_bytes(double vertices) {
  const double growth = 1 + 0.04 * std::max(0.0, std::log2(vertices / 66049));
  return std::max(0.0, vertices * bytes::bent_sheet * growth - bytes::bent_sheet_less);
}

// What a pair takes while its stiffness is fitted. A longer one crosses more triangles.
double fitted_bytes(double reach) {
  return std::min(bytes::fitted + bytes::fitted_by_reach * reach, bytes::most_fitted);
}

// More of the matrix is filled where constraints reach farther: its separators are as many vertices wide.
double fill(const ExpectedConstraints& bending, double vertices) {
  const double of_vertex = (bending.springs + bending.arcs) / vertices, r = bending.reach / 2;
  return r <= 1 ? 1 : of_vertex > 8 ? r * r : r;
}

std::string advice_for(const Parts& parts, const RunConfig& config, bool fitted) {
  if (parts.factor > parts.bending + parts.mesh)
    return "choose fewer /mesh/cells, or a method without a matrix";
  if (parts.bending < parts.mesh) return "choose fewer /mesh/cells";
  std::string advice = fmt::format("choose fewer /mesh/cells, a smaller radius or level of {}, or sparse_lod",
                                   config.scene().bending.model.name());
  if (fitted)
    advice +=
        "; /bending/stiffness \"compliance\" or \"k\" needs less than \"physical\", which fits each spring";
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

double disk_bytes(const RunConfig& config, const ExpectedMesh& mesh, double frames, double cpu_s,
                  bool in_double) {
  double farthest = mesh.size / 2;  // from the origin, unless a mesh file is far from it
  farthest = std::max(farthest, config.scene().mesh.offset.cwiseAbs().maxCoeff());
  in_double = in_double || farthest * 0x1p-24 > tolerated_rounding * mesh.mean_edge;
  const bool regular = config.mesh_file().empty() && config.scene().mesh.generator != Generator::delaunay;
  const double points = mesh.vertices * bytes::frame_per_vertex * (in_double ? 2 : 1);
  const double fields = mesh.triangles * bytes::frame_per_triangle;
  // Positions are doubles until they are written.
  const double kept = frames * (bytes::frame + mesh.vertices * 3 * sizeof(double) + fields);
  const bool is_small = kept <= static_cast<double>(in_memory.bytes) && cpu_s < in_memory.seconds;
  const bool is_compressed = is_small && frames * points <= bytes::most_compressed;
  return (is_small ? bytes::small_file : bytes::file) +
         mesh.vertices * (regular ? bytes::file_per_regular_vertex : bytes::file_per_vertex) +
         frames * (bytes::frame + points + fields) * (is_compressed ? bytes::compressed : 1);
}

}  // namespace

std::optional<Forecast> forecast(const RunConfig& config) {
  const std::optional<ExpectedMesh> mesh = expected_mesh(config);
  if (!mesh) return std::nullopt;
  const Scene& scene = config.scene();
  const BendingModel& model = scene.bending.model;
  const MethodKind& method = scene.solver.method.kind();
  const ExpectedConstraints bending = model.kind().expect ? model.kind().expect(model.settings(), *mesh)
                                                          : ExpectedConstraints{.hinges = mesh->hinges};
  const double vertices = mesh->vertices, pairs = bending.springs + bending.arcs;
  const bool fitted = config.scene().bending.stiffness == Stiffness::physical;
  const double steps = static_cast<double>(step_count(scene));
  const double frames =
      1 + std::min(steps, config.scene().duration * config.settings().output.frames_per_second);

  Forecast needs{.constraints = pairs + bending.hinges};
  Parts parts{.program = bytes::of_program, .mesh = vertices * bytes::per_vertex};
  const bool in_double =
      method.make_float == nullptr || scene.solver.precision == ChosenPrecision::double_precision;
  parts.bending = bending.springs * (in_double ? bytes::per_spring_in_double : bytes::per_spring) +
                  bending.arcs * bytes::per_arc + bending.hinges * bytes::per_hinge;
  if (method.factorised == Factorised::scalars)
    parts.factor = vertices * (bytes::metric_per_vertex + bytes::metric_growth * std::log2(vertices));
  if (method.factorised == Factorised::blocks)
    parts.factor = vertices * (bytes::factor_per_vertex + bytes::factor_growth * std::log2(vertices)) *
                   fill(bending, vertices);
  if (fitted && pairs > 0)  // the fit is over before anything is factorised
    parts.bending = std::max({parts.bending, bent_sheet_bytes(vertices) - parts.factor,
                              pairs * fitted_bytes(bending.reach) - parts.factor});
  const bool levels =
      method.carries_stretch != nullptr && method.carries_stretch(scene.solver.method.settings());
  if (levels) parts.mesh += vertices * bytes::levels_per_vertex;
  needs.memory_bytes = parts.program + parts.mesh + parts.bending + parts.factor;
  needs.advice = advice_for(parts, config, fitted && pairs > 0);

  const double projection =
      mesh->triangles * seconds::triangle + pairs * seconds::pair + bending.hinges * seconds::hinge;
  double vertex = seconds::vertex;
  for (const Effect& effect : scene.effects) vertex += effect.kind().vertex_seconds;
  const double substep = iterations_of(scene.solver) * projection + vertices * vertex;
  needs.set_up_s = vertices * seconds::set_up_per_vertex + pairs * seconds::set_up_per_pair +
                   bending.chosen * bending.reach * seconds::choice_by_reach;
  if (fitted && pairs > 0)
    needs.set_up_s += vertices * (seconds::bent_sheet + seconds::bent_sheet_factor * std::sqrt(vertices)) +
                      pairs * bending.reach * seconds::fitted_by_reach;
  else if (fitted)
    needs.set_up_s += bending.hinges * seconds::fitted_hinge;
  double step = substeps_of(scene.solver) * substep;
  if (levels)
    needs.set_up_s += vertices * seconds::levels_per_vertex,
        step +=
        substeps_of(scene.solver) * iterations_of(scene.solver) * vertices * seconds::spans_per_vertex;
  step += substeps_of(scene.solver) * iterations_of(scene.solver) * vertices * method.vertex_seconds;
  if (method.factorised == Factorised::scalars)
    needs.set_up_s += vertices * seconds::metric_per_vertex,
        step +=
        substeps_of(scene.solver) * iterations_of(scene.solver) * vertices * seconds::iteration_per_vertex;
  if (method.factorised == Factorised::blocks)
    step += substeps_of(scene.solver) * iterations_of(scene.solver) * vertices * fill(bending, vertices) *
            (seconds::factor_per_vertex + seconds::factor_growth * std::sqrt(vertices));
  needs.cpu_s = seconds::of_run + needs.set_up_s + frames * mesh->triangles * seconds::frame_per_triangle +
                (method.has_motion ? steps * step
                                   : vertices * seconds::equilibrium_per_vertex * fill(bending, vertices));
  needs.disk_bytes = disk_bytes(config, *mesh, std::ceil(frames), needs.cpu_s, in_double);
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
  const double group = left_in_group("/sys/fs/cgroup");  // of a container, whose own group is at the root
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

constexpr double let_through = 1.1;  // a forecast is no measurement

void require_memory(const Forecast& needs) {
  constexpr double most = std::numeric_limits<int>::max();
  if (needs.constraints > most)
    throw NoRoom(
        fmt::format("the run would have about {:.2g} bending constraints, and no more than {:.2g} can "
                    "be counted: {}",
                    needs.constraints, most, needs.advice));
  if (const double available = available_memory(); needs.memory_bytes > let_through * available)
    throw NoRoom(fmt::format("the run needs about {} of memory, and {} are available: {}",
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
        "{}: the run file needs about {}, and {} are free on that disk: choose fewer "
        "/output/frames_per_second or a shorter /duration, or another --out",
        folder.string(), bytes_text(needs->disk_bytes), bytes_text(static_cast<double>(space.available))));
}

}  // namespace bendlab
