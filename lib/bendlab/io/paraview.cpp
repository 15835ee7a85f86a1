#include "bendlab/io/paraview.hpp"

#include <fmt/format.h>

#include <array>
#include <map>

namespace bendlab {
namespace {

using hdf5::Handle;

/// Writes one of the four cell arrays of PolyData: #C cells of `vertices_per_cell` vertices.
void write_cells(hid_t vtk, const std::string& name, const std::vector<int>& vertices,
                 int vertices_per_cell) {
  const Handle group = hdf5::create_group(vtk, name);
  if (vertices.empty()) {
    hdf5::write_array(group, "NumberOfCells", std::vector<std::int64_t>{0});
    for (const char* name_of_zero : {"NumberOfConnectivityIds", "Offsets"})
      hdf5::add_link(group, "NumberOfCells", name_of_zero);  // all three are a single 0
    hdf5::write_array(group, "Connectivity", std::vector<std::int64_t>());
    return;
  }
  const std::size_t count = vertices.size() / static_cast<std::size_t>(vertices_per_cell);
  std::vector<std::int64_t> offsets(count + 1);
  for (std::size_t i = 0; i <= count; ++i) offsets[i] = static_cast<std::int64_t>(i) * vertices_per_cell;
  hdf5::write_array(group, "NumberOfCells", std::vector{static_cast<std::int64_t>(count)});
  hdf5::write_array(group, "NumberOfConnectivityIds",
                    std::vector{static_cast<std::int64_t>(vertices.size())});
  hdf5::write_array(group, "Offsets", offsets);
  hdf5::write_array(group, "Connectivity", std::vector<std::int64_t>(vertices.begin(), vertices.end()));
}

/// 0, stride, 2 stride, …
std::vector<std::int64_t> offsets(std::size_t count, std::uint64_t stride) {
  std::vector<std::int64_t> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<std::int64_t>(i * stride);
  return values;
}

std::string escaped(const std::string& text) {
  static const std::map<char, std::string_view> names = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string result;
  for (const char& c : text) {
    const auto entity = names.find(c);
    result += entity == names.end() ? std::string_view(&c, 1) : entity->second;
  }
  return result;
}

/// XML for the rows first … first + count of a dataset of `rows` rows. ParaView's Xdmf reader takes the first
/// text in a geometry's item as the name of its data. If two geometries had the same name, the reader would
/// show the first geometry twice. So the text contains an XML comment that is different in every frame.
std::string hyperslab(const std::string& dataset, const std::string& number, std::uint64_t first,
                      std::uint64_t count, std::uint64_t rows, int columns) {
  const auto shape = [&](std::uint64_t n) {
    return columns == 1 ? std::to_string(n) : fmt::format("{} {}", n, columns);
  };
  const std::string selection = columns == 1 ? fmt::format("{} 1 {}", first, count)
                                             : fmt::format("{} 0 1 1 {} {}", first, count, columns);
  return fmt::format(
      "<DataItem ItemType=\"HyperSlab\" Dimensions=\"{}\"><!-- from row {} --><DataItem Dimensions=\"3 {}\" "
      "Format=\"XML\">{}</DataItem><DataItem Dimensions=\"{}\" {} Format=\"HDF\">{}</DataItem></DataItem>",
      shape(count), first, columns == 1 ? 1 : 2, selection, shape(rows), number, dataset);
}

std::string xdmf_frame(const std::string& file, const ParaViewShape& shape, std::size_t k) {
  const std::uint64_t v = shape.vertices, t = shape.triangles, frames = shape.times.size();
  const std::string real = "NumberType=\"Float\" Precision=\"4\"";
  std::string text = fmt::format("<Grid Name=\"cloth\"><Time Value=\"{}\"/>\n", shape.times[k]);
  text += fmt::format(
      "<Topology TopologyType=\"Triangle\" NumberOfElements=\"{0}\"><DataItem Dimensions=\"{0} 3\" "
      "NumberType=\"Int\" Precision=\"4\" Format=\"HDF\">{1}:/rest/triangles</DataItem></Topology>\n",
      t, file);
  text += fmt::format("<Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
                      hyperslab(file + ":/VTKHDF/Points",
                                shape.double_positions ? "NumberType=\"Float\" Precision=\"8\"" : real, k * v,
                                v, frames * v, 3));
  for (const auto& field : shape.cell_fields)
    text += fmt::format(
        "<Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"Cell\">{}</Attribute>\n", escaped(field),
        hyperslab(file + ":/VTKHDF/CellData/" + escaped(field), real, k * t, t, frames * t, 1));
  text += fmt::format(
      "<Attribute Name=\"pinned\" AttributeType=\"Scalar\" Center=\"Node\"><DataItem Dimensions=\"{}\" "
      "NumberType=\"UChar\" Precision=\"1\" Format=\"HDF\">{}:/VTKHDF/PointData/pinned</DataItem></Attribute>"
      "</Grid>\n",
      v, file);
  return text;
}

}  // namespace

Handle create_vtkhdf(hid_t file) {
  Handle vtk = hdf5::create_group(file, "VTKHDF", 9);
  hdf5::write_attribute(vtk, "Version", std::array<std::int64_t, 2>{2, 0});
  hdf5::write_ascii_attribute(vtk, "Type", "PolyData");
  return vtk;
}

void write_static_part(hid_t vtk, const RunHeader& header) {
  const auto vertices = static_cast<std::int64_t>(header.rest_positions.size() / 3);
  hdf5::write_array(vtk, "NumberOfPoints", std::vector{vertices});
  write_cells(vtk, "Vertices", {}, 1);
  for (const char* absent : {"Lines", "Strips"}) hdf5::add_link(vtk, "Vertices", absent);  // all empty
  write_cells(vtk, "Polygons", header.triangles, 3);
  hdf5::add_link(hdf5::create_group(vtk, "PointData", 1), "/rest/pinned", "pinned");
}

void write_steps(hid_t file, const ParaViewShape& shape) {
  const Handle vtk = hdf5::open_group(file, "VTKHDF");
  const Handle steps = hdf5::create_group(vtk, "Steps", 8);
  const std::size_t frames = shape.times.size();
  hdf5::write_attribute(steps, "NSteps", static_cast<std::int64_t>(frames));
  hdf5::write_array(steps, "Values", shape.times);
  hdf5::write_array(steps, "PartOffsets", offsets(frames, 0));
  hdf5::write_array(steps, "NumberOfParts", std::vector<std::int64_t>(frames, 1));
  hdf5::write_array(steps, "PointOffsets", offsets(frames, shape.vertices));
  hdf5::write_array(steps, "CellOffsets", offsets(4 * frames, 0), 4);
  hdf5::add_link(steps, "CellOffsets", "ConnectivityIdOffsets");
  hdf5::create_group(steps, "PointDataOffsets", 1);
  hdf5::add_link(steps, "PartOffsets", "PointDataOffsets/pinned");
  const auto fields = static_cast<unsigned>(shape.cell_fields.size());
  const Handle cell_data = hdf5::create_group(steps, "CellDataOffsets", fields);
  for (std::size_t i = 0; i < shape.cell_fields.size(); ++i)
    if (i == 0)
      hdf5::write_array(cell_data, shape.cell_fields[0], offsets(frames, shape.triangles));
    else
      hdf5::add_link(cell_data, shape.cell_fields[0], shape.cell_fields[i]);
}

std::string xdmf_text(const std::string& run_file, const ParaViewShape& shape,
                      std::span<const std::int64_t> frames) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain>\n"
      "<Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  const std::string file = escaped(run_file);
  for (const std::int64_t k : frames) text += xdmf_frame(file, shape, static_cast<std::size_t>(k));
  return text + "</Grid>\n</Domain></Xdmf>\n";
}

}  // namespace bendlab
