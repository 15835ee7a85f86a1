// PLY: a binary file per frame, little endian. Positions are floats, or doubles if floats would round edges.
// A vertex has one pair of texture coordinates (s, t). A surface with seams, where a vertex has several
// pairs, is written without texture coordinates.
#include <optional>

#include "experiments/export/format.hpp"

namespace bendlab {
namespace {

// #V: the row of `texture` for each vertex. Nothing if the surface has no texture, or a seam.
std::optional<std::vector<int>> texture_of_vertices(const Surface& surface) {
  if (surface.texture.rows() == 0) return std::nullopt;
  std::vector<int> rows(static_cast<std::size_t>(surface.positions.rows()), -1);
  for (Eigen::Index corner = 0; corner < surface.triangles.size(); ++corner) {
    int& row = rows[static_cast<std::size_t>(surface.triangles.data()[corner])];
    const int texture_row = surface.texture_corners.data()[corner];
    if (row >= 0 && row != texture_row) return std::nullopt;
    row = texture_row;
  }
  for (int& row : rows) row = std::max(row, 0);  // a vertex without triangles gets row 0
  return rows;
}

std::string ply_header(const ExportedRun& run, const Surface& surface, bool textured) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment {0}\nelement vertex {1}\nproperty {2} x\nproperty {2} "
      "y\nproperty {2} z\n{3}element face {4}\nproperty list uchar int vertex_indices\nend_header\n",
      description_of(run), surface.positions.rows(), run.needs_double ? "double" : "float",
      textured ? "property float s\nproperty float t\n" : "", surface.triangles.rows());
}

template <class Real>
void write_frame(const Surface& surface, const std::optional<std::vector<int>>& texture,
                 const Positions& positions, OutputFile& file) {
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    for (int c = 0; c < 3; ++c) file.write_number(static_cast<Real>(positions(v, c)));
    if (!texture) continue;
    const int row = (*texture)[static_cast<std::size_t>(v)];
    for (int c = 0; c < 2; ++c) file.write_number(static_cast<float>(surface.texture(row, c)));
  }
  for (const auto& triangle : surface.triangles.rowwise()) {
    file.write_number(std::uint8_t{3});
    for (int c = 0; c < 3; ++c) file.write_number(std::int32_t{triangle(c)});
  }
}

void write_ply(const ExportedRun& run, Output& output) {
  for (const Surface& surface : run.surfaces) {
    const std::optional<std::vector<int>> texture = texture_of_vertices(surface);
    const std::string header = ply_header(run, surface, texture.has_value());
    for (const ExportedFrame& frame : run.frames) {
      output.file(output.stem_of(surface, frame.number) + ".ply", [&](OutputFile& file) {
        file.write(header);
        if (run.needs_double)
          write_frame<double>(surface, texture, run.positions(surface, frame), file);
        else
          write_frame<float>(surface, texture, run.positions(surface, frame), file);
      });
      if (!surface.moves()) break;
    }
  }
}

}  // namespace

namespace format {
extern const Format ply{
    .name = "ply",
    .summary = "a binary PLY file per frame, cloth.0000.ply and so on; smaller and faster than obj",
    .in_one_file = InOneFile::a_frame,
    .write = write_ply,
};
}  // namespace format
}  // namespace bendlab
