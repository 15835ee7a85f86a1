#include "experiments/campaign/run_index.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "bendlab/io/disk.hpp"
#include "bendlab/io/facts.hpp"
#include "bendlab/settings/input_file.hpp"
#include "experiments/config/in_parallel.hpp"
#include "experiments/run/checked_read.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

constexpr const char* index_name = "runs.index";
constexpr std::string_view first_line = "bendlab index 2\n";

bool is_finished_name(std::string_view name) {
  return name.ends_with(".vtkhdf");
}

bool is_run_file(std::string_view name) {
  return is_finished_name(name) || (name.starts_with("run.vtkhdf") && name.ends_with(".part"));
}

/// Identifies a version of a file: if a file's stamp is the same as before, the file was not changed.
struct Stamp {
  std::int64_t size = -1, modified = 0, changed = 0;  // bytes; ns

  static Stamp of(const fs::path& file) {
    constexpr std::int64_t second = 1'000'000'000;
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) return {};
    return {status.st_size, status.st_mtim.tv_sec * second + status.st_mtim.tv_nsec,
            status.st_ctim.tv_sec * second + status.st_ctim.tv_nsec};
  }
  bool operator==(const Stamp&) const = default;
};

std::string hash_of(std::string_view text) {
  return fmt::format("{:016x}", XXH3_64bits(text.data(), text.size()));
}

std::string dumped(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);  // dump() escapes tabs and new lines
}

std::string line_of(const fs::path& folder, const Stamp& stamp, const RunRecord& run) {
  Json head = facts_of(run);
  std::string parts;
  for (const char* part : {"summary", "provenance", "config"}) {
    parts += "\t" + dumped(head.at(part));
    head.erase(part);
  }
  return fmt::format("{}\t{}\t{}\t{}\t{}{}\n", fs::relative(run.file, folder).string(), stamp.size,
                     stamp.modified, stamp.changed, dumped(head), parts);
}

/// A line of the index, split into its parts. The views point into the index's text.
struct Entry {
  Stamp stamp;
  std::string_view line, head, summary, provenance, config;

  RunRecord record(const fs::path& file, RunDetails details) const {
    Json json = Json::parse(head);
    if (details == RunDetails::all)
      json["summary"] = Json::parse(summary), json["provenance"] = Json::parse(provenance);
    RunRecord run = record_of(json, file);
    if (details == RunDetails::all) run.config = config;
    return run;
  }
};

/// The index of a folder, as read from the disk.
class Index {
 public:
  explicit Index(const fs::path& folder) {
    try {
      text_ = read_input_file(folder / index_name);
    } catch (const std::runtime_error&) {  // there is no index
      return;
    }
    const std::size_t last = text_.size() < 2 ? 0 : text_.rfind('\n', text_.size() - 2) + 1;
    if (!text_.starts_with(first_line) || last < first_line.size()) return;
    const std::string_view all = text_;
    if (all.substr(last) != hash_of(all.substr(0, last)) + "\n") return;
    std::string_view rest = std::string_view(text_).substr(first_line.size(), last - first_line.size());
    while (!rest.empty()) {
      const std::size_t end = rest.find('\n');
      add(rest.substr(0, end + 1));
      rest.remove_prefix(end + 1);
    }
  }
  Index(const Index&) = delete;
  Index& operator=(const Index&) = delete;

  std::size_t size() const { return entries_.size(); }
  const Entry* find(const std::string& path) const {
    const auto found = entries_.find(path);
    return found == entries_.end() ? nullptr : &found->second;
  }

 private:
  void add(std::string_view line) {
    std::array<std::string_view, 8> part;
    std::string_view rest = line.substr(0, line.size() - 1);
    for (std::string_view& cell : part) {
      const std::size_t end = std::min(rest.find('\t'), rest.size());
      cell = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    const auto integer = [](std::string_view text) {
      std::int64_t value = -1;
      std::from_chars(text.data(), text.data() + text.size(), value);
      return value;
    };
    entries_[part[0]] = {
        {integer(part[1]), integer(part[2]), integer(part[3])}, line, part[4], part[5], part[6], part[7]};
  }

  std::string text_;
  std::unordered_map<std::string_view, Entry> entries_;  // by path
};

/// A file's entry in an index.
struct Known {
  Stamp stamp;                      ///< of the file
  std::optional<RunRecord> record;  ///< empty: the file has to be read
  std::string_view line;            ///< the line of `record` in the index
  std::string new_line;
};

/// The index's entry for each file.
std::vector<Known> known_in(const Index& index, const fs::path& folder, const std::vector<fs::path>& files,
                            RunDetails details) {
  std::vector<Known> known(files.size());
  const std::size_t prefix = folder.native().size() + (folder.native().ends_with('/') ? 0 : 1);
  in_parallel(files.size(), 500, [&](std::size_t i) {
    known[i].stamp = Stamp::of(files[i]);
    const Entry* const entry = index.find(files[i].native().substr(prefix));
    if (!entry || entry->stamp != known[i].stamp) return;
    try {
      known[i].record = entry->record(files[i], details);
      known[i].line = entry->line;
    } catch (const std::exception&) {  // the file is read again
    }
  });
  return known;
}

}  // namespace

std::vector<fs::path> find_run_files(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw RunFileError(fmt::format("there is no folder '{}'", folder.string()));
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (is_run_file(entry.path().filename().native()) && entry.is_regular_file())
      files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::vector<RunRecord> read_runs(const fs::path& folder,
                                 const std::function<void(const std::string&)>& unreadable,
                                 RunDetails details) {
  const std::vector<fs::path> files = find_run_files(folder);
  const Index index(folder);
  std::vector<Known> known = known_in(index, folder, files, details);
  std::vector<RunRecord> runs;
  runs.reserve(files.size());
  std::size_t from_index = 0, finished = 0;
  for (std::size_t i = 0; i < files.size(); ++i) try {
      if (known[i].record) {
        runs.push_back(*std::move(known[i].record));
        ++from_index, ++finished;
        continue;
      }
      runs.push_back(read_checked(files[i]));
      if (!is_finished_name(files[i].native())) continue;
      known[i].new_line = line_of(folder, known[i].stamp, runs.back());
      ++finished;
    } catch (const std::exception& error) {
      if (fs::exists(files[i])) unreadable(error.what());  // else the file was renamed or removed meanwhile
    }
  if (from_index == index.size() && from_index == finished) return runs;
  std::string text(first_line);
  for (const Known& file : known) text += file.new_line.empty() ? file.line : std::string_view(file.new_line);
  try {
    replace_file(folder / index_name, text + hash_of(text) + "\n", Wait::no);
  } catch (const RunFileError&) {  // the folder of another user
  }
  return runs;
}

}  // namespace bendlab
