// A room (a folder of sources) includes only the rooms below it, both in the library and in the experiments
// above the library. Only sources of the mesh room include CGAL, and only io includes HDF5.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/catch.hpp"
#include "tests/places.hpp"

namespace bendlab::include_direction_test {
namespace {

namespace fs = std::filesystem;

const fs::path library = fs::path(bendlab::places::source) / "lib" / "bendlab",
               experiments = fs::path(bendlab::places::source) / "experiments";

/// Each room, and the rooms that it may include besides itself.
using Rooms = std::map<std::string, std::set<std::string>>;
const Rooms library_rooms = {
    {"settings", {}},
    {"mesh", {"settings"}},
    {"constraints", {"settings", "mesh"}},
    {"bending", {"settings", "mesh", "constraints"}},
    {"effects", {"settings", "mesh", "constraints"}},
    {"solver", {"settings", "mesh", "constraints"}},
    {"metrics", {"settings", "mesh"}},
    {"io", {"settings"}},
    {"scene", {"settings", "mesh", "constraints", "bending", "effects", "solver", "metrics"}},
};
/// In the order of experiments/README.md. Every room may include the library, too.
const std::vector<std::pair<std::string, std::set<std::string>>> experiment_rooms = {
    {"config", {}},
    {"measures", {"config"}},
    {"run", {"config", "measures"}},
    {"terminal", {}},
    {"campaign", {"config", "measures", "run", "terminal"}},
    {"export", {"config", "measures", "run"}},
    {"advise", {"config", "measures", "run", "terminal", "campaign"}},
    {"bench", {"config", "measures", "run", "terminal", "campaign"}},
    {"dialects", {}},
    {"fit", {"config"}},
    {"cli",
     {"config", "measures", "run", "terminal", "campaign", "export", "advise", "bench", "dialects", "fit"}},
};

/// The names in the #include lines of a file.
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
  std::set<std::string> folders, known;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_directory() && entry.path().filename() != "__pycache__")
      folders.insert(entry.path().filename().string());
  for (const auto& [room, allowed] : rooms) known.insert(room);
  CHECK(folders == known);
  for (const auto& [room, allowed] : rooms) {
    const std::vector<fs::path> files = sources_in(folder / room);
    INFO("room " << room);
    REQUIRE_FALSE(files.empty());
    for (const fs::path& file : files)
      for (const std::string& name : includes_of(file)) {
        INFO(file.string() << " includes " << name);
        CHECK_FALSE(name.starts_with("tests/"));
        CHECK_FALSE(name.starts_with(".."));  // such a path would escape the checks below
        if (prefix == "bendlab/") CHECK_FALSE(name.starts_with("experiments/"));
        if (!name.starts_with(prefix)) continue;
        const std::string other = name.substr(prefix.size(), name.find('/', prefix.size()) - prefix.size());
        CHECK((other == room || allowed.contains(other)));
      }
  }
}

TEST_CASE("Rooms of the library include only rooms below them", "[layout]") {
  check_rooms(library_rooms, library, "bendlab/");
}

/// The rooms that the table "Where a thing is" lists, in its order.
std::vector<std::string> rooms_of_readme() {
  static const std::regex row(R"(^\| `(\w+)` \|)");
  std::vector<std::string> names;
  std::ifstream stream(experiments / "README.md");
  for (std::string line; std::getline(stream, line) && !line.starts_with("## Commands");)
    if (std::smatch match; std::regex_search(line, match, row)) names.push_back(match[1]);
  return names;
}

TEST_CASE("Rooms of the experiments include only rooms below them, in the order of their README",
          "[layout]") {
  check_rooms({experiment_rooms.begin(), experiment_rooms.end()}, experiments, "experiments/");
  std::vector<std::string> above;
  for (const auto& [room, allowed] : experiment_rooms) {
    INFO("room " << room);
    for (const std::string& other : allowed) CHECK(std::ranges::count(above, other) == 1);
    above.push_back(room);
  }
  CHECK(above == rooms_of_readme());
}

/// For each file of a room: the files of the same room that it includes. Names have no extension, so a header
/// and its source count as one file.
using Graph = std::map<std::string, std::set<std::string>>;
Graph includes_within(const fs::path& folder) {
  Graph graph;
  for (const fs::path& file : sources_in(folder)) {
    std::set<std::string>& included = graph[file.stem().string()];
    for (const fs::path name : includes_of(file))
      if (name.parent_path().filename() == folder.filename() && name.stem() != file.stem())
        included.insert(name.stem().string());
  }
  return graph;
}

TEST_CASE("Includes within a room of the experiments form no circle", "[layout]") {
  for (const auto& [room, allowed] : experiment_rooms) {
    if (room == "advise") continue;  // its answer and the reasons for the answer include each other
    Graph graph = includes_within(experiments / room);
    const auto is_leaf = [&](const auto& file) {
      return std::ranges::none_of(file.second, [&](const std::string& name) { return graph.contains(name); });
    };
    while (std::erase_if(graph, is_leaf) > 0) {
    }
    std::string circle;
    for (const auto& [file, included] : graph) circle += file + " ";
    INFO("room " << room << ", files in circles or above them: " << circle);
    CHECK(graph.empty());
  }
}

TEST_CASE("Only sources of the mesh room include CGAL, and only io includes HDF5", "[layout]") {
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

}  // namespace bendlab::include_direction_test
