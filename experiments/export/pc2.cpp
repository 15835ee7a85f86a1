// PC2: a point cache with the positions of all frames. The cache moves the vertices of an OBJ file in the
// same folder, which has the first frame.
//
//   char[12]   "POINTCACHE2\0"
//   int32      version, 1
//   int32      number of points
//   float      frame of the first sample
//   float      frames from one sample to the next
//   int32      number of samples
//   float      x, y, z of every point of every sample
//
// All little endian. If floats would round edges, positions in both files are relative to the run's origin,
// which the OBJ file states.
#include "experiments/export/format.hpp"

namespace bendlab {
namespace {

constexpr std::string_view signature("POINTCACHE2\0", 12);

void write_cache(const ExportedRun& run, const Surface& surface, OutputFile& file) {
  file.write(signature);
  file.write_number(std::int32_t{1});
  file.write_number(static_cast<std::int32_t>(surface.positions.rows()));
  file.write_number(static_cast<float>(run.frames.front().number));
  file.write_number(static_cast<float>(run.step));
  file.write_number(static_cast<std::int32_t>(run.frames.size()));
  for (const ExportedFrame& frame : run.frames) {
    const Positions positions = run.positions(surface, frame).rowwise() - run.origin.transpose();
    for (Eigen::Index i = 0; i < positions.size(); ++i)
      file.write_number(static_cast<float>(positions.data()[i]));
  }
}

void write_pc2(const ExportedRun& run, Output& output) {
  for (const Surface& surface : run.surfaces) {
    const std::string stem = output.stem_of(surface);
    output.file(stem + ".obj",
                [&](OutputFile& file) { ObjText(run, surface, run.origin).write(file, run.frames.front()); });
    if (surface.moves())
      output.file(stem + ".pc2", [&](OutputFile& file) { write_cache(run, surface, file); });
  }
}

}  // namespace

namespace format {
extern const Format pc2{
    .name = "pc2",
    .summary =
        "a point cache of all frames, cloth.pc2, and an OBJ file with the first frame, whose vertices the "
        "cache moves",
    .in_one_file = InOneFile::everything,
    .states_origin = true,
    .write = write_pc2,
};
}  // namespace format
}  // namespace bendlab
