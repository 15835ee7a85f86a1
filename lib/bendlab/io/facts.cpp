#include "bendlab/io/facts.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace bendlab {
namespace {

using hdf5::Handle;

constexpr const char *begun = "facts", *ended = "outcome", *texts_name = "texts", *numbers_name = "numbers";

// The last part of a path directly below a group; none if it lies elsewhere.
std::optional<std::string> name_in(std::string_view group, std::string_view path) {
  if (!path.starts_with(group) || path.size() <= group.size() || path[group.size()] != '/')
    return std::nullopt;
  return std::string(path.substr(group.size() + 1));
}

template <class Value>
std::map<std::string, Value> those_in(std::string_view group,
                                      const std::vector<std::pair<std::string, Value>>& all) {
  std::map<std::string, Value> found;
  for (const auto& [path, value] : all)
    if (const auto name = name_in(group, path)) found[*name] = value;
  return found;
}

// Two texts in a row for each column: its unit and its meaning.
void add_column(Facts& facts, const std::string& group, const Column& column) {
  facts.texts.emplace_back(group + "/" + column.name, column.unit);
  facts.texts.emplace_back(group + "/" + column.name, column.meaning);
}

// Cuts the texts off that end with a zero.
std::vector<std::string> split(std::string_view bytes) {
  std::vector<std::string> texts;
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\0');
    if (end == std::string_view::npos) throw hdf5::Failure("its texts end without an end");
    texts.emplace_back(bytes.substr(0, end));
    bytes.remove_prefix(end + 1);
  }
  return texts;
}

}  // namespace

std::map<std::string, std::string> Facts::texts_in(std::string_view group) const {
  return those_in(group, texts);
}

std::map<std::string, double> Facts::numbers_in(std::string_view group) const {
  return those_in(group, numbers);
}

const std::string& Facts::text(std::string_view path) const {
  const auto found = std::ranges::find(texts, path, [](const auto& each) { return each.first; });
  if (found == texts.end()) throw hdf5::Failure("it has no text '" + std::string(path) + "'");
  return found->second;
}

std::vector<Column> Facts::metrics() const {
  std::vector<Column> columns;
  for (std::size_t i = 0; i + 1 < texts.size(); ++i)
    if (const auto name = name_in("metrics", texts[i].first)) {
      columns.push_back({*name, texts[i].second, texts[i + 1].second});
      ++i;
    }
  return columns;
}

std::vector<PassTime> Facts::passes() const {
  const auto count = [](double number) { return static_cast<std::uint64_t>(number); };
  std::vector<PassTime> passes;
  for (std::size_t i = 0; i + 2 < numbers.size(); ++i)
    if (const auto name = name_in("passes", numbers[i].first)) {
      passes.push_back(
          {*name, numbers[i].second, count(numbers[i + 1].second), count(numbers[i + 2].second)});
      i += 2;
    }
  return passes;
}

Facts facts_of(const RunHeader& header) {
  Facts facts;
  facts.texts.emplace_back("config", header.config);
  for (const auto& [name, text] : header.provenance) facts.texts.emplace_back("provenance/" + name, text);
  for (std::size_t k = 0; k < header.inputs.size(); ++k) {
    facts.texts.emplace_back("pointers/" + std::to_string(k), header.inputs[k].pointer);
    facts.texts.emplace_back("files/" + std::to_string(k), header.inputs[k].name);
  }
  for (const ConstraintRecord& record : header.constraints) {
    facts.texts.emplace_back("hashes/" + record.kind, record.hash);
    facts.numbers.emplace_back("counts/" + record.kind, static_cast<double>(record.count));
  }
  for (const Column& field : header.cell_fields) add_column(facts, "cell_fields", field);
  add_column(facts, "metrics", {"time", "s", "simulated time"});
  for (const Column& column : header.metrics) add_column(facts, "metrics", column);
  return facts;
}

Facts facts_of(const RunFooter& footer) {
  Facts facts;
  for (const auto& [name, text] : footer.provenance) facts.texts.emplace_back("provenance/" + name, text);
  for (const auto& [name, value] : footer.summary) facts.numbers.emplace_back("summary/" + name, value);
  for (const PassTime& pass : footer.passes)
    for (const double number :
         {pass.seconds, static_cast<double>(pass.calls), static_cast<double>(pass.acted)})
      facts.numbers.emplace_back("passes/" + pass.name, number);
  facts.numbers.emplace_back("timing/wall_s", footer.wall_s);
  facts.numbers.emplace_back("timing/cpu_s", footer.cpu_s);
  facts.numbers.emplace_back("timing/step_cpu_s", footer.step_cpu_s);
  return facts;
}

void Facts::append(const Facts& later) {
  texts.insert(texts.end(), later.texts.begin(), later.texts.end());
  numbers.insert(numbers.end(), later.numbers.begin(), later.numbers.end());
}

namespace {

void write_facts(hid_t file, const char* name, const Facts& facts) {
  std::vector<std::uint8_t> bytes;
  const auto add = [&](const std::string& text) {
    std::copy_n(text.c_str(), std::string_view(text.c_str()).size() + 1, std::back_inserter(bytes));
  };
  std::vector<double> numbers;
  for (const auto& [path, text] : facts.texts) add(path), add(text);
  add("");
  for (const auto& [path, number] : facts.numbers) add(path), numbers.push_back(number);
  const Handle group = hdf5::create_group(file, name, 2);
  hdf5::write_array(group, texts_name, bytes);
  hdf5::write_array(group, numbers_name, numbers);
}

Facts facts_in(hid_t file, const char* name) {
  const Handle group = hdf5::open_group(file, name);
  const auto bytes = hdf5::read_all<std::uint8_t>(group, texts_name);
  const auto numbers = hdf5::read_all<double>(group, numbers_name);
  const std::vector<std::string> texts = split({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  Facts facts;
  std::size_t at = 0;
  for (; at + 1 < texts.size() && !texts[at].empty(); at += 2)
    facts.texts.emplace_back(texts[at], texts[at + 1]);
  if (texts.size() != at + 1 + numbers.size())
    throw hdf5::Failure("it has not a number for each name, or not a name for each");
  for (const double number : numbers) facts.numbers.emplace_back(texts[++at], number);
  return facts;
}

}  // namespace

void write_facts(hid_t file, const Facts& facts) {
  write_facts(file, begun, facts);
}

void write_outcome(hid_t file, const Facts& facts) {
  write_facts(file, ended, facts);
}

std::optional<Facts> read_facts(hid_t file) {
  if (!hdf5::has_link(file, begun)) return std::nullopt;
  Facts facts = facts_in(file, begun);
  if (hdf5::has_link(file, ended)) facts.append(facts_in(file, ended));
  return facts;
}

}  // namespace bendlab
