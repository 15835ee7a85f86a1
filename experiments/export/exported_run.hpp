// What an export takes from a run: its cloth, its obstacles, and the chosen frames.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/effects/effect.hpp"
#include "bendlab/io/run_file.hpp"
#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Which axis of the coordinates points up.
enum class UpAxis { y, z };
inline constexpr std::array<std::string_view, 2> up_axis_names = {"y", "z"};

/// A triangulated surface that an export writes: the cloth, or an obstacle.
struct Surface {
  std::string name;  ///< a letter, then letters, digits and '_': also of files and of prims in USD
  bool deforms = false;
  Positions positions;                 ///< #V by 3, m: of the cloth at rest, of an obstacle at time 0
  Triangles triangles;                 ///< #T by 3
  TextureCoordinates texture;          ///< #U by 2, or empty
  Triangles texture_corners;           ///< #T by 3, rows of `texture`
  Vector3 velocity = Vector3::Zero();  ///< m/s, of an obstacle

  bool moves() const { return deforms || !velocity.isZero(0); }
};

struct ExportedFrame {
  std::int64_t number = 0;  ///< in the run, from 0
  double time = 0;          ///< s
};

struct ExportedRun {
  RunRecord record;
  std::string version;                ///< of the program that computed it
  std::vector<ExportedFrame> frames;  ///< the chosen ones, at least one
  std::int64_t step = 1;              ///< from one of them to the next
  double frames_per_second = 0;
  UpAxis up = UpAxis::z;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< from the run's coordinates to those with `up` up
  bool double_positions = false;                       ///< the run stores float64
  bool needs_double = false;         ///< single precision would round its edges: it is far from the origin
  Vector3 origin = Vector3::Zero();  ///< m, relative to which floats hold its positions; 0 unless needed
  std::vector<Surface> surfaces;     ///< the cloth, then the obstacles
  std::vector<std::string> notes;    ///< what is left out, and why

  /// Of a surface in a frame, #V by 3, m. Throws RunFileError.
  Positions positions(const Surface& surface, const ExportedFrame& frame) const;

  /// The frame's time in frames: its number, where the run recorded frames at even times.
  double time_code(const ExportedFrame& frame) const;
};

/// The obstacles among a run's effects, where they are at time 0. Round ones have 96 corners around, which
/// lie on their surface. A plane is a square of 4 `size` below or beside `centre`, those of the cloth's rest
/// box. Mesh obstacles are read from `inputs`, the files in the run file. A spin is not there: it turns a
/// round shape into itself. `notes` receives why an obstacle is left out.
std::vector<Surface> obstacle_surfaces(const std::vector<Effect>& effects,
                                       const std::vector<InputFile>& inputs, const Vector3& centre,
                                       double size, std::vector<std::string>& notes);

/// `frames`: "FIRST:LAST:STEP", any of them left out, or one number; negative numbers count from the end;
/// empty: all. `up`: the run is turned so that this axis is up; by default it is not turned, and gravity
/// tells which one is. Throws UsageError for frames that the run does not have, RunFileError.
ExportedRun open_for_export(const RunRecord& record, std::string_view frames, std::optional<UpAxis> up);

}  // namespace bendlab
