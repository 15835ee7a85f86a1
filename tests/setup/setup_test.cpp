// The start script runs in a copy of the checkout. Stand-ins for dpkg, apt-get, sudo, cmake and ctest record
// how they were called. The tests check when the script installs, builds and runs, from any folder and in a
// path with spaces.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/catch.hpp"
#include "tests/places.hpp"

namespace bendlab::setup_test {
namespace {

namespace fs = std::filesystem;
using Catch::Matchers::ContainsSubstring;

const fs::path source = bendlab::places::source;

std::string read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A checkout that contains only the script, and a folder of stand-ins that comes first on PATH.
class Checkout {
 public:
  Checkout() {
    fs::remove_all(root_);
    fs::create_directories(root_ / "check out");
    fs::create_directories(root_ / "elsewhere");
    fs::create_directories(root_ / "bin");
    fs::copy_file(source / "bendlab", root_ / "check out" / "bendlab");
    stand_in("dpkg-query", "shift 3; for p; do [ \"$p\" = \"${ABSENT-}\" ] || echo \"installed $p\"; done");
    stand_in("apt-get", "note \"apt-get $*\"");
    stand_in("sudo", "note \"sudo $*\"; [ \"$1\" = -n ] && shift; \"$@\"");
    stand_in("id", "echo ${USER_ID-0}");
    stand_in("ctest", "note \"ctest $* in $PWD\"; echo '100% tests passed'");
    // Configuring creates a cache. Building creates a program that prints its arguments and its folder.
    stand_in("cmake", R"(note "cmake $*"
if [ "$1" = --preset ]; then
  mkdir -p build/release/bin; touch build/release/build.ninja
  echo "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" >build/release/CMakeCache.txt
else
  [ -z "${BROKEN-}" ] || { echo 'error: no such type'; exit 1; }
  printf '#!/bin/sh\necho "program: $* in $PWD"\n' >"$2/bin/bendlab"; chmod +x "$2/bin/bendlab"
fi)");
  }
  ~Checkout() { fs::remove_all(root_); }

  /// Runs the script from another folder, without terminal and input. `settings` are VARIABLE=value for the
  /// stand-ins.
  int run(const std::string& arguments, const std::string& settings = "") {
    fs::remove(root_ / "calls");
    const std::string command = "cd '" + (root_ / "elsewhere").string() +
                                "' && unset BENDLAB_PRESET && PATH='" + (root_ / "bin").string() +
                                "':$PATH CI=true " + settings + " ../'check out'/bendlab " + arguments +
                                " </dev/null >../out 2>../err";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  fs::path folder(const char* name) const { return fs::canonical(root_ / name); }
  std::string out() const { return read(root_ / "out"); }
  std::string err() const { return read(root_ / "err"); }
  std::string calls() const { return read(root_ / "calls"); }

 private:
  void stand_in(const std::string& name, const std::string& body) {
    const fs::path file = root_ / "bin" / name;
    std::ofstream(file) << "#!/bin/bash\nnote() { echo \"$1\" >>'" << (root_ / "calls").string() << "'; }\n"
                        << body << "\n";
    fs::permissions(file, fs::perms::owner_all);
  }

  fs::path root_ = fs::temp_directory_path() / ("bendlab set-up test " + std::to_string(getpid()));
};

TEST_CASE("With all packages installed, the start script builds and runs without the network", "[setup]") {
  Checkout checkout;
  REQUIRE(checkout.run("run 'a b.json' --jobs 2") == 0);
  CHECK(checkout.out() ==
        "program: run a b.json --jobs 2 in " + checkout.folder("elsewhere").string() + "\n");
  CHECK_THAT(checkout.calls(), !ContainsSubstring("apt-get"));
  CHECK_THAT(checkout.calls(), ContainsSubstring("cmake --preset release\n"));
  CHECK_THAT(checkout.calls(), ContainsSubstring("--target bendlab_program"));

  SECTION("the second time the script only builds") {
    REQUIRE(checkout.run("list") == 0);
    CHECK_THAT(checkout.calls(), !ContainsSubstring("--preset"));
    CHECK(checkout.err().empty());
  }
  SECTION("a checkout that was moved is configured again") {
    std::ofstream(checkout.folder("check out") / "build/release/CMakeCache.txt")
        << "CMAKE_HOME_DIRECTORY:INTERNAL=/elsewhere\n";
    REQUIRE(checkout.run("list") == 0);
    CHECK_THAT(checkout.calls(), ContainsSubstring("cmake --preset release --fresh"));
  }
}

TEST_CASE("The start script installs missing packages and nothing else", "[setup]") {
  Checkout checkout;
  SECTION("as root") {
    REQUIRE(checkout.run("list", "ABSENT=libcgal-dev") == 0);
    CHECK_THAT(checkout.err(), ContainsSubstring("missing packages: libcgal-dev\n"));
    CHECK_THAT(checkout.calls(),
               ContainsSubstring("apt-get update\n"
                                 "apt-get install -y --no-install-recommends libcgal-dev\n"));
    CHECK_THAT(checkout.calls(), !ContainsSubstring("sudo"));
  }
  SECTION("as another user, with sudo that must not ask for a password without a terminal") {
    REQUIRE(checkout.run("list", "ABSENT=ninja-build USER_ID=1000") == 0);
    CHECK_THAT(checkout.calls(),
               ContainsSubstring("sudo -n env DEBIAN_FRONTEND=noninteractive apt-get install"));
  }
}

TEST_CASE("If the build fails, its output is shown and nothing is run", "[setup]") {
  Checkout checkout;
  CHECK(checkout.run("list", "BROKEN=1") == 1);
  CHECK_THAT(checkout.err(), ContainsSubstring("error: no such type"));
  CHECK(checkout.out().empty());
}

TEST_CASE("The test command ends with ctest's own summary", "[setup]") {
  Checkout checkout;
  REQUIRE(checkout.run("test -R colour") == 0);
  CHECK(checkout.out() == "100% tests passed\n");
  CHECK_THAT(checkout.calls(), ContainsSubstring("ctest --preset release -R colour in " +
                                                 checkout.folder("check out").string()));
  // Everything is built; the first target only tells how long this takes.
  CHECK_THAT(checkout.calls(), ContainsSubstring("--target bendlab_settings\n") &&
                                   !ContainsSubstring("--target bendlab_program"));
}

TEST_CASE("The list of packages is in a single file", "[setup]") {
  CHECK_THAT(read(source / "bendlab"), ContainsSubstring("libcgal-dev"));
  for (const char* other : {"README.md", ".ci/run", "CMakeLists.txt", "experiments/CMakeLists.txt"}) {
    INFO(other);
    REQUIRE(fs::exists(source / other));
    CHECK_THAT(read(source / other), !ContainsSubstring("libcgal-dev"));
  }
}

TEST_CASE("The Python of the tests has the modules that the scripts import", "[setup]") {
  CHECK(std::system(
            ("'" + std::string(bendlab::places::python) + "' -c 'import numpy, h5py, matplotlib'").c_str()) ==
        0);
}

}  // namespace

}  // namespace bendlab::setup_test
