// Includes go one way, in the library and above it in the experiments. CGAL stays in the mesh room's sources,
// HDF5 in io.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "tests/catch.hpp"
#include "tests/places.hpp"

namespace {

namespace fs = std::filesystem;

const fs::path library = fs::path(bendlab::places::source) / "lib" / "bendlab",
               experiments = fs::path(bendlab::places::source) / "experiments";

/// Each room and the rooms it may include besides itself.
using Rooms = std::map<std::string, std::set<std::string>>;
const Rooms library_rooms = {
    {"parameters", {}},
    {"mesh", {"parameters"}},
    {"constraints", {"parameters", "mesh"}},
    {"bending", {"parameters", "mesh", "constraints"}},
    {"effects", {"parameters", "mesh", "constraints"}},
    {"solver", {"parameters", "mesh", "constraints"}},
    {"metrics", {"parameters", "mesh"}},
    {"io", {"parameters"}},
    {"scene", {"parameters", "mesh", "constraints", "bending", "effects", "solver", "metrics"}},
};
/// Each sees the library besides.
const Rooms experiment_rooms = {
    {"config", {}},
    {"measures", {"config"}},
    {"run", {"config", "measures"}},
    {"terminal", {}},
    {"campaign", {"config", "measures", "run", "terminal"}},
    {"advise", {"config", "measures", "run", "terminal", "campaign"}},
    {"bench", {"config", "measures", "run", "terminal", "campaign"}},
    {"export", {"config", "measures", "campaign"}},
    {"cli", {"config", "measures", "run", "terminal", "campaign", "advise", "bench", "export"}},
};

/// What the #include lines of a file name.
std::vector<std::string> includes_of(const fs::path& file) {
  static const std::regex pattern(R"(^\s*#\s*include\s*["<]([^">]+)[">])");
  std::vector<std::string> names;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
    if (std::smatch match; std::regex_search(line, match, pattern)) names.push_back(match[1]);
  return names;
}

std::vector<fs::path> sources_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".hpp" || extension == ".cpp" || extension == ".def") files.push_back(entry.path());
  }
  return files;
}

void check_rooms(const Rooms& rooms, const fs::path& folder, const std::string& prefix) {
  std::set<std::string> found, known;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_directory()) found.insert(entry.path().filename().string());
  for (const auto& [room, others] : rooms) known.insert(room);
  CHECK(found == known);
  for (const auto& [room, others] : rooms) {
    const std::vector<fs::path> files = sources_in(folder / room);
    INFO("room " << room);
    REQUIRE_FALSE(files.empty());
    for (const fs::path& file : files)
      for (const std::string& name : includes_of(file)) {
        INFO(file.string() << " includes " << name);
        CHECK_FALSE(name.starts_with("tests/"));
        CHECK_FALSE(name.starts_with(".."));  // would slip past this test
        if (prefix == "bendlab/") CHECK_FALSE(name.starts_with("experiments/"));
        if (!name.starts_with(prefix) || name.ends_with(".def")) continue;  // a list of names is no code
        const std::string other = name.substr(prefix.size(), name.find('/', prefix.size()) - prefix.size());
        CHECK((other == room || others.contains(other)));
      }
  }
}

TEST_CASE("Includes of the library go one way", "[layout]") {
  check_rooms(library_rooms, library, "bendlab/");
}

TEST_CASE("Includes of the experiments go one way", "[layout]") {
  check_rooms(experiment_rooms, experiments, "experiments/");
}

TEST_CASE("CGAL stays in the sources of the mesh room and HDF5 in io", "[layout]") {
  for (const char* folder : {"lib/bendlab", "experiments"}) {
    for (const fs::path& file : sources_in(fs::path(bendlab::places::source) / folder)) {
      for (const std::string& name : includes_of(file)) {
        INFO(file.string() << " includes " << name);
        const bool in_mesh_source = file.extension() == ".cpp" && file.parent_path() == library / "mesh";
        if (name.starts_with("CGAL/")) CHECK(in_mesh_source);
        if (name.starts_with("hdf5") || name.starts_with("H5")) CHECK(file.parent_path() == library / "io");
      }
    }
  }
}

}  // namespace
