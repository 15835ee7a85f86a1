#include <algorithm>
#include <set>

#include "bendlab/io/run_series.hpp"

namespace bendlab {
namespace {

using hdf5::Handle;

// Adds the paths of all datasets below a group to `datasets`.
void collect(hid_t group, const std::string& path, std::set<std::string>& datasets) {
  for (const std::string& name : hdf5::links(group)) {
    const Handle object(H5Oopen(group, name.c_str(), H5P_DEFAULT), H5Oclose);
    const std::string below = path.empty() ? name : path + "/" + name;
    if (H5Iget_type(object) == H5I_GROUP)
      collect(object, below, datasets);
    else if (H5Iget_type(object) == H5I_DATASET)
      datasets.insert(below);
  }
}

std::set<std::string> datasets_in(hid_t file) {
  std::set<std::string> datasets;
  for (const char* group : {"VTKHDF", "rest", "constraints"})
    if (hdf5::has_link(file, group)) collect(hdf5::open_group(file, group), group, datasets);
  return datasets;
}

// The shape of a dataset and its values, as bytes in the format of memory.
std::string bytes_of(hid_t file, const std::string& path) {
  const Handle dataset = hdf5::open_dataset(file, path), type(H5Dget_type(dataset), H5Tclose);
  std::size_t count = 1;
  std::string bytes;
  for (const hsize_t length : hdf5::shape_of(dataset)) {
    count *= length;
    bytes += std::to_string(length) + " ";
  }
  const std::size_t head = bytes.size();
  bytes.resize(head + count * H5Tget_size(type));
  if (count > 0) hdf5::check(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data() + head));
  return bytes;
}

std::string bytes_of(std::span<const double> numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()};
}

// The verdict, the metrics and the metrics of the summary, by name.
std::map<std::string, std::string> small_parts(hid_t file) {
  const Json facts = read_facts(file);
  std::map<std::string, std::string> parts = {{"status", facts.at("status")}};
  for (const auto& [column, values] : read_all_metrics(file, read_shape(file).times.size()))
    parts["metrics/" + column.name] = bytes_of(values);
  for (const auto& [name, value] : facts.at("summary").items()) parts["summary/" + name] = value.dump();
  return parts;
}

}  // namespace

std::vector<std::string> differing_parts(const std::filesystem::path& first,
                                         const std::filesystem::path& second) {
  using Parts = std::map<std::string, std::string>;
  const Parts first_parts = with_run(first, small_parts), second_parts = with_run(second, small_parts);
  std::set<std::string> differing;
  for (const auto& [from, to] :
       {std::pair(&first_parts, &second_parts), std::pair(&second_parts, &first_parts)})
    for (const auto& [name, bytes] : *from)
      if (const auto match = to->find(name); match == to->end() || match->second != bytes)
        differing.insert(name);
  std::set<std::string> datasets = with_run(first, datasets_in);
  datasets.merge(with_run(second, datasets_in));
  for (const std::string& name : datasets) {
    const auto bytes = [&](hid_t file) {
      return H5Lexists(file, name.c_str(), H5P_DEFAULT) > 0 ? bytes_of(file, name) : std::string("absent");
    };
    if (with_run(first, bytes) != with_run(second, bytes)) differing.insert(name);
  }
  return {differing.begin(), differing.end()};
}

}  // namespace bendlab
