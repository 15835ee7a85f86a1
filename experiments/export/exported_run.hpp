// The parts of a run that an export writes: its cloth, its obstacles, and the chosen frames.
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
  std::string name;  ///< a letter, then letters, digits and '_'; also names files, and prims in USD
  bool deforms = false;
  Positions positions;                 ///< #V by 3, m; the cloth at rest, or an obstacle at time 0
  Triangles triangles;                 ///< #T by 3
  TextureCoordinates texture;          ///< #U by 2, or empty
  Triangles texture_corners;           ///< #T by 3, rows of `texture`
  Vector3 velocity = Vector3::Zero();  ///< m/s, of an obstacle

  bool moves() const { return deforms || !velocity.isZero(0); }
};

struct ExportedFrame {
  std::int64_t number = 0;  ///< index in the run, from 0
  double time = 0;          ///< s
};

struct ExportedRun {
  RunRecord record;
  std::string version;                ///< of the program that computed the run
  std::vector<ExportedFrame> frames;  ///< the chosen frames, at least one
  std::int64_t step = 1;              ///< from a chosen frame to the next
  double frames_per_second = 0;
  UpAxis up = UpAxis::z;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< turns the run's coordinates to `up`
  bool double_positions = false;                       ///< the run stores float64
  bool needs_double = false;         ///< single precision would round edges, far from the origin
  Vector3 origin = Vector3::Zero();  ///< m; positions as floats are relative to it; 0 unless needed
  std::vector<Surface> surfaces;     ///< the cloth, then the obstacles
  std::vector<std::string> notes;    ///< parts that are left out, with the reason

  /// Positions of a surface in a frame, #V by 3, m. Throws RunFileError.
  Positions positions(const Surface& surface, const ExportedFrame& frame) const;

  /// The frame's time × frames_per_second: the frame's number, if the run recorded frames at equal intervals.
  double time_code(const ExportedFrame& frame) const;
};

/// The surfaces of the obstacles among a run's effects, at time 0. A round obstacle becomes a polyhedron with
/// 96 corners around, all on the obstacle's surface. A plane is a square with sides of 4 `size`, below or
/// beside `centre`; `centre` and `size` are those of the cloth's rest box. Mesh obstacles are read from
/// `inputs`, the files in the run file. Spins are left out, because a round shape that spins looks the same.
/// `notes` receives the reason if an obstacle is left out.
std::vector<Surface> obstacle_surfaces(const std::vector<Effect>& effects,
                                       const std::vector<InputFile>& inputs, const Vector3& centre,
                                       double size, std::vector<std::string>& notes);

/// `frames`: "FIRST:LAST:STEP", in which any number may be left out, or one number. Negative numbers count
/// from the end; empty: all frames. `up`: the run is turned so that this axis is up. Without `up` the run is
/// not turned, and the direction of gravity decides which axis is up. Throws UsageError for frames that the
/// run does not have, RunFileError.
ExportedRun open_for_export(const RunRecord& record, std::string_view frames, std::optional<UpAxis> up);

}  // namespace bendlab
