// The texts and numbers of a run file, in two compressed datasets: 3.3 KB for a run of 4 × 4 cells. As
// attributes and texts of HDF5 they took about 25 KB, because each has a header of its own and texts of
// variable length are not compressed. Only sources of this folder include this header.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bendlab/io/hdf5_handles.hpp"
#include "bendlab/io/run_file.hpp"

namespace bendlab {

/// Texts and numbers, each under a path, in the order in which they were written. A path may occur more than
/// once; of provenance, summary and timing the last counts.
struct Facts {
  std::vector<std::pair<std::string, std::string>> texts;
  std::vector<std::pair<std::string, double>> numbers;

  /// The texts (numbers) whose paths are "<group>/<name>", by name.
  std::map<std::string, std::string> texts_in(std::string_view group) const;
  std::map<std::string, double> numbers_in(std::string_view group) const;
  /// The text of a path. Throws hdf5::Failure if there is none.
  const std::string& text(std::string_view path) const;
  std::vector<Column> metrics() const;
  std::vector<PassTime> passes() const;

  void append(const Facts& later);
};

/// All that a file has of its header, or footer, but for id, name, status and the arrays.
Facts facts_of(const RunHeader& header);
Facts facts_of(const RunFooter& footer);

/// /facts/texts: a byte for each character of path, text, path, text, …; every one ends with a zero. An empty
/// path ends them; behind it are the paths of the numbers in /facts/numbers.
void write_facts(hid_t file, const Facts& facts);

/// The same in /outcome: what a file that grows with its run learns at the end.
void write_outcome(hid_t file, const Facts& facts);

/// Those of /facts and /outcome. None if an older program wrote the file, with attributes.
std::optional<Facts> read_facts(hid_t file);

}  // namespace bendlab
