// OBJ: a text file per frame.
#include "experiments/export/format.hpp"

namespace bendlab {
namespace {

template <class Real>
void print_vertices(OutputFile& file, const Positions& positions) {
  for (const auto& p : positions.rowwise())
    file.print("v {} {} {}\n", static_cast<Real>(p(0)), static_cast<Real>(p(1)), static_cast<Real>(p(2)));
}

// OBJ counts from 1.
std::string faces_text(const Surface& surface) {
  fmt::memory_buffer text;
  const auto append = std::back_inserter(text);
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    fmt::format_to(append, "f");
    for (int c = 0; c < 3; ++c)
      if (surface.texture.rows() > 0)
        fmt::format_to(append, " {}/{}", surface.triangles(t, c) + 1, surface.texture_corners(t, c) + 1);
      else
        fmt::format_to(append, " {}", surface.triangles(t, c) + 1);
    fmt::format_to(append, "\n");
  }
  return fmt::to_string(text);
}

void write_obj(const ExportedRun& run, Output& output) {
  for (const Surface& surface : run.surfaces) {
    const ObjText text(run, surface);
    for (const ExportedFrame& frame : run.frames) {
      output.file(output.stem_of(surface, frame.number) + ".obj",
                  [&](OutputFile& file) { text.write(file, frame); });
      if (!surface.moves()) break;
    }
  }
}

}  // namespace

ObjText::ObjText(const ExportedRun& run, const Surface& surface, const Vector3& origin)
    : run_(run), surface_(surface), origin_(origin) {
  head_ = fmt::format("# {}\n", description_of(run));
  if (!origin.isZero(0))
    head_ +=
        fmt::format("# origin {} {} {}: to be added to every position\n", origin.x(), origin.y(), origin.z());
  for (const auto& uv : surface.texture.rowwise()) tail_ += fmt::format("vt {} {}\n", uv(0), uv(1));
  tail_ += faces_text(surface);
}

void ObjText::write(OutputFile& file, const ExportedFrame& frame) const {
  file.write(head_);
  if (surface_.moves()) file.print("# frame {}, {} s\n", frame.number, frame.time);
  file.print("o {}\n", surface_.name);
  const Positions positions = run_.positions(surface_, frame).rowwise() - origin_.transpose();
  if (run_.double_positions)
    print_vertices<double>(file, positions);
  else
    print_vertices<float>(file, positions);
  file.write(tail_);
}

namespace format {
extern const Format obj{
    .name = "obj",
    .summary = "a Wavefront OBJ file per frame, cloth.0000.obj and so on, with texture coordinates",
    .in_one_file = InOneFile::a_frame,
    .write = write_obj,
};
}  // namespace format
}  // namespace bendlab
