#include "bendlab/constraints/pair_list.hpp"

#include <algorithm>

namespace bendlab {

PairList::PairList(std::initializer_list<value_type> pairs) {
  for (const value_type& pair : pairs) push_back(pair);
}

PairList::PairList(const std::vector<value_type>& pairs) {
  reserve(pairs.size());
  for (const value_type& pair : pairs) push_back(pair);
}

void PairList::reserve(std::size_t count) {
  second_.reserve(count);
  section_of_block_.reserve(count / block + 1);
}

void PairList::push_back(const value_type& pair) {
  if (sections_.empty() || sections_.back().vertex != pair[0])
    sections_.push_back({.vertex = pair[0], .begin = static_cast<int>(size())});
  if (size() % block == 0) section_of_block_.push_back(static_cast<int>(sections_.size()) - 1);
  second_.push_back(pair[1]);
}

bool PairList::ascends() const {
  return std::is_sorted(sections_.begin(), sections_.end(),
                        [](const Section& l, const Section& r) { return l.vertex < r.vertex; });
}

std::size_t PairList::memory_bytes() const {
  return second_.size() * sizeof(int) + sections_.size() * sizeof(Section) +
         section_of_block_.size() * sizeof(int);
}

}  // namespace bendlab
