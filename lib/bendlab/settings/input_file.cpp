#include "bendlab/settings/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace bendlab {
namespace {

[[noreturn]] void fail(const std::string& why) {
  throw std::runtime_error(why);
}

std::string reason(int code) {
  switch (code) {
    case ENAMETOOLONG:
      return "has too long a name";
    case ELOOP:
      return "is a link that leads back to itself";
    default:
      return fmt::format("can't be opened: {}", std::system_category().message(code));
  }
}

struct Closed {
  int descriptor;
  ~Closed() { ::close(descriptor); }
};

}  // namespace

std::string read_input_file(const std::filesystem::path& file, std::uint64_t most) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) fail(reason(errno));
  const Closed at_the_end{descriptor};
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) fail(reason(errno));
  if (S_ISDIR(status.st_mode)) fail("is a folder, not a file");
  if (!S_ISREG(status.st_mode)) fail("is a pipe or a device, not a file");
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > most) fail(fmt::format("is too large: it has {} bytes, but at most {} are allowed", size, most));
  std::string bytes(size + 1, '\0');  // one byte more, so that the end is found without resizing
  for (std::size_t at = 0;;) {
    if (at == bytes.size()) bytes.resize(at + (1 << 16));  // system files such as /proc/… report a size of 0
    const ssize_t got = ::read(descriptor, bytes.data() + at, bytes.size() - at);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(fmt::format("can't be read to the end: {}", std::system_category().message(errno)));
    at += static_cast<std::size_t>(got);
    if (got == 0) return bytes.resize(at), bytes;
    if (at > most) fail(fmt::format("is too large: at most {} bytes are allowed", most));
  }
}

}  // namespace bendlab
