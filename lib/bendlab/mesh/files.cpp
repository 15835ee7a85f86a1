#include "bendlab/mesh/files.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "bendlab/mesh/readers.hpp"
#include "bendlab/settings/input_file.hpp"

namespace bendlab {
namespace {

using Kind = MeshFileError::Kind;

[[noreturn]] void fail(Kind kind, const std::filesystem::path& path, std::string_view what) {
  throw MeshFileError(kind, fmt::format("mesh file '{}': {}", path.string(), what));
}

std::string read_bytes(const std::filesystem::path& path) try {
  return read_input_file(path);
} catch (const std::runtime_error& error) {
  fail(Kind::unreadable, path, error.what());
}

PolygonSoup parse(const std::string& extension, const std::string& bytes) {
  if (extension == ".obj") return parse_obj(bytes);
  if (extension == ".off") return parse_off(bytes);
  if (extension == ".ply") return parse_ply(bytes);
  if (extension == ".stl") return parse_stl(bytes);
  throw std::invalid_argument(
      fmt::format("extension '{}' is not known; allowed are .obj, .ply, .off, .stl", extension));
}

AcceptedMesh read(const std::filesystem::path& path, BadTriangles policy, std::string_view remedy) {
  const PolygonSoup soup = read_polygon_soup(path);
  try {
    return accept(soup, policy, remedy);
  } catch (const std::invalid_argument& error) {
    fail(Kind::refused, path, error.what());
  }
}

void write_obj(std::ostream& out, const TriangleMesh& mesh) {
  const bool textured = mesh.texture_coordinates.rows() > 0;
  for (const auto& p : mesh.positions.rowwise()) fmt::print(out, "v {} {} {}\n", p(0), p(1), p(2));
  for (const auto& t : mesh.texture_coordinates.rowwise()) fmt::print(out, "vt {} {}\n", t(0), t(1));
  for (Eigen::Index t = 0; t < mesh.triangle_count(); ++t) {
    fmt::print(out, "f");
    for (int c = 0; c < 3; ++c)
      if (textured)
        fmt::print(out, " {}/{}", mesh.triangles(t, c) + 1, 3 * t + c + 1);
      else
        fmt::print(out, " {}", mesh.triangles(t, c) + 1);
    fmt::print(out, "\n");
  }
}

// The lines of vertices and triangles, which are the same in OFF and PLY files.
void write_lists(std::ostream& out, const TriangleMesh& mesh) {
  for (const auto& p : mesh.positions.rowwise()) fmt::print(out, "{} {} {}\n", p(0), p(1), p(2));
  for (const auto& t : mesh.triangles.rowwise()) fmt::print(out, "3 {} {} {}\n", t(0), t(1), t(2));
}

constexpr std::string_view ply_header =
    "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
    "element face {}\nproperty list uchar int vertex_indices\nend_header\n";

}  // namespace

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

PolygonSoup read_polygon_soup(const std::filesystem::path& path) {
  return parse_polygon_soup(path, read_bytes(path));
}

PolygonSoup parse_polygon_soup(const std::filesystem::path& path, const std::string& bytes) {
  try {
    return parse(extension_of(path), bytes);
  } catch (const std::invalid_argument& error) {
    fail(Kind::refused, path, error.what());
  }
}

AcceptedMesh read_mesh(const std::filesystem::path& path, BadTriangles policy) {
  return read(path, policy, remedy_of_cloth);
}

TriangleMesh read_mesh(const std::filesystem::path& path, std::vector<std::string>* notes) {
  AcceptedMesh accepted =
      read(path, BadTriangles::refuse,
           fmt::format("run 'bendlab mesh {} --bad-triangles repair --write NEW.obj' and use NEW.obj instead",
                       path.string()));
  if (notes != nullptr) notes->insert(notes->end(), accepted.notes.begin(), accepted.notes.end());
  return std::move(accepted.mesh);
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
  const std::string extension = extension_of(path);
  if (extension != ".obj" && extension != ".off" && extension != ".ply")
    fail(Kind::refused, path, "can't be written: allowed are .obj, .ply, .off");
  std::ofstream out(path, std::ios::binary);
  if (extension == ".obj") {
    write_obj(out, mesh);
  } else {
    if (extension == ".off") fmt::print(out, "OFF\n{} {} 0\n", mesh.vertex_count(), mesh.triangle_count());
    if (extension == ".ply") fmt::print(out, ply_header, mesh.vertex_count(), mesh.triangle_count());
    write_lists(out, mesh);
  }
  out.close();  // a full disk shows only now
  if (!out) fail(Kind::unreadable, path, fmt::format("can't be written: {}", std::strerror(errno)));
}

}  // namespace bendlab
