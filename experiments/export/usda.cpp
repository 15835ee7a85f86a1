// USD as text: one file that has a mesh with positions over time for the cloth and for each obstacle. Time
// codes are frames of the run. Points are floats. If the run is far from the origin, points are relative to a
// nearby point, to which the prim "run" is translated.
//
// Sources of the format: the reference of Pixar's Sdf text files, and the schemas UsdGeomMesh,
// UsdGeomXformable.
#include <utility>

#include "experiments/export/format.hpp"

namespace bendlab {
namespace {

// A text in double quotes.
std::string usda_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text)
    if (c == '"' || c == '\\')
      quoted += {'\\', c};
    else
      quoted += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  return quoted + '"';
}

void print_point(OutputFile& file, const char* separator, const Eigen::RowVector3d& p) {
  file.print("{}({}, {}, {})", separator, static_cast<float>(p(0)), static_cast<float>(p(1)),
             static_cast<float>(p(2)));
}

void print_points(OutputFile& file, const Positions& positions) {
  const char* separator = "[";
  for (const auto& p : positions.rowwise()) print_point(file, std::exchange(separator, ", "), p);
  file.write("]");
}

// A list of `count` numbers.
template <class NumberOf>
void print_integers(OutputFile& file, std::string_view declaration, Eigen::Index count, NumberOf number_of) {
  const char* separator = "[";
  file.print("        {} = ", declaration);
  for (Eigen::Index i = 0; i < count; ++i) file.print("{}{}", std::exchange(separator, ", "), number_of(i));
  file.write("]\n");
}

void print_integers(OutputFile& file, std::string_view declaration, const Triangles& numbers) {
  print_integers(file, declaration, numbers.size(), [&](Eigen::Index i) { return numbers.data()[i]; });
}

/// Opposite corners of a box.
using Extent = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;

Extent extent_of(const Positions& positions) {
  Extent extent;
  extent << positions.colwise().minCoeff(), positions.colwise().maxCoeff();
  return extent;
}

// Writes the positions of a surface that deforms, frame by frame.
void write_samples(const ExportedRun& run, const Surface& surface, OutputFile& file) {
  std::vector<Extent> extents;
  file.write("        point3f[] points.timeSamples = {\n");
  for (const ExportedFrame& frame : run.frames) {
    const Positions positions = run.positions(surface, frame).rowwise() - run.origin.transpose();
    extents.push_back(extent_of(positions));
    file.print("            {}: ", run.time_code(frame));
    print_points(file, positions);
    file.write(",\n");
  }
  file.write("        }\n        float3[] extent.timeSamples = {\n");
  for (std::size_t k = 0; k < extents.size(); ++k) {
    file.print("            {}: ", run.time_code(run.frames[k]));
    print_points(file, extents[k]);
    file.write(",\n");
  }
  file.write("        }\n");
}

// Writes the positions of an obstacle at time 0, and the translation of the obstacle in each frame.
void write_rigid(const ExportedRun& run, const Surface& surface, OutputFile& file) {
  const Positions positions = surface.positions.rowwise() - run.origin.transpose();
  file.write("        point3f[] points = ");
  print_points(file, positions);
  file.write("\n        float3[] extent = ");
  print_points(file, extent_of(positions));
  file.write("\n");
  if (!surface.moves()) return;
  file.write("        double3 xformOp:translate.timeSamples = {\n");
  for (const ExportedFrame& frame : run.frames) {
    const Vector3 way = frame.time * surface.velocity;
    file.print("            {}: ({}, {}, {}),\n", run.time_code(frame), way.x(), way.y(), way.z());
  }
  file.write("        }\n        uniform token[] xformOpOrder = [\"xformOp:translate\"]\n");
}

void write_texture(const Surface& surface, OutputFile& file) {
  const char* separator = "[";
  file.write("        texCoord2f[] primvars:st = ");
  for (const auto& uv : surface.texture.rowwise())
    file.print("{}({}, {})", std::exchange(separator, ", "), static_cast<float>(uv(0)),
               static_cast<float>(uv(1)));
  file.write("] (\n            interpolation = \"faceVarying\"\n        )\n");
  print_integers(file, "int[] primvars:st:indices", surface.texture_corners);
}

void write_surface(const ExportedRun& run, const Surface& surface, OutputFile& file) {
  file.print("\n    def Mesh \"{}\"\n    {{\n", surface.name);
  file.write("        uniform bool doubleSided = 1\n        uniform token subdivisionScheme = \"none\"\n");
  print_integers(file, "int[] faceVertexCounts", surface.triangles.rows(), [](Eigen::Index) { return 3; });
  print_integers(file, "int[] faceVertexIndices", surface.triangles);
  if (surface.texture.rows() > 0) write_texture(surface, file);
  if (surface.deforms)
    write_samples(run, surface, file);
  else
    write_rigid(run, surface, file);
  file.write("    }\n");
}

void write_stage(const ExportedRun& run, OutputFile& file) {
  file.write("#usda 1.0\n(\n");
  file.print("    doc = {}\n    customLayerData = {{\n        dictionary bendlab = {{\n",
             usda_text(description_of(run)));
  file.print(
      "            string experiment = {}\n            string run = {}\n            string version = {}\n",
      usda_text(run.record.name), usda_text(run.record.id), usda_text(run.version));
  file.write("        }\n    }\n    defaultPrim = \"run\"\n    metersPerUnit = 1\n");
  file.print("    framesPerSecond = {0}\n    timeCodesPerSecond = {0}\n", run.frames_per_second);
  file.print("    startTimeCode = {}\n    endTimeCode = {}\n", run.time_code(run.frames.front()),
             run.time_code(run.frames.back()));
  file.print("    upAxis = \"{}\"\n)\n\ndef Xform \"run\"\n{{", run.up == UpAxis::y ? 'Y' : 'Z');
  if (!run.origin.isZero(0))
    file.print(
        "\n    double3 xformOp:translate = ({}, {}, {})\n"
        "    uniform token[] xformOpOrder = [\"xformOp:translate\"]\n",
        run.origin.x(), run.origin.y(), run.origin.z());
  for (const Surface& surface : run.surfaces) write_surface(run, surface, file);
  file.write("}\n");
}

void write_usda(const ExportedRun& run, Output& output) {
  const std::string stem = output.stem_of(run.surfaces.front());
  output.file(stem + ".usda", [&](OutputFile& file) { write_stage(run, file); });
}

}  // namespace

namespace format {
extern const Format usda{
    .name = "usda",
    .summary = "one USD file as text, cloth.usda: cloth and obstacles with their times, axis and units",
    .in_one_file = InOneFile::everything,
    .has_times = true,
    .write = write_usda,
};
}  // namespace format
}  // namespace bendlab
