// A folder has at most one owner: among threads, among processes, after fork(), and after the death of an
// owner.
#include "bendlab/io/folder_lock.hpp"

#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <thread>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "tests/catch.hpp"
#include "tests/io/run_fixture.hpp"

namespace bendlab::folder_lock_test {
using bendlab::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

std::unique_ptr<FolderLock> try_to_lock(const fs::path& folder) {
  return FolderLock::of(folder, {.when_locked = WhenLocked::leave});
}

// A child process that executes `work` and then sleeps until it is killed. The constructor returns when
// `work` is done, the destructor when the child has ended.
class Child {
 public:
  template <class Work>
  explicit Child(const Work& work) {
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    process_ = ::fork();
    if (process_ == 0) {
      work();
      if (::write(ends[1], "", 1) != 1) ::_exit(1);
      for (;;) ::pause();
    }
    char done = 1;
    REQUIRE(::read(ends[0], &done, 1) == 1);
    ::close(ends[0]), ::close(ends[1]);
  }
  ~Child() { end(); }
  void end() {
    if (process_ > 0) ::kill(process_, SIGKILL), ::waitpid(process_, nullptr, 0);
    process_ = 0;
  }

 private:
  pid_t process_ = 0;
};

}  // namespace

TEST_CASE("lock: a folder has one owner among many threads", "[io][lock]") {
  const TemporaryFolder folder;
  std::atomic<int> owners{0}, most{0}, locks{0}, lost{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 20; ++i) {
        const auto lock = FolderLock::of(folder / "");
        most = std::max(most.load(), ++owners);
        ++locks;
        if (!lock->holds()) ++lost;
        --owners;
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(locks == 160);
  CHECK(most == 1);
  CHECK(lost == 0);
  CHECK_FALSE(is_locked(folder / ""));
}

TEST_CASE("lock: a second owner waits, or gives up, or leaves the folder at once", "[io][lock]") {
  const TemporaryFolder folder;
  CHECK_FALSE(is_locked(folder / ""));
  auto first = FolderLock::of(folder / "");
  CHECK(is_locked(folder / ""));
  CHECK_FALSE(try_to_lock(folder / ""));
  int asked = 0;
  std::atomic<int> announced{0};
  CHECK_FALSE(
      FolderLock::of(folder / "", {.give_up = [&] { return ++asked > 3; }, .waiting = [&] { ++announced; }}));
  CHECK(announced == 1);
  std::thread later([&] {
    while (announced < 2) std::this_thread::yield();
    first.reset();
  });
  CHECK(FolderLock::of(folder / "", {.waiting = [&] { ++announced; }}));
  later.join();
  CHECK_FALSE(is_locked(folder / ""));
}

TEST_CASE("lock: if the owner is killed, the folder is free", "[io][lock]") {
  const TemporaryFolder folder;
  Child owner([&] { static_cast<void>(FolderLock::of(folder / "").release()); });
  CHECK(is_locked(folder / ""));
  CHECK_FALSE(try_to_lock(folder / ""));
  owner.end();
  CHECK_FALSE(is_locked(folder / ""));
  CHECK(try_to_lock(folder / ""));
}

TEST_CASE("lock: a child process of fork() has no part in the lock of its parent", "[io][lock]") {
  const TemporaryFolder folder, other;
  auto lock = FolderLock::of(folder / "");

  SECTION("the parent can release the lock while the child lives") {
    const Child child([] {});
    lock.reset();
    CHECK(try_to_lock(folder / ""));
  }
  SECTION("the child does not release the lock, even if it destroys its copy of the object") {
    // The child's own lock may have the descriptor number that the parent's lock has.
    std::unique_ptr<FolderLock> own;
    const Child child([&] {
      own = FolderLock::of(other / "");
      if (lock->holds() || try_to_lock(folder / "")) ::_exit(1);
      lock.reset();
      if (!own->holds()) ::_exit(1);
    });
    CHECK(lock->holds());
    CHECK(is_locked(folder / ""));
    CHECK(is_locked(other / ""));
    CHECK_FALSE(try_to_lock(other / ""));
  }
  SECTION("if the parent is killed, the lock does not live on in the child") {
    lock.reset();
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    pid_t grandchild = 0;
    Child owner([&] {
      static_cast<void>(FolderLock::of(folder / "").release());
      grandchild = ::fork();
      if (grandchild == 0)
        for (;;) ::pause();
      if (::write(ends[1], &grandchild, sizeof grandchild) != sizeof grandchild) ::_exit(1);
    });
    REQUIRE(::read(ends[0], &grandchild, sizeof grandchild) == sizeof grandchild);
    CHECK(is_locked(folder / ""));
    owner.end();
    // The grandchild closes its copy at its start, so the lock may live until the scheduler has started it.
    CHECK(FolderLock::of(folder / ""));
    CHECK(::kill(grandchild, 0) == 0);  // it lives
    ::kill(grandchild, SIGKILL);
    ::close(ends[0]), ::close(ends[1]);
  }
}

TEST_CASE("lock: an owner notices that its lock file was removed", "[io][lock]") {
  const TemporaryFolder folder;
  const auto lock = FolderLock::of(folder / "");
  CHECK(lock->holds());
  fs::remove(folder / "run.lock");
  CHECK_FALSE(lock->holds());
  std::ofstream(folder / "run.lock");
  CHECK_FALSE(lock->holds());
}

TEST_CASE("lock: no folder, a link instead of the file, and a pipe", "[io][lock]") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(FolderLock::of(folder / "absent"), RunFileError);
  CHECK_FALSE(is_locked(folder / "absent"));
  fs::create_symlink(folder / "elsewhere", folder / "run.lock");
  CHECK_THROWS_AS(FolderLock::of(folder / ""), RunFileError);
  CHECK_FALSE(fs::exists(folder / "elsewhere"));
  fs::remove(folder / "run.lock");
  REQUIRE(::mkfifo((folder / "run.lock").c_str(), 0600) == 0);
  CHECK_FALSE(is_locked(folder / ""));  // without waiting for a writer of the pipe
}

}  // namespace bendlab::folder_lock_test
