#include "bendlab/io/claim.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <condition_variable>
#include <fstream>
#include <map>
#include <mutex>
#include <random>
#include <sstream>
#include <thread>
#include <vector>

#include "bendlab/io/disk.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::string_view prefix = "run.claim.";
constexpr auto beat = 5s;  // between two heartbeats, much shorter than a lease

std::string first_line(const fs::path& file) {
  std::string line;
  std::ifstream stream(file);
  std::getline(stream, line);
  return line;
}

std::string host() {
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  return name;
}

// When a process began, in clock ticks since the machine was started. "" if the process does not exist or has
// ended; an ended process may be listed until its parent has waited for it. The number of an ended process is
// used again, but the new process has another beginning.
std::string beginning_of(long process) {
  const std::string line = first_line(fmt::format("/proc/{}/stat", process));
  const std::size_t end_of_name = line.rfind(')');
  if (end_of_name == std::string::npos) return "";
  std::istringstream fields(line.substr(end_of_name + 1));
  std::string state, field;
  fields >> state;
  if (state == "Z" || state == "X") return "";
  constexpr int beginning = 22, before = 3;  // proc(5): name and state are fields 2 and 3
  for (int i = before; i < beginning && fields >> field; ++i) {
  }
  return field;
}

std::string namespace_of_processes() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/ns/pid", ignored).string();
}

// Identifies this container and this start of the machine: numbers of processes are valid only there.
const std::string& where_processes_are_known() {
  static const std::string here =
      first_line("/proc/sys/kernel/random/boot_id") + " " + namespace_of_processes();
  return here;
}

// The content of a claim's file.
struct Owner {
  std::string token, host, place, beginning;
  long process = 0;
  std::string count;  // number of heartbeats

  static Owner self(std::string token) {
    return {std::move(token),       bendlab::host(), where_processes_are_known(),
            beginning_of(getpid()), getpid(),        "0"};
  }
  std::string text(std::uint64_t beats) const {
    return fmt::format("{}\n{}\n{}\n{}\n{}\n{:020}\n", token, host, process, beginning, place, beats);
  }
  // Empty if the file does not exist, for example because it was deleted.
  static Owner read(const fs::path& file) {
    Owner owner;
    std::ifstream stream(file);
    std::string process;
    std::getline(stream, owner.token) && std::getline(stream, owner.host) && std::getline(stream, process) &&
        std::getline(stream, owner.beginning) && std::getline(stream, owner.place) &&
        std::getline(stream, owner.count);
    std::from_chars(process.data(), process.data() + process.size(), owner.process);
    return owner;
  }
  bool is_known_here() const { return !place.empty() && place == where_processes_are_known(); }
  bool is_dead() const {
    return is_known_here() && (beginning.empty() || beginning_of(process) != beginning);
  }
  std::string name() const { return fmt::format("process {} on {}", process, host); }
};

// n for the name run.claim.<n>, and 0 for other names.
int number_of(const std::string& name) {
  int number = 0;
  if (!name.starts_with(prefix)) return 0;
  const char *const first = name.data() + prefix.size(), *const last = name.data() + name.size();
  const auto [end, error] = std::from_chars(first, last, number);
  return error == std::errc() && end == last ? number : 0;
}

std::vector<int> numbers_in(const fs::path& folder) {
  std::vector<int> numbers;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (const int number = number_of(entry->path().filename().string()); number > 0)
      numbers.push_back(number);
  std::ranges::sort(numbers);
  return numbers;
}

int highest_in(const fs::path& folder) {
  const std::vector<int> numbers = numbers_in(folder);
  return numbers.empty() ? 0 : numbers.back();
}

fs::path claim_file(const fs::path& folder, int number) {
  return folder / fmt::format("{}{}", prefix, number);
}

// Makes the file if it does not exist. Returns whether this call made the file. No process can read a part of
// the text: a draft is written first and then linked to the file's name, if the file system has links.
bool make(const fs::path& file, const std::string& text, const std::string& token) {
  const fs::path draft = file.parent_path() / ("run.claim-" + token);
  write_new(draft, text);
  const int linked = ::link(draft.c_str(), file.c_str()), code = errno;
  struct stat status {};
  // The answer of a network file system may not arrive. So the number of links tells if the link was made.
  const bool made = linked == 0 || (::stat(draft.c_str(), &status) == 0 && status.st_nlink == 2);
  ::unlink(draft.c_str());
  if (made || code == EEXIST) return made;
  if (code != EPERM && code != ENOTSUP && code != ENOSYS && code != EMLINK)
    throw file_error(file, "can't be made", std::system_category().message(code), code);
  return write_new(file, text, Existing::is_no_error);
}

// Writes the heartbeats of all claims of this process.
class Heart {
 public:
  static Heart& of_this_process() {
    static Heart heart;
    return heart;
  }
  void begin(const fs::path& file, const Owner& owner) {
    const std::lock_guard lock(mutex_);
    claims_.insert_or_assign(file, owner);
    if (!thread_.joinable()) thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }
  void end(const fs::path& file) {
    const std::lock_guard lock(mutex_);
    claims_.erase(file);
  }
  ~Heart() {
    thread_.request_stop();
    woken_.notify_all();
  }

 private:
  void run(const std::stop_token& stop) {
    for (std::uint64_t beats = 1; !stop.stop_requested(); ++beats) {
      std::unique_lock lock(mutex_);
      if (woken_.wait_for(lock, stop, beat, [] { return false; }); stop.stop_requested()) return;
      for (const auto& [file, owner] : claims_)
        if (Owner::read(file).token == owner.token) overwrite(file, owner.text(beats));
    }
  }

  std::mutex mutex_;
  std::condition_variable_any woken_;
  std::map<fs::path, Owner> claims_;
  std::jthread thread_;
};

// Watches the owner of a folder. An owner on another machine loses the folder if its count does not grow.
class Watch {
 public:
  explicit Watch(std::chrono::duration<double> lease) : lease_(lease) {}

  bool is_over(const Owner& owner) {
    if (owner.is_dead()) return true;
    if (owner.is_known_here() && !owner.token.empty()) return false;  // the owner's process lives
    if (owner.token != token_ || owner.count != count_) {
      has_beaten_ = owner.token == token_;
      token_ = owner.token, count_ = owner.count, since_ = Clock::now();
      return false;
    }
    return Clock::now() - since_ > lease_;
  }
  // Whether the owner surely lives. Call this function only after is_over() has returned false.
  bool lives(const Owner& owner) const {
    return !owner.token.empty() && (owner.is_known_here() || has_beaten_);
  }

 private:
  std::chrono::duration<double> lease_;
  std::string token_ = "none", count_;
  Clock::time_point since_ = Clock::now();
  bool has_beaten_ = false;
};

}  // namespace

std::string unique_token() {
  static const std::uint64_t random = [] {
    std::random_device device;
    return (std::uint64_t{device()} << 32) | device();
  }();
  static std::atomic<std::uint64_t> count{0};
  std::string name = host().substr(0, 40);
  std::ranges::replace_if(
      name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return fmt::format("{}-{}-{:016x}-{}", name, getpid(), random, count++);
}

std::unique_ptr<Claim> Claim::of(const fs::path& folder, const Options& options) {
  Owner self = Owner::self(unique_token());
  Watch watch(options.lease);
  auto pause = 1ms;
  for (bool announced = false;;) {
    const std::vector<int> numbers = numbers_in(folder);
    const int last = numbers.empty() ? 0 : numbers.back();
    const Owner owner = last > 0 ? Owner::read(claim_file(folder, last)) : Owner{};
    if (last == 0 || watch.is_over(owner)) {
      const fs::path file = claim_file(folder, last + 1);
      if (make(file, self.text(0), self.token)) {
        // `numbers` may be out of date. The folder belongs to the process that made the highest number.
        if (highest_in(folder) <= last + 1) {
          for (const int number : numbers) ::unlink(claim_file(folder, number).c_str());
          Heart::of_this_process().begin(file, self);
          return std::unique_ptr<Claim>(new Claim(file, self.token));
        }
        ::unlink(file.c_str());
      }
      continue;
    }
    if (options.give_up && options.give_up()) return nullptr;
    if (options.when_owned == WhenOwned::leave ||
        (options.when_owned == WhenOwned::leave_living && watch.lives(owner)))
      return nullptr;
    if (!announced && options.waiting_for && !owner.token.empty())
      options.waiting_for(owner.name()), announced = true;
    std::this_thread::sleep_for(pause);
    pause = std::min(pause * 2, std::chrono::milliseconds(250));
  }
}

Claim::Claim(fs::path file, std::string token) : file_(std::move(file)), token_(std::move(token)) {}

Claim::~Claim() {
  Heart::of_this_process().end(file_);
  if (Owner::read(file_).token == token_) ::unlink(file_.c_str());
}

bool Claim::holds() const {
  return Owner::read(file_).token == token_ &&
         highest_in(file_.parent_path()) <= number_of(file_.filename().string());
}

namespace {

Owner living_owner_of(const fs::path& folder) {
  const int number = highest_in(folder);
  Owner owner = number > 0 ? Owner::read(claim_file(folder, number)) : Owner{};
  return owner.token.empty() || owner.is_dead() ? Owner{} : owner;
}

}  // namespace

std::string heartbeat_in(const fs::path& folder) {
  const Owner owner = living_owner_of(folder);
  return owner.token.empty() ? "" : owner.token + " " + owner.count;
}

std::string owner_of(const fs::path& folder) {
  const Owner owner = living_owner_of(folder);
  return owner.token.empty() ? "" : owner.name();
}

}  // namespace bendlab
