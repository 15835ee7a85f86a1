#include "experiments/export/output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "bendlab/io/disk.hpp"
#include "experiments/export/exported_run.hpp"
#include "experiments/run/errors.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

RunFileError last_error(const fs::path& file) {
  const int code = errno;
  return file_error(file, "can't be written", std::system_category().message(code), code);
}

void require_going_on(const std::atomic<bool>* stop) {
  if (stop && stop->load(std::memory_order_relaxed)) throw ExportStopped{};
}

// "cloth", from the file name "cloth.0012.obj"; "" for a name without number or with another extension.
std::string sequence_of(const std::string& name, const std::string& dotted_extension) {
  if (!name.ends_with(dotted_extension)) return "";
  const std::string stem = name.substr(0, name.size() - dotted_extension.size());
  const std::size_t dot = stem.rfind('.');
  if (dot == std::string::npos || dot + 1 == stem.size()) return "";
  const bool numbered = std::all_of(stem.begin() + static_cast<std::ptrdiff_t>(dot) + 1, stem.end(),
                                    [](char c) { return c >= '0' && c <= '9'; });
  return numbered ? stem.substr(0, dot) : "";
}

}  // namespace

OutputFile::OutputFile(const fs::path& draft, fs::path name, const std::atomic<bool>* stop)
    : name_(std::move(name)),
      stop_(stop),
      descriptor_(::open(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) throw last_error(name_);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::flush() {
  require_going_on(stop_);
  for (std::string_view rest(buffer_.data(), buffer_.size()); !rest.empty();) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw last_error(name_);
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  bytes_ += buffer_.size();
  buffer_.clear();
}

std::uint64_t OutputFile::finish() {
  flush();
  const int descriptor = std::exchange(descriptor_, -1);
  if (::close(descriptor) != 0) throw last_error(name_);
  return bytes_;
}

Output::Output(const Options& options) : options_(options) {
  const fs::path to = fs::absolute(options.to).lexically_normal();
  is_file_ = to.extension() == fmt::format(".{}", options.extension);
  folder_ = is_file_ ? to.parent_path() : to;
  std::error_code error;
  if (is_file_ && fs::is_directory(to))
    throw UsageError(fmt::format("--to {}: is a folder; name a file in it", options.to.string()));
  if (is_file_ && !options.force && fs::exists(fs::symlink_status(to)))
    throw UsageError(fmt::format("--to {}: is there already; --force replaces it", options.to.string()));
  if (!is_file_ && !options.force && fs::is_directory(to) && !fs::is_empty(to, error))
    throw UsageError(
        fmt::format("--to {}: is a folder that is not empty; --force replaces the files of an earlier export "
                    "and keeps all other files. Or name another folder",
                    options.to.string()));
  make_folder();
}

// Makes the folder, the folders above it, and a folder in it for the drafts.
void Output::make_folder() {
  for (fs::path above = folder_; !fs::exists(above) && above.has_relative_path(); above = above.parent_path())
    made_folders_.push_back(above);
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw file_error(folder_, "the folder can't be made", error.message(), error.value());
  drafts_ = folder_ / fmt::format("export.{}.tmp", unique_token());
  fs::create_directory(drafts_, error);
  if (error) throw file_error(folder_, "can't be written", error.message(), error.value());
}

Output::~Output() {
  std::error_code ignored;
  fs::remove_all(drafts_, ignored);
  if (published_) return;
  for (const fs::path& folder : made_folders_) fs::remove(folder, ignored);  // fails if it is not empty
}

fs::path Output::draft(const std::string& name) {
  require_going_on(options_.stop);
  names_.insert(name);
  return drafts_ / name;
}

std::string Output::stem_of(const Surface& surface) const {
  if (!is_file_) return surface.name;
  const std::string stem = options_.to.stem().string();
  return surface.deforms ? stem : stem + "_" + surface.name;
}

std::string Output::stem_of(const Surface& surface, std::int64_t frame) {
  const std::string stem = stem_of(surface);
  if (is_file_ || !surface.moves()) return stem;
  sequences_.insert(stem);
  return fmt::format("{}.{:04}", stem, frame);
}

void Output::remove_old_frames() const {
  std::error_code ignored;
  const std::string extension = fmt::format(".{}", options_.extension);
  for (const auto& entry : fs::directory_iterator(folder_, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!names_.contains(name) && sequences_.contains(sequence_of(name, extension)))
      fs::remove(entry.path(), ignored);
  }
}

void Output::publish() {
  require_going_on(options_.stop);
  if (!options_.force)
    for (const std::string& name : names_)
      if (fs::exists(fs::symlink_status(folder_ / name)))
        throw UsageError(fmt::format("{}: is there already; --force replaces it", (folder_ / name).string()));
  for (const std::string& name : names_) bendlab::publish(drafts_ / name, folder_ / name);
  published_ = true;
  if (options_.force) remove_old_frames();
}

}  // namespace bendlab
