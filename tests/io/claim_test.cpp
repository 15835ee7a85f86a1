// A folder has one owner at a time, among threads, processes, and machines that share a disk.
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>
#include <vector>

#include "bendlab/io/claim.hpp"
#include "bendlab/io/disk.hpp"
#include "tests/catch.hpp"
#include "tests/io/run_fixture.hpp"

using namespace bendlab;
using bendlab::test::TemporaryFolder;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

namespace {

// Writes a claim like an owner on another machine. No process here can check whether this owner is alive.
void write_foreign_claim(const fs::path& file, int count) {
  std::ofstream(file) << "token of another machine\nelsewhere\n1\n2\nanother boot\n" << count << '\n';
}

}  // namespace

TEST_CASE("claim: a folder has one owner among many threads", "[io][claim]") {
  const TemporaryFolder folder;
  std::atomic<int> owners{0}, most{0}, claims{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 20; ++i) {
        const auto claim = Claim::of(folder / "");
        most = std::max(most.load(), ++owners);
        ++claims;
        if (!claim->holds()) most = 100;
        --owners;
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(claims == 160);
  CHECK(most == 1);
  CHECK(fs::is_empty(folder / ""));  // released claims leave no files
}

TEST_CASE("claim: a second process waits for the owner, can name it, and may give up", "[io][claim]") {
  const TemporaryFolder folder;
  auto first = Claim::of(folder / "");
  CHECK(owner_of(folder / "") == "process " + std::to_string(getpid()) + " on " + [] {
    char host[256] = "";
    gethostname(host, sizeof host);
    return std::string(host);
  }());
  std::string owner;
  int asked = 0;
  CHECK(Claim::of(folder / "", {.give_up = [&] { return ++asked > 3; },
                                .waiting_for = [&](const std::string& name) { owner += name; }}) == nullptr);
  CHECK(owner == owner_of(folder / ""));
  std::thread later([&] { std::this_thread::sleep_for(50ms), first.reset(); });
  CHECK(Claim::of(folder / "") != nullptr);
  later.join();
  CHECK(owner_of(folder / "").empty());
}

TEST_CASE("claim: if the owner was killed, another process takes over without waiting for the lease", "[io][claim]") {
  const TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    auto claim = Claim::of(folder / "");
    _exit(claim ? 0 : 1);  // without its destructor, like after kill -9
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WEXITSTATUS(status) == 0);
  REQUIRE_FALSE(fs::is_empty(folder / ""));
  CHECK(owner_of(folder / "").empty());
  // A dead owner is not waited for: the claim succeeds before anything is asked.
  const auto claim = Claim::of(folder / "", {.give_up = [] { return true; }});
  REQUIRE(claim);
  CHECK(claim->holds());
}

TEST_CASE("claim: an owner that has ended counts as dead, even as a zombie", "[io][claim]") {
  const TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    auto claim = Claim::of(folder / "");
    static_cast<void>(claim.release());
    _exit(0);
  }
  siginfo_t info{};
  REQUIRE(waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT) ==
          0);  // the child stays a zombie
  CHECK(owner_of(folder / "").empty());
  CHECK(heartbeat_in(folder / "").empty());
  CHECK(Claim::of(folder / "", {.when_owned = WhenOwned::leave}));
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
}

TEST_CASE("claim: with WhenOwned::leave a claimed folder is left to its owner", "[io][claim]") {
  const TemporaryFolder folder, elsewhere;
  auto owner = Claim::of(folder / "");
  CHECK_FALSE(heartbeat_in(folder / "").empty());
  CHECK_FALSE(Claim::of(folder / "", {.when_owned = WhenOwned::leave}));
  CHECK_FALSE(Claim::of(folder / "", {.when_owned = WhenOwned::leave_living}));
  owner.reset();
  CHECK(heartbeat_in(folder / "").empty());
  CHECK(Claim::of(folder / "", {.when_owned = WhenOwned::leave}));

  // Whether an owner on another machine is alive is known only by its heartbeat.
  const fs::path file = elsewhere / "run.claim.1";
  write_foreign_claim(file, 1);
  CHECK_FALSE(Claim::of(elsewhere / "", {.lease = 100ms, .when_owned = WhenOwned::leave}));
  const std::string before = heartbeat_in(elsewhere / "");
  const auto beat = [&] {
    write_foreign_claim(file, 2);
    return false;
  };
  CHECK_FALSE(Claim::of(elsewhere / "", {.lease = 0s, .give_up = beat, .when_owned = WhenOwned::leave_living}));
  CHECK(heartbeat_in(elsewhere / "") != before);
  CHECK(Claim::of(elsewhere / "", {.lease = 100ms, .when_owned = WhenOwned::leave_living}));
}

TEST_CASE(
    "claim: an owner on another machine loses its claim after a lease without heartbeat, but not with one",
    "[io][claim]") {
  const TemporaryFolder folder;
  const fs::path file = folder / "run.claim.7";
  write_foreign_claim(file, 0);
  CHECK(owner_of(folder / "") == "process 1 on elsewhere");
  // The shortest lease: an owner keeps its claim only if its heartbeat has changed at every look.
  int looks = 0;
  CHECK(Claim::of(folder / "", {.lease = 0s, .give_up = [&] {
                                  write_foreign_claim(file, ++looks);
                                  return looks > 5;
                                }}) == nullptr);
  CHECK(looks == 6);
  const auto claim = Claim::of(folder / "", {.lease = 0s});
  REQUIRE(claim);
  CHECK(claim->holds());
  CHECK_FALSE(fs::exists(file));
  write_foreign_claim(folder / "run.claim.9", 0);  // like after a sleep of this machine
  CHECK_FALSE(claim->holds());
}

TEST_CASE("claim: a folder that cannot be written is an error", "[io][claim]") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(Claim::of(folder / "absent"), RunFileError);
}

TEST_CASE("disk: creating a new file never overwrites an existing file or the target of a link", "[io]") {
  const TemporaryFolder folder;
  std::ofstream(folder / "mine") << "kept";
  fs::create_symlink(folder / "mine", folder / "link");
  CHECK_THROWS_AS(write_new(folder / "mine", "new"), RunFileError);
  CHECK_THROWS_AS(write_new(folder / "link", "new"), RunFileError);
  CHECK_FALSE(write_new(folder / "mine", "new", Existing::is_no_error));
  replace_file(folder / "link", "new");
  CHECK_FALSE(fs::is_symlink(folder / "link"));
  std::string text;
  std::getline(std::ifstream(folder / "mine"), text);
  CHECK(text == "kept");
  std::getline(std::ifstream(folder / "link"), text);
  CHECK(text == "new");
  fs::create_symlink(folder / "mine", folder / "run.vtkhdf.part");
  remove_abandoned(folder / "run.vtkhdf.part");
  CHECK(fs::exists(folder / "mine"));
  CHECK_FALSE(fs::exists(fs::symlink_status(folder / "run.vtkhdf.part")));
}
