#include "bendlab/io/hdf5_handles.hpp"

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <new>
#include <system_error>

namespace bendlab::hdf5 {
namespace {

std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

Handle simple_space(std::span<const hsize_t> shape, const hsize_t* limits = nullptr) {
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), limits), H5Sclose};
}

// HDF5 1.10 crashes if it cannot allocate the cache of a file, which takes more than half a megabyte.
void require_memory_of_cache() {
  constexpr std::size_t bytes = 4 << 20;
  void* const volatile memory = std::malloc(bytes);  // volatile: the compiler must not remove malloc
  if (memory == nullptr) throw std::bad_alloc();
  std::free(memory);
}

Handle file_access() {
  require_memory_of_cache();
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // While a process writes a file, a lock prevents other processes from opening it. Locking is optional,
  // because some file systems have no locks.
  check(H5Pset_file_locking(access, true, true));
  return access;
}

int descriptor_of(hid_t file) {
  void* descriptor = nullptr;
  check(H5Fget_vfd_handle(file, H5P_DEFAULT, &descriptor));
  return *static_cast<int*>(descriptor);
}

Failure system_failure(int code) {
  return Failure(std::system_category().message(code), code);
}

/// Property list for creating datasets. Datasets have no time stamps, so that equal runs give equal bytes.
Handle dataset_creation() {
  Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  check(H5Pset_obj_track_times(creation, false));
  return creation;
}

bool is_small = false;  // within a SmallScope; the Lock guards it

/// Property list for creating groups and the root group. All links and attributes are in the group's own
/// header, because a separate index would take more space than a run of four frames. The header gets space
/// for `links` links from the start.
Handle group_creation(hid_t kind, unsigned links) {
  constexpr unsigned most = 10000, letters = 9;  // in a usual name
  Handle creation(H5Pcreate(kind), H5Pclose);
  check(H5Pset_est_link_info(creation, links, letters));
  check(H5Pset_link_phase_change(creation, most, most));
  check(H5Pset_attr_phase_change(creation, most, most));
  check(H5Pset_obj_track_times(creation, false));  // equal runs give equal bytes
  return creation;
}

/// Datasets that are created in this scope have the format of HDF5 1.10. The chunk index of this format is an
/// extensible array, whose entries are never moved. The default index is a B-tree, whose nodes split every 32
/// chunks. If a process is killed after it has written only one half of a node, a dataset becomes unreadable
/// (in 13 of 1500 kills of a run that only writes). The superblock has an old version, because HDF5 does not
/// open a file of the newest version after a crash.
class ExtensibleArrayScope {
 public:
  explicit ExtensibleArrayScope(hid_t object) : file_(H5Iget_file_id(object), H5Fclose) {
    check(H5Fset_libver_bounds(file_, H5F_LIBVER_V110, H5F_LIBVER_LATEST));
  }
  ExtensibleArrayScope(const ExtensibleArrayScope&) = delete;
  ExtensibleArrayScope& operator=(const ExtensibleArrayScope&) = delete;
  ~ExtensibleArrayScope() { H5Fset_libver_bounds(file_, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST); }

 private:
  Handle file_;
};

void write_attribute(hid_t object, const std::string& name, hid_t type, hid_t space, const void* value) {
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(H5Awrite(attribute, type, value));
}

}  // namespace

Lock::Lock() : guard_(library_mutex()) {
  // Handles close the files. On a full disk closing fails. The library would try to close the file again at
  // the end of the process, and crash.
  [[maybe_unused]] static const herr_t once = H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Failure last_failure() {
  struct Cause {
    std::string text;
    int code = 0;
  } cause;
  // Goes from the innermost call that failed to the outermost call. If a text contains an errno, this errno
  // is the cause; otherwise the first text is the cause.
  const auto visit = [](unsigned, const H5E_error2_t* error, void* out) -> herr_t {
    auto& recorded = *static_cast<Cause*>(out);
    const std::string text = error->desc ? error->desc : "";
    if (recorded.text.empty()) recorded.text = text;
    const std::string key = "errno = ";
    if (const auto at = text.find(key); at != std::string::npos && recorded.code == 0)
      recorded.code = std::atoi(text.c_str() + at + key.size());
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, visit, &cause);
  H5Eclear2(H5E_DEFAULT);
  if (cause.code != 0) return system_failure(cause.code);
  return Failure(cause.text.empty() ? "the HDF5 library gives no reason" : "HDF5: " + cause.text);
}

Handle create_file(const std::string& path) {
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  // Every small piece of metadata lies within one memory page. If it were on two pages, a process that is
  // killed during a write could write only the first page, and the checksum of the piece would be wrong.
  check(H5Pset_file_space_strategy(creation, H5F_FSPACE_STRATEGY_PAGE, false, 1));
  check(H5Pset_file_space_page_size(creation, 4096));
  return {H5Fcreate(path.c_str(), H5F_ACC_EXCL, creation, file_access()), H5Fclose};
}

Handle create_small_file(const std::string& path) {
  require_memory_of_cache();
  constexpr std::size_t growth = 1 << 16;  // bytes
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  check(H5Pset_fapl_core(access, growth, true));
  check(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST));
  // Every piece of data takes exactly its own size, instead of a part of a larger block.
  check(H5Pset_meta_block_size(access, 0));
  check(H5Pset_small_data_block_size(access, 0));
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_EXCL, group_creation(H5P_FILE_CREATE, 4), access), H5Fclose);
  // Since HDF5 1.10, a dataset of one chunk needs no index. The superblock still has the version of HDF5 1.8.
  check(H5Fset_libver_bounds(file, H5F_LIBVER_V110, H5F_LIBVER_LATEST));
  return file;
}

SmallScope::SmallScope() {
  is_small = true;
}

SmallScope::~SmallScope() {
  is_small = false;
}

Handle open_file(const std::string& path, unsigned access) {
  return {H5Fopen(path.c_str(), access, file_access()), H5Fclose};
}

bool ends_before_its_bytes(hid_t file) {
  haddr_t stated = 0;
  struct stat status {};
  check(H5Fget_eoa(file, &stated));
  return fstat(descriptor_of(file), &status) == 0 && stated < static_cast<haddr_t>(status.st_size);
}

Handle open_with_all_bytes(const std::string& path) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  const auto failed = [&](int code) {
    const char* const named = std::getenv("TMPDIR");
    return Failure(
        fmt::format("the file can't be copied to {}, the folder for temporary files (set by TMPDIR): {}",
                    named ? named : folder.c_str(), system_failure(code).what()));
  };
  if (error) throw failed(error.value());
  std::string copy = (folder / "bendlab-XXXXXX").string();
  const int descriptor = mkstemp(copy.data());
  if (descriptor < 0) throw failed(errno);
  close(descriptor);
  struct Removed {
    const std::string& file;
    ~Removed() { unlink(file.c_str()); }
  } const removed{copy};
  std::filesystem::copy_file(path, copy, std::filesystem::copy_options::overwrite_existing, error);
  if (error) throw failed(error.value());
  // The copy has the permissions of the original, which may be read-only.
  if (chmod(copy.c_str(), S_IRUSR | S_IWUSR) != 0) throw failed(errno);
  Handle file(H5Fopen(copy.c_str(), H5F_ACC_RDWR, file_access()), H5Fclose);
  check(H5Fincrement_filesize(file, 0));  // sets the stated end to the end of the bytes
  return file;
}

void require_room(hid_t file, std::uint64_t bytes) {
  hsize_t end = 0;
  check(H5Fget_filesize(file, &end));
  struct statvfs disk {};
  rlimit limit{};
  if (fstatvfs(descriptor_of(file), &disk) == 0 && disk.f_bavail * disk.f_frsize < 8 * bytes)
    throw system_failure(ENOSPC);
  if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur < end + bytes) throw system_failure(EFBIG);
}

void flush(hid_t file) {
  // HDF5 does not open a file that ends before the end in its superblock. So the file is made longer first.
  hsize_t end = 0;
  struct stat status {};
  check(H5Fget_filesize(file, &end));
  const int descriptor = descriptor_of(file);
  if (fstat(descriptor, &status) == 0 && static_cast<hsize_t>(status.st_size) < end &&
      ftruncate(descriptor, static_cast<off_t>(end)) != 0)
    throw system_failure(errno);
  check(H5Fflush(file, H5F_SCOPE_LOCAL));
}

Handle create_group(hid_t parent, const std::string& name, unsigned links) {
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, group_creation(H5P_GROUP_CREATE, links), H5P_DEFAULT),
          H5Gclose};
}

Handle open_group(hid_t parent, const std::string& name) {
  return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose};
}

Handle open_dataset(hid_t parent, const std::string& name) {
  return {H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose};
}

bool has_link(hid_t parent, const std::string& name) {
  return check(H5Lexists(parent, name.c_str(), H5P_DEFAULT)) > 0;
}

void add_link(hid_t parent, const std::string& object, const std::string& name) {
  check(H5Lcreate_hard(parent, object.c_str(), parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
}

std::vector<std::string> links(hid_t group) {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  check(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names));
  return names;
}

void write_attribute(hid_t object, const std::string& name, std::int64_t number) {
  write_attribute(object, name, H5T_NATIVE_INT64, Handle(H5Screate(H5S_SCALAR), H5Sclose), &number);
}

void write_attribute(hid_t object, const std::string& name, std::span<const std::int64_t> numbers) {
  const hsize_t shape[] = {numbers.size()};
  write_attribute(object, name, H5T_NATIVE_INT64, simple_space(shape), numbers.data());
}

void write_ascii_attribute(hid_t object, const std::string& name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  check(H5Tset_size(type, text.size()));
  check(H5Tset_strpad(type, H5T_STR_NULLPAD));
  check(H5Tset_cset(type, H5T_CSET_ASCII));
  write_attribute(object, name, type, Handle(H5Screate(H5S_SCALAR), H5Sclose), text.data());
}

namespace {

/// For an array of up to 32 KiB in a small file. To compress a larger array would take a millisecond.
void compress_small(hid_t creation, hid_t type, std::span<const hsize_t> shape, std::size_t bytes) {
  constexpr std::size_t in_header = 96;              // bytes; a chunk takes 60 bytes more
  check(H5Pset_dset_no_attrs_hint(creation, true));  // saves 200 bytes for attributes
  check(H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER));
  if (bytes == 0) return;
  if (bytes <= in_header) {
    check(H5Pset_layout(creation, H5D_COMPACT));
    return;
  }
  check(H5Pset_chunk(creation, static_cast<int>(shape.size()), shape.data()));
  // Integers compress better if their bytes are sorted by significance. Sorting does not help metrics and
  // positions: many of their numbers are equal in successive frames, so the bytes repeat without sorting.
  if (H5Tget_class(type) == H5T_INTEGER && H5Tget_size(type) > 1) check(H5Pset_shuffle(creation));
  check(H5Pset_deflate(creation, 9));
}

void compress_large(hid_t creation, std::span<const hsize_t> shape) {
  constexpr hsize_t rows_per_chunk = 65536;  // below HDF5's limit of 4 GiB, and enough to compress
  std::vector<hsize_t> chunk(shape.begin(), shape.end());
  chunk[0] = std::min(chunk[0], rows_per_chunk);
  check(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()));
  check(H5Pset_shuffle(creation));  // sorts bytes by significance: vertex numbers compress better
  check(H5Pset_deflate(creation, 1));
}

}  // namespace

void write_array(hid_t parent, const std::string& name, hid_t type, const void* values,
                 std::span<const hsize_t> shape, Compression compression) {
  const Handle creation = dataset_creation();
  std::size_t bytes = H5Tget_size(type);
  for (const hsize_t length : shape) bytes *= length;
  if (is_small && bytes <= 32768)
    compress_small(creation, type, shape, bytes);
  else if (compression == Compression::always && shape[0] > 1024)  // a smaller array needs no index
    compress_large(creation, shape);
  const Handle dataset(
      H5Dcreate2(parent, name.c_str(), type, simple_space(shape), H5P_DEFAULT, creation, H5P_DEFAULT),
      H5Dclose);
  if (shape[0] > 0) check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
}

std::vector<hsize_t> shape_of(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  std::vector<hsize_t> shape(static_cast<std::size_t>(check(H5Sget_simple_extent_ndims(space))));
  check(H5Sget_simple_extent_dims(space, shape.data(), nullptr));
  return shape;
}

namespace {

// Reads a block of a dataset of one or two dimensions.
void read_block(hid_t dataset, hid_t type, const std::array<hsize_t, 2>& start,
                std::span<const hsize_t> shape, void* values) {
  const Handle in_file(H5Dget_space(dataset), H5Sclose);
  check(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, start.data(), nullptr, shape.data(), nullptr));
  check(H5Dread(dataset, type, simple_space(shape), in_file, H5P_DEFAULT, values));
}

}  // namespace

void read_rows(hid_t dataset, hid_t type, hsize_t first, hsize_t count, void* values) {
  auto shape = shape_of(dataset);
  shape[0] = count;
  read_block(dataset, type, {first, 0}, shape, values);
}

std::vector<double> read_column(hid_t dataset, hsize_t column, hsize_t count) {
  std::vector<double> values(count);
  if (count > 0)
    read_block(dataset, H5T_NATIVE_DOUBLE, {0, column}, std::array<hsize_t, 2>{count, 1}, values.data());
  return values;
}

Series::Series(hid_t parent, const std::string& name, const Layout& layout)
    : rows_(layout.rows), columns_(layout.columns) {
  const std::size_t rank = columns_ ? 2 : 1;
  const std::array<hsize_t, 2> initial = {0, columns_}, limits = {H5S_UNLIMITED, columns_};
  const std::array<hsize_t, 2> chunk = {std::max<hsize_t>(1, rows_ * layout.frames_per_chunk), columns_};
  const Handle creation = dataset_creation();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  check(H5Pset_fill_value(creation, H5T_NATIVE_DOUBLE, &nan));
  check(H5Pset_chunk(creation, static_cast<int>(rank), chunk.data()));
  // Without a chunk cache, append() writes values to the file before it adds their chunk to the index. If
  // writing fails, the index does not change.
  const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  check(H5Pset_chunk_cache(access, 1, 0, 1));
  const Handle space = simple_space(std::span(initial).first(rank), limits.data());
  const ExtensibleArrayScope scope(parent);
  dataset_ =
      Handle(H5Dcreate2(parent, name.c_str(), layout.type, space, H5P_DEFAULT, creation, access), H5Dclose);
}

void Series::append(hid_t type, const void* frame) {
  const std::size_t rank = columns_ ? 2 : 1;
  const std::array<hsize_t, 2> start = {size_, 0}, count = {rows_, columns_},
                               size = {size_ + rows_, columns_};
  check(H5Dset_extent(dataset_, size.data()));
  const Handle in_file(H5Dget_space(dataset_), H5Sclose);
  check(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr));
  const Handle in_memory = simple_space(std::span(count).first(rank));
  check(H5Dwrite(dataset_, type, in_memory, in_file, H5P_DEFAULT, frame));
  size_ += rows_;
}

}  // namespace bendlab::hdf5
