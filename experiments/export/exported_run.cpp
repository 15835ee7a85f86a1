#include "experiments/export/exported_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "bendlab/io/disk.hpp"
#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/mesh/files.hpp"
#include "bendlab/mesh/single_precision.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/scene/counted.hpp"
#include "bendlab/scene/gravity.hpp"
#include "bendlab/settings/names.hpp"
#include "experiments/config/run_config.hpp"
#include "experiments/config/settings_by_pointer.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/run/run_record.hpp"

namespace bendlab {
namespace {

struct FrameRange {
  std::int64_t first, last, step;  // last included
};

// The range that `text` names in a run of `count` frames; nothing if `text` is not such a range.
std::optional<FrameRange> range_of(std::string_view text, std::int64_t count) {
  std::array<std::optional<std::int64_t>, 3> given;
  std::size_t part = 0;
  for (bool more = true; more; ++part) {
    if (part == given.size()) return std::nullopt;
    const std::size_t colon = text.find(':');
    const std::string_view number = text.substr(0, colon);
    more = colon != std::string_view::npos;
    if (more) text.remove_prefix(colon + 1);
    if (number.empty()) continue;
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc() || end != number.data() + number.size()) return std::nullopt;
    given[part] = value;
  }
  const auto index = [&](std::int64_t number) { return number < 0 ? count + number : number; };
  const std::int64_t first = index(given[0].value_or(0));
  const std::int64_t last = part == 1 && given[0] ? first : index(given[1].value_or(-1));
  const FrameRange range{first, last, given[2].value_or(1)};
  const bool allowed = range.first >= 0 && range.first <= range.last && range.last < count && range.step > 0;
  return allowed ? std::optional(range) : std::nullopt;
}

void choose_frames(ExportedRun& run, std::string_view text) {
  const std::vector<double> times = read_metric(run.record.file, "time");
  const auto count = static_cast<std::int64_t>(times.size());
  if (count == 0) throw UsageError(fmt::format("{}: it has no frame yet", run.record.file.string()));
  const std::optional<FrameRange> range = range_of(text, count);
  if (!range)
    throw UsageError(fmt::format(
        "--frames '{}' names no frames of {}, which has {}: the first is 0, the last {} or -1. Write "
        "FIRST:LAST:STEP, such as 10:20, ::5 or -1",
        text, run.record.file.string(), counted(count, "frame"), count - 1));
  run.step = range->step;
  for (std::int64_t k = range->first; k <= range->last; k += range->step)
    run.frames.push_back({k, times[static_cast<std::size_t>(k)]});
}

// Reads the JSON itself, because the config of another version may be unreadable for this version.
double frames_per_second_of(const Json& config, const ExportedRun& run) {
  const Json* const setting = value_at(config, "/output/frames_per_second");
  if (setting && setting->is_number() && setting->get<double>() > 0) return setting->get<double>();
  const ExportedFrame &first = run.frames.front(), &last = run.frames.back();
  return last.time > first.time ? static_cast<double>(last.number - first.number) / (last.time - first.time)
                                : 1;
}

// Throws if a triangle names a vertex that does not exist. A damaged file without checksum may have such a
// triangle.
void require_sound(const Surface& cloth, const RunRecord& record) {
  const auto& t = cloth.triangles;
  if (t.size() > 0 && (t.minCoeff() < 0 || t.maxCoeff() >= cloth.positions.rows()))
    throw file_error(record.file, "can't be exported", "a triangle names a vertex that does not exist", 0);
}

// Stores the texture coordinates of the mesh file without repetitions. `corners`: a row for each corner of
// each triangle.
void take_texture(Surface& cloth, const TextureCoordinates& corners) {
  std::map<std::array<double, 2>, int> rows;
  cloth.texture_corners.resize(cloth.triangles.rows(), 3);
  for (Eigen::Index corner = 0; corner < corners.rows(); ++corner) {
    const auto row =
        rows.try_emplace({corners(corner, 0), corners(corner, 1)}, static_cast<int>(rows.size()));
    cloth.texture_corners(corner / 3, corner % 3) = row.first->second;
  }
  cloth.texture.resize(static_cast<Eigen::Index>(rows.size()), 2);
  for (const auto& [uv, row] : rows) cloth.texture.row(row) << uv[0], uv[1];
}

// Texture coordinates of the run's mesh file; empty if the file has none.
TextureCoordinates texture_in_file(const RunConfig& config, const std::vector<InputFile>& inputs,
                                   const Triangles& triangles) {
  const auto file = std::ranges::find(inputs, "/mesh/file", &InputFile::pointer);
  if (file == inputs.end()) return {};
  const auto policy = config.scene().mesh.bad_triangles;
  TriangleMesh mesh = accept(parse_polygon_soup(file->name, file->bytes), policy).mesh;
  if (mesh.triangles.rows() != triangles.rows() || mesh.triangles != triangles) return {};
  return std::move(mesh.texture_coordinates);
}

// Texture coordinates for a flat sheet at right angles to an axis: the rest coordinates, scaled so that the
// longer side goes from 0 to 1.
void take_flat_coordinates(Surface& cloth) {
  const Eigen::RowVector3d low = cloth.positions.colwise().minCoeff(),
                           extent = cloth.positions.colwise().maxCoeff() - low;
  constexpr double flat = 1e-6;  // of the longer side, because files may store rounded coordinates
  Eigen::Index across = 0;
  const double longest = extent.maxCoeff();
  if (!(longest > 0) || extent.minCoeff(&across) > flat * longest) return;
  const Eigen::Index u = across == 0 ? 1 : 0, v = across == 2 ? 1 : 2;
  cloth.texture.resize(cloth.positions.rows(), 2);
  cloth.texture.col(0) = (cloth.positions.col(u).array() - low(u)) / longest;
  cloth.texture.col(1) = (cloth.positions.col(v).array() - low(v)) / longest;
  cloth.texture_corners = cloth.triangles;
}

// The bytes of the file that an effect names, from the run file; null if the effect names no file. Throws
// std::invalid_argument if the file is not in the run file.
const std::string* file_of(const Effect& effect, std::size_t index, const std::vector<InputFile>& inputs) {
  for (const Field& field : effect.kind().settings.fields) {
    if (!field.names_file) continue;
    const auto file =
        std::ranges::find(inputs, fmt::format("/effects/{}/{}", index, field.name), &InputFile::pointer);
    if (file == inputs.end())
      throw std::invalid_argument(fmt::format("the run file does not hold its {}", field.name));
    return &file->bytes;
  }
  return nullptr;
}

// Reads from the settings: texture, obstacles, the direction of gravity.
void take_from_config(ExportedRun& run, const Json& json, std::optional<UpAxis>& gravity_up) try {
  const RunConfig config = stored_run(json);
  const std::vector<InputFile> inputs = read_inputs(run.record.file);
  const Vector3 down = direction_of_gravity(config.scene().effects);
  gravity_up = -down.y() > std::abs(down.z()) ? UpAxis::y : UpAxis::z;
  Surface& cloth = run.surfaces.front();
  const TextureCoordinates texture = texture_in_file(config, inputs, cloth.triangles);
  if (texture.rows() == 3 * cloth.triangles.rows()) take_texture(cloth, texture);
  const Vector3 low = cloth.positions.colwise().minCoeff(), high = cloth.positions.colwise().maxCoeff();
  for (Surface& obstacle :
       obstacle_surfaces(config.scene().effects, inputs, (low + high) / 2, (high - low).norm(), run.notes))
    run.surfaces.push_back(std::move(obstacle));
} catch (const RunFileError&) {
  throw;
} catch (const std::exception& error) {  // another version of this program wrote the settings
  run.notes.push_back(fmt::format(
      "obstacles are left out, because this version can't read the run's settings: {}", error.what()));
}

// A point (x, y, z) with z up becomes (x, z, -y) with y up.
Eigen::Matrix3d turn_between(UpAxis from, UpAxis to) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (from == to) return turn;
  const double sign = from == UpAxis::z ? 1 : -1;
  turn << 1, 0, 0, 0, 0, sign, 0, -sign, 0;
  return turn;
}

}  // namespace

std::vector<Surface> obstacle_surfaces(const std::vector<Effect>& effects,
                                       const std::vector<InputFile>& inputs, const Vector3& centre,
                                       double size, std::vector<std::string>& notes) {
  std::vector<Surface> surfaces;
  for (std::size_t index = 0; index < effects.size(); ++index) {
    const Effect& effect = effects[index];
    if (effect.kind().surface == nullptr) continue;
    Surface surface{.name = pass_name(effects, index)};
    std::ranges::replace(surface.name, ' ', '_');
    try {
      TriangleMesh mesh = effect.kind().surface(
          effect.settings(), {.file = file_of(effect, index, inputs), .centre = centre, .size = size});
      surface.positions = std::move(mesh.positions);
      surface.triangles = std::move(mesh.triangles);
      surface.velocity = effect.kind().motion(effect.settings()).velocity;
    } catch (const std::exception& error) {
      notes.push_back(fmt::format("{} is left out: {}", surface.name, error.what()));
      continue;
    }
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

Positions ExportedRun::positions(const Surface& surface, const ExportedFrame& frame) const {
  if (surface.deforms) {
    const std::vector<double> stored = read_positions(record.file, frame.number);
    if (turn.isIdentity(0)) return as_rows(stored);
    return as_rows(stored) * turn.transpose();
  }
  return surface.positions.rowwise() + (frame.time * surface.velocity).transpose();
}

double ExportedRun::time_code(const ExportedFrame& frame) const {
  constexpr double rounding = 1e-6;  // of a frame; the run stores rounded times
  const double code = frame.time * frames_per_second, whole = std::round(code);
  return std::abs(code - whole) < rounding ? whole : code;
}

ExportedRun open_for_export(const RunRecord& record, std::string_view frames, std::optional<UpAxis> up) {
  ExportedRun run{.record = record};
  choose_frames(run, frames);
  run.version = provenance_text(record, "version", "unknown");
  const RestRecord rest = read_rest(record.file);
  run.double_positions = rest.double_positions;
  run.surfaces.push_back({.name = "cloth",
                          .deforms = true,
                          .positions = as_rows(rest.positions),
                          .triangles = as_rows(rest.triangles)});
  require_sound(run.surfaces.front(), record);
  const Json config = Json::parse(record.config, nullptr, false);
  run.frames_per_second = frames_per_second_of(config, run);
  std::optional<UpAxis> gravity_up;
  take_from_config(run, config, gravity_up);
  if (Surface& cloth = run.surfaces.front(); cloth.texture.rows() == 0) take_flat_coordinates(cloth);

  const UpAxis as_stored = gravity_up.value_or(UpAxis::z);
  run.up = up.value_or(as_stored);
  run.turn = turn_between(as_stored, run.up);
  for (Surface& surface : run.surfaces) {
    surface.positions *= run.turn.transpose();
    surface.velocity = run.turn * surface.velocity;
  }
  const Surface& cloth = run.surfaces.front();
  run.needs_double = needs_double(cloth.positions, cloth.triangles);
  if (run.needs_double) run.origin = round_centre(cloth.positions);
  return run;
}

}  // namespace bendlab
