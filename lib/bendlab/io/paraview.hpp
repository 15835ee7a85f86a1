// The two formats by which ParaView reads a run: the group /VTKHDF (ParaView 5.12 and later) and an .xdmf
// text (ParaView 5.11 and earlier).
//
// VTKHDF 2.0 PolyData, https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/. The topology is
// written once. Each step states where its points and values begin. Only this folder's sources include this
// header.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bendlab/io/hdf5_handles.hpp"
#include "bendlab/io/run_file.hpp"

namespace bendlab {

/// The data that both formats need of a run with V vertices, T triangles and F frames.
struct ParaViewShape {
  std::uint64_t vertices = 0, triangles = 0;
  std::vector<double> times;             ///< F, s
  std::vector<std::string> cell_fields;  ///< datasets of /VTKHDF/CellData
  bool double_positions = false;
};

/// The group /VTKHDF with its type and version.
hdf5::Handle create_vtkhdf(hid_t file);

/// Writes the parts of /VTKHDF that are the same in all frames: topology and the pinned vertices.
void write_static_part(hid_t vtk, const RunHeader& header);

/// Writes /VTKHDF/Steps. Call this function once, after the last frame: ParaView crashes if the attribute
/// NSteps and the lengths of the datasets in Steps differ.
void write_steps(hid_t file, const ParaViewShape& shape);

/// An XDMF description of `frames`. `run_file` is the run file's path, relative to the .xdmf file's folder.
std::string xdmf_text(const std::string& run_file, const ParaViewShape& shape,
                      std::span<const std::int64_t> frames);

}  // namespace bendlab
