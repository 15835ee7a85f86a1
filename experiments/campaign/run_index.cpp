#include "experiments/campaign/run_index.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "bendlab/io/disk.hpp"
#include "bendlab/parameters/input_file.hpp"
#include "bendlab/scene/strict_json.hpp"
#include "experiments/config/in_parallel.hpp"
#include "experiments/run/checked_read.hpp"
#include "experiments/run/run_record.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

// Json keeps the order of names, and looks for one from the first to the last: too slow for thousands of
// runs.
using nlohmann::json;

constexpr const char* index_name = "runs.index";
constexpr std::string_view first_line = "bendlab index 1\n";

bool is_finished_name(std::string_view name) {
  return name.ends_with(".vtkhdf");
}

bool is_run_file(std::string_view name) {
  return is_finished_name(name) || (name.starts_with("run.vtkhdf") && name.ends_with(".part"));
}

/// By which a file is known to be the one that was read.
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

std::string dumped(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);  // no tab and no new line is left in it
}

std::string line_of(const fs::path& folder, const Stamp& stamp, const RunRecord& run) {
  json summary = json::object();
  for (const auto& [name, value] : run.summary) summary[name] = number_json(value);
  return fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", fs::relative(run.file, folder).string(), stamp.size,
                     stamp.modified, stamp.changed, dumped(head_json(run)), dumped(summary),
                     dumped(run.provenance), Json::parse(run.config).dump());
}

/// Reads an object of texts and numbers into maps, without making a JSON document of it: there are thousands.
class FlatObject : public nlohmann::json_sax<json> {
 public:
  explicit FlatObject(std::map<std::string, double>& numbers) : numbers_(&numbers) {}
  explicit FlatObject(std::map<std::string, std::string>& texts) : texts_(&texts) {}

  void read(std::string_view text) {
    if (!json::sax_parse(text, this)) throw std::invalid_argument("the index is damaged");
  }

  bool null() override { return put(std::nan("")); }
  bool number_integer(number_integer_t value) override { return put(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return put(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override {
    if (numbers_) return put(number_of(json(value)));
    texts_->emplace_hint(texts_->end(), std::move(key_), std::move(value));
    return true;
  }
  bool key(string_t& name) override { return key_ = std::move(name), true; }
  bool start_object(std::size_t) override { return ++depth_ == 1; }
  bool end_object() override { return true; }
  bool boolean(bool) override { return false; }
  bool binary(binary_t&) override { return false; }
  bool start_array(std::size_t) override { return false; }
  bool end_array() override { return false; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;
  }

 private:
  bool put(double value) {
    if (!numbers_) return false;
    numbers_->emplace_hint(numbers_->end(), std::move(key_), value);
    return true;
  }

  std::map<std::string, double>* numbers_ = nullptr;
  std::map<std::string, std::string>* texts_ = nullptr;
  std::string key_;
  int depth_ = 0;
};

/// A line in its parts; views of the index's text.
struct Entry {
  Stamp stamp;
  std::string_view line, head, summary, provenance, config;

  RunRecord record(const fs::path& file, Part part) const {
    RunRecord run = record_of(json::parse(head), file);
    if (part == Part::state) return run;
    run.config = config;
    FlatObject(run.summary).read(summary);
    FlatObject(run.provenance).read(provenance);
    return run;
  }
};

/// The index of a folder as it is on the disk.
class Index {
 public:
  explicit Index(const fs::path& folder) {
    try {
      text_ = read_input_file(folder / index_name);
    } catch (const std::runtime_error&) {  // it is not there
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
    for (std::string_view& each : part) {
      const std::size_t end = std::min(rest.find('\t'), rest.size());
      each = rest.substr(0, end);
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

/// What an index has of a file.
struct Known {
  Stamp stamp;                      ///< of the file
  std::optional<RunRecord> record;  ///< none: the file has to be read
  std::string_view line;            ///< of the record
  std::string new_line;
};

/// Of each file.
std::vector<Known> known_in(const Index& index, const fs::path& folder, const std::vector<fs::path>& files,
                            Part part) {
  std::vector<Known> known(files.size());
  const std::size_t prefix = folder.native().size() + (folder.native().ends_with('/') ? 0 : 1);
  in_parallel(files.size(), 500, [&](std::size_t i) {
    known[i].stamp = Stamp::of(files[i]);
    const Entry* const entry = index.find(files[i].native().substr(prefix));
    if (!entry || entry->stamp != known[i].stamp) return;
    try {
      known[i].record = entry->record(files[i], part);
      known[i].line = entry->line;
    } catch (const std::exception&) {  // it is read anew
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
                                 const std::function<void(const std::string&)>& unreadable, Part part) {
  const std::vector<fs::path> files = find_run_files(folder);
  const Index index(folder);
  std::vector<Known> known = known_in(index, folder, files, part);
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
      if (fs::exists(files[i])) unreadable(error.what());  // else it was renamed or removed meanwhile
    }
  if (from_index == index.size() && from_index == finished) return runs;
  std::string text(first_line);
  for (const Known& each : known) text += each.new_line.empty() ? each.line : std::string_view(each.new_line);
  try {
    replace_file(folder / index_name, text + hash_of(text) + "\n", Wait::no);
  } catch (const RunFileError&) {  // somebody else's folder
  }
  return runs;
}

}  // namespace bendlab
