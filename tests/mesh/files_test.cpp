#include "bendlab/mesh/files.hpp"

#include <Eigen/Geometry>
#include <bit>
#include <cstring>
#include <fstream>
#include <random>

#include "bendlab/mesh/generators.hpp"
#include "tests/catch.hpp"

namespace bendlab::files_test {
namespace fs = std::filesystem;

namespace {

// A temporary folder. The destructor removes it.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("bendlab_files_" + std::to_string(std::random_device()()))) {
    fs::create_directory(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path path(const std::string& name) const { return path_ / name; }
  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

 private:
  fs::path path_;
};

struct Refusal {
  MeshFileError::Kind kind{};
  std::string text;
};

Refusal refusal_of(const fs::path& path) {
  try {
    read_mesh(path);
  } catch (const MeshFileError& error) {
    return {error.kind(), error.what()};
  }
  FAIL("accepted: " << path);
  return {};
}

void check_refused(const fs::path& path, const std::string& part) {
  const Refusal refusal = refusal_of(path);
  INFO(refusal.text);
  CHECK(refusal.kind == MeshFileError::Kind::refused);
  CHECK(refusal.text.find(path.string()) != std::string::npos);
  CHECK(refusal.text.find(part) != std::string::npos);
}

template <class Type>
void append(std::string& bytes, Type value, bool big_endian = false) {
  std::array<char, sizeof(Type)> raw;
  std::memcpy(raw.data(), &value, sizeof value);
  if (big_endian) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.begin(), raw.end());
}

Triangles triangles_of(std::initializer_list<std::array<int, 3>> list) {
  Triangles triangles(static_cast<Eigen::Index>(list.size()), 3);
  Eigen::Index t = 0;
  for (const auto& [a, b, c] : list) triangles.row(t++) << a, b, c;
  return triangles;
}

const Positions unit_square = (Positions(4, 3) << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0).finished();
const Triangles two_triangles = triangles_of({{0, 1, 2}, {0, 2, 3}});

const std::string obj_vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string ply_vertices =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n";

}  // namespace

TEST_CASE("OBJ may have comments, normals, a quad and negative indices", "[mesh][files]") {
  const Folder folder;
  const TriangleMesh mesh =
      read_mesh(folder.write("a.obj", "# square\nmtllib none.mtl\no sheet\n" + obj_vertices +
                                          "vn 0 0 1\nusemtl red\nf 1//1 2//1 3//1 -1//1\n"));
  CHECK(mesh.positions == unit_square);
  CHECK(mesh.triangles == two_triangles);
  CHECK(mesh.texture_coordinates.rows() == 0);
}

TEST_CASE("OBJ texture coordinates belong to corners", "[mesh][files]") {
  const Folder folder;
  const std::string texture = "vt 0 0\nvt 0.5 0\nvt 0.5 0.25\nvt 0.125 1\n";
  const TriangleMesh mesh =
      read_mesh(folder.write("a.obj", obj_vertices + texture + "f 1/4 2/2 3/3\nf 1/1 3/3 4/2\n"));
  TextureCoordinates expected(6, 2);
  expected << 0.125, 1, 0.5, 0, 0.5, 0.25, 0, 0, 0.5, 0.25, 0.5, 0;
  CHECK(mesh.texture_coordinates == expected);
  // The fan of a quad repeats its corners.
  const TriangleMesh quad = read_mesh(folder.write("b.obj", obj_vertices + texture + "f 1/1 2/2 3/3 4/4\n"));
  expected << 0, 0, 0.5, 0, 0.5, 0.25, 0, 0, 0.5, 0.25, 0.125, 1;
  CHECK(quad.texture_coordinates == expected);
  // Where a corner has none, the mesh has none, and a note says how many.
  std::vector<std::string> notes;
  CHECK(read_mesh(folder.write("c.obj", obj_vertices + texture + "f 1/1 2/2 3/3\nf 1 3 4\n"), &notes)
            .texture_coordinates.rows() == 0);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0] == "texture coordinates left out, because 1 of 2 triangles have no texture coordinates");
  check_refused(folder.write("d.obj", obj_vertices + texture + "f 1/1 2/2 3/5\n"), "texture coordinate 5");
  check_refused(folder.write("e.obj", obj_vertices + "vt 0 nan\nf 1/1 2/1 3/1\n"), "line 5");
}

TEST_CASE("OBJ keeps all digits of double", "[mesh][files]") {
  const Folder folder;
  const PolygonSoup soup =
      read_polygon_soup(folder.write("a.obj", "v 0.1 1e-17 123456789.123456789\nv +2 1e999 -1e-999\n"));
  CHECK(soup.points[0] == std::array{0.1, 1e-17, 123456789.123456789});
  CHECK(soup.points[1] == std::array{2.0, std::numeric_limits<double>::infinity(), 0.0});
}

TEST_CASE("OFF is read in all its spellings", "[mesh][files]") {
  const Folder folder;
  const std::string faces = "3 0 1 2\n3 0 2 3 255 0 0\n";
  for (const std::string& text :
       {"OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + faces,
        "OFF 4 2 5\n\n0 0 0\n1 0 0 # corner\n# none\n1 1 0\n0 1 0\n" + faces,
        "NOFF\r\n4 2 0\r\n0 0 0 0 0 1\r\n1 0 0 0 0 1\r\n1 1 0 0 0 1\r\n0 1 0 0 0 1\r\n" + faces}) {
    const TriangleMesh mesh = read_mesh(folder.write("A.OFF", text));
    CHECK(mesh.positions == unit_square);
    CHECK(mesh.triangles == two_triangles);
  }
}

TEST_CASE("PLY as text may have other properties and elements in between", "[mesh][files]") {
  const Folder folder;
  const TriangleMesh mesh = read_mesh(
      folder.write("a.ply",
                   "ply\nformat ascii 1.0\ncomment made by hand\nelement camera 1\nproperty list uchar float "
                   "pose\nelement vertex 4\n"
                   "property uchar red\nproperty int x\nproperty double y\nproperty float z\nelement face 1\n"
                   "property list uint8 uint32 vertex_index\nproperty float shade\nend_header\n"
                   "3 1 2 3\n7 0 0 0\n7 1 0 0\n7 1 1 0\n7 0 1 0\n4 0 1 2 3 0.5\n"));
  CHECK(mesh.positions == unit_square);
  CHECK(mesh.triangles == two_triangles);
}

TEST_CASE("PLY types may have either of their two names", "[mesh][files]") {
  const Folder folder;
  for (const std::string type : {"char", "int8", "uchar", "uint8", "short", "int16", "ushort", "uint16",
                                 "int", "int32", "uint", "uint32", "float", "float32", "double", "float64"}) {
    INFO(type);
    const TriangleMesh mesh = read_mesh(folder.write(
        "a.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty " + type +
                     " shade\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
                     "property list uchar int vertex_indices\nend_header\n"
                     "7 0 0 0\n7 1 0 0\n7 1 1 0\n7 0 1 0\n3 0 1 2\n3 0 2 3\n"));
    CHECK(mesh.positions == unit_square);
    CHECK(mesh.triangles == two_triangles);
  }
}

TEST_CASE("PLY is read in both byte orders", "[mesh][files]") {
  const Folder folder;
  for (const bool big_endian : {false, true}) {
    std::string bytes = std::string("ply\nformat ") +
                        (big_endian ? "binary_big_endian" : "binary_little_endian") + " 1.0\n" + ply_vertices;
    for (Eigen::Index i = 0; i < 12; ++i)
      append(bytes, static_cast<float>(unit_square.data()[i]), big_endian);
    for (Eigen::Index t = 0; t < 2; ++t) {
      append(bytes, std::uint8_t{3});
      for (int c = 0; c < 3; ++c) append(bytes, std::int32_t{two_triangles(t, c)}, big_endian);
    }
    const TriangleMesh mesh = read_mesh(folder.write("a.ply", bytes));
    CHECK(mesh.positions == unit_square);
    CHECK(mesh.triangles == two_triangles);
    bytes.pop_back();
    check_refused(folder.write("cut.ply", bytes), "ends before");
  }
}

TEST_CASE("reading STL merges exactly equal points", "[mesh][files]") {
  const Folder folder;
  std::string text = "solid a sheet\n", bytes = "solid in a binary header as well";
  bytes.resize(80, ' ');
  append(bytes, std::uint32_t{2});
  for (Eigen::Index t = 0; t < 2; ++t) {
    text += "facet normal 0 0 1\nouter loop\n";
    for (int i = 0; i < 3; ++i) append(bytes, 0.0F);
    for (int c = 0; c < 3; ++c) {
      text += "vertex";
      for (int i = 0; i < 3; ++i) {
        const double x = unit_square(two_triangles(t, c), i);
        text += x == 0 && t == 1 ? " -0.0" : " " + std::to_string(x);
        append(bytes, static_cast<float>(x));
      }
      text += "\n";
    }
    text += "endloop\nendfacet\n";
    append(bytes, std::uint16_t{0});
  }
  text += "endsolid\n";
  for (const fs::path& path : {folder.write("text.stl", text), folder.write("binary.stl", bytes)}) {
    const TriangleMesh mesh = read_mesh(path);
    CHECK(mesh.positions == unit_square);
    CHECK(mesh.triangles == two_triangles);
  }
  for (const char first : {'s', 'x'}) {  // a binary header may begin with "solid", too
    bytes[0] = first;
    check_refused(folder.write("cut.stl", bytes.substr(0, bytes.size() - 1)),
                  "2 triangles would need 184 bytes, but the file has 183");
    const TriangleMesh mesh = read_mesh(folder.write("more.stl", bytes + std::string(33, 'm')));
    CHECK(mesh.positions == unit_square);
    CHECK(mesh.triangles == two_triangles);
    check_refused(folder.write("more.stl", bytes + std::string(100, '\0')),
                  "says 2 triangles, but the file has room for 4");
  }
}

TEST_CASE("concave polygons of OFF and PLY keep their area", "[mesh][files]") {
  const Folder folder;
  const std::array<std::string, 4> dart = {"0 0 0\n", "2 1 0\n", "0 2 0\n", "0.5 1 0\n"};
  for (std::size_t first = 0; first < 4; ++first) {
    std::string points, face = "4";
    for (std::size_t c = 0; c < 4; ++c) {
      points += dart[c];
      face += " " + std::to_string((first + c) % 4);
    }
    const std::string ply = "ply\nformat ascii 1.0\n";
    const std::string vertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
    for (const fs::path& path :
         {folder.write("a.off", "OFF\n4 1 0\n" + points + face + "\n"),
          folder.write("a.ply", ply + vertices + faces + "end_header\n" + points + face + "\n"),
          folder.write("b.ply", ply + faces + vertices + "end_header\n" + face + "\n" + points)}) {
      INFO(path << ", first corner " << first);
      const TriangleMesh mesh = read_mesh(path);
      double area = 0;
      for (const auto& t : mesh.triangles.rowwise()) {
        const Vector3 a = mesh.positions.row(t(0)), b = mesh.positions.row(t(1)),
                      c = mesh.positions.row(t(2));
        CHECK((b - a).cross(c - a).z() > 0);
        area += 0.5 * (b - a).cross(c - a).z();
      }
      CHECK(area == 1.5);  // sums of halves and quarters are exact
    }
  }
  const std::string crossed = "0 0 0\n1 1 0\n1 0 0\n0 1 0\n";
  check_refused(folder.write("a.off", "OFF\n4 1 0\n" + crossed + "4 0 1 2 3\n"), "line 7: the face crosses");
  check_refused(folder.write("a.ply",
                             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty "
                             "float y\nproperty float z\nelement face 1\nproperty list uchar int "
                             "vertex_indices\nend_header\n" +
                                 crossed + "4 0 1 2 3\n"),
                "face 0: the face crosses");
}

TEST_CASE("OFF and PLY may have a byte order mark and any line ends", "[mesh][files]") {
  const Folder folder;
  const std::string points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n", faces = "3 0 1 2\n3 0 2 3\n",
                    off = "OFF\n4 2 0\n" + points + faces,
                    ply = "ply\nformat ascii 1.0\n" + ply_vertices + points + faces;
  for (const std::string mark : {"", "\xEF\xBB\xBF"})
    for (const std::string end : {"\n", "\r\n", "\r"})
      for (const auto& [name, text] : {std::pair{"a.off", off}, std::pair{"a.ply", ply}}) {
        std::string bytes = mark;
        for (const char c : text) bytes += c == '\n' ? end : std::string(1, c);
        const TriangleMesh mesh = read_mesh(folder.write(name, bytes));
        CHECK(mesh.positions == unit_square);
        CHECK(mesh.triangles == two_triangles);
      }
  // The lines of the header end with \r alone, and the binary element that follows begins with the byte of
  // \n.
  std::string bytes =
      "ply\rformat binary_little_endian 1.0\relement vertex 3\rproperty uchar shade\rproperty float "
      "x\rproperty float y\rproperty float z\relement face 1\rproperty list uchar int "
      "vertex_indices\rend_header\r";
  for (Eigen::Index v = 0; v < 3; ++v) {
    bytes += '\n';
    for (Eigen::Index i = 0; i < 3; ++i) append(bytes, static_cast<float>(unit_square(v, i)));
  }
  append(bytes, std::uint8_t{3});
  for (std::int32_t c = 0; c < 3; ++c) append(bytes, c);
  CHECK(read_mesh(folder.write("a.ply", bytes)).positions == unit_square.topRows(3));
}

TEST_CASE("a refusal names a remedy that works where no config has a policy", "[mesh][files]") {
  const Folder folder;
  const fs::path path = folder.write("a.obj", obj_vertices + "f 1 2 3\nf 1 2 3\nf 1 3 4\n");
  const std::string text = refusal_of(path).text;
  CHECK(text.find("/mesh/bad_triangles") == text.npos);
  CHECK(text.find("--bad-triangles repair --write NEW.obj") != text.npos);
  write_mesh(folder.path("new.obj"), read_mesh(path, BadTriangles::repair).mesh);
  CHECK(read_mesh(folder.path("new.obj")).triangles == two_triangles);
}

TEST_CASE("a written mesh reads back to the same bits", "[mesh][files]") {
  const Folder folder;
  TriangleMesh mesh = delaunay(1, 0.7, 9, 4);
  mesh.positions.col(2) = mesh.positions.col(0).array().sin() / 3;
  mesh.texture_coordinates = TextureCoordinates::Random(3 * mesh.triangle_count(), 2);
  for (const std::string name : {"a.obj", "a.ply", "a.off"}) {
    write_mesh(folder.path(name), mesh);
    std::vector<std::string> notes;
    const TriangleMesh back = read_mesh(folder.path(name), &notes);
    CHECK(back.positions == mesh.positions);
    CHECK(back.triangles == mesh.triangles);
    CHECK(notes.empty());
    if (name == "a.obj") CHECK(back.texture_coordinates == mesh.texture_coordinates);
  }
  CHECK_THROWS_AS(write_mesh(folder.path("a.stl"), mesh), MeshFileError);
  CHECK_THROWS_AS(write_mesh(folder.path("missing/a.off"), mesh), MeshFileError);
}

TEST_CASE("a mesh that cannot be simulated is refused, and the message names the offenders",
          "[mesh][files]") {
  const Folder folder;
  const std::string off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n",
                    ply = "ply\nformat ascii 1.0\n" + ply_vertices;
  const std::string points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  check_refused(folder.write("a.obj", ""), "no triangles");
  check_refused(folder.write("a.obj", obj_vertices), "no triangles");
  check_refused(folder.write("a.obj", obj_vertices + "f 1 2 9\nf 1 3 4\n"), "triangle 0 (0, 1, 8)");
  check_refused(folder.write("a.obj", "v nan 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"), "vertex 0 (nan, 0, 0)");
  check_refused(folder.write("a.off", off + "3 0 1 2\n3 0 2 4\n"), "triangle 1 (0, 2, 4)");
  check_refused(folder.write("a.off", "OFF 3 1 0\n0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n"), "vertex 1 (1, inf, 0)");
  check_refused(folder.write("a.off", off + "3 0 1 2\n3 0 3 2\n"), "edge 0-2 (triangles 0 and 1)");
  check_refused(folder.write("a.ply", ply + points + "3 0 1 2\n3 0 2 -3\n"), "triangle 1 (0, 2, -3)");
  check_refused(folder.write("a.ply", ply + points + "3 0 1 2\n3 0 2 2\n"), "triangle 1 (0, 2, 2)");

  const Refusal refusal = refusal_of(folder.write("a.off", off + "3 0 1 2\n4 0 1 1 7\n"));
  CHECK(refusal.text.find("index out of range") != std::string::npos);  // all problems at once
  CHECK(refusal.text.find("repeated vertex") != std::string::npos);
}

TEST_CASE("a file that does not follow its format is refused with the line", "[mesh][files]") {
  const Folder folder;
  const std::string off = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n",
                    ply = "ply\nformat ascii 1.0\n" + ply_vertices;
  check_refused(folder.write("a.off", "hello\n"), "line 1: starts with 'hello'");
  check_refused(folder.write("a.off", ""), "ends before its keyword");
  check_refused(folder.write("a.off", "OFF\n-4 1 0\n"), "line 2: a count is -4");
  check_refused(folder.write("a.off", "OFF\n99999999999 1 0\n0 0 0\n"), "ends before vertex 1 of");
  check_refused(folder.write("a.off", off + "3 0 1\n"), "line 7: a face of 3 corners has fewer indices");
  check_refused(folder.write("a.off", off + "3 0 1 1.5\n"), "line 7: '1.5' is not a whole number");
  check_refused(folder.write("a.off", off + "2 0 1\n"), "fewer than 3 corners: it has 2");
  check_refused(folder.write("a.off", "OFF\n1 0 0\n0 zero 0\n"), "line 3: 'zero' is not a number");
  check_refused(folder.write("a.off", "OFF\n1 0 0\n0 \x1b[2J\xff 0\n"),
                "'?[2J?' is not a number");  // escape sequences are masked
  check_refused(folder.write("a.obj", "v 0 0\n"), "line 1: 3 words are too few");
  check_refused(folder.write("a.obj", obj_vertices + "f 1 2\n"), "fewer than 3 corners");
  check_refused(folder.write("a.obj", obj_vertices + "f 0 1 2\n"), "mesh file");
  check_refused(folder.write("a.ply", "ply\nformat ascii 1.0\nend_header\n"),
                "element vertex with property x");
  check_refused(folder.write("a.ply", "ply\nformat runes 1.0\n" + ply_vertices), "'runes'");
  check_refused(folder.write("a.ply", ply + "0 0 0\n"), "ends before its last element");
  check_refused(folder.write("a.ply", ply + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n-3 0 2 2\n"), "-3 values");
  check_refused(folder.write("a.txt", "v 0 0 0\n"), "allowed are .obj, .ply, .off, .stl");
}

TEST_CASE("an unreadable file has another kind of error than a bad mesh", "[mesh][files]") {
  const Folder folder;
  fs::create_directory(folder.path("folder.obj"));
  for (const std::string name : {"missing.obj", "folder.obj"})
    CHECK(refusal_of(folder.path(name)).kind == MeshFileError::Kind::unreadable);
}

TEST_CASE("isolated vertices of a file are left out, with a note", "[mesh][files]") {
  const Folder folder;
  std::vector<std::string> notes;
  const TriangleMesh mesh =
      read_mesh(folder.write("a.obj", "v 9 9 9\n" + obj_vertices + "f 2 3 4 5\n"), &notes);
  CHECK(mesh.positions == unit_square);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("1 vertex in no triangle: vertex 0") != std::string::npos);
}

TEST_CASE("files with changed bytes are either read or refused", "[mesh][files]") {
  const Folder folder;
  const TriangleMesh mesh = disc(1, 2);
  std::mt19937_64 random(1);
  for (const std::string name : {"a.obj", "a.ply", "a.off"}) {
    write_mesh(folder.path(name), mesh);
    std::ifstream file(folder.path(name), std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(file), {});
    for (int trial = 0; trial < 300; ++trial) {
      std::string changed = bytes;
      for (int i = 0; i < 3; ++i) changed[random() % changed.size()] = static_cast<char>(random() % 256);
      try {
        const TriangleMesh read = read_mesh(folder.write("changed" + name.substr(1), changed));
        CHECK(diagnose(read).empty());
      } catch (const MeshFileError&) {
        SUCCEED();
      }
    }
  }
}

}  // namespace bendlab::files_test
