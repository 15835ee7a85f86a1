// Lists of springs take little memory and behave like plain lists.
#include "bendlab/constraints/lists.hpp"

#include <rapidcheck.h>

#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::lists_test {
namespace {

using Pairs = std::vector<std::array<int, 2>>;

// Long and short stretches of pairs with the same first vertex, up to several blocks of the index.
rc::Gen<Pairs> any_pairs() {
  return rc::gen::exec([] {
    Pairs pairs;
    for (int stretches = *rc::gen::inRange(0, 40); stretches > 0; --stretches) {
      const int first = *rc::gen::inRange(0, 5), length = *rc::gen::element(1, 1, 1, 2, 63, 64, 65, 200);
      for (int p = 0; p < length; ++p) pairs.push_back({first, *rc::gen::inRange(0, 1000)});
    }
    return pairs;
  });
}

}  // namespace

TEST_CASE("a pair list gives back the pairs that it was given", "[constraints]") {
  CHECK(rc::check("for any pairs", [] {
    const Pairs pairs = *any_pairs();
    const PairList list(pairs);
    RC_ASSERT(list.size() == pairs.size());
    RC_ASSERT(list.empty() == pairs.empty());
    RC_ASSERT(test::plain(list) == pairs);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      RC_ASSERT(list[p] == pairs[p]);
      RC_ASSERT(list.first(p) == pairs[p][0]);
      RC_ASSERT(list.second(p) == pairs[p][1]);
    }
    RC_ASSERT(list.ascends() == std::ranges::is_sorted(pairs, {}, [](const auto& pair) { return pair[0]; }));
  }));
}

TEST_CASE("pair lists are equal if their pairs are", "[constraints]") {
  CHECK(rc::check("for any two lists", [] {
    const Pairs first = *any_pairs();
    Pairs second = first;
    if (!second.empty() && *rc::gen::arbitrary<bool>())
      ++second[*rc::gen::inRange<std::size_t>(0, second.size())][*rc::gen::inRange<std::size_t>(0, 2)];
    RC_ASSERT((PairList(first) == PairList(second)) == (first == second));
  }));
}

TEST_CASE("a list sorted by first vertex takes little more memory than one number per pair",
          "[constraints]") {
  PairList list;
  for (int centre = 0; centre < 100; ++centre)
    for (int other = 0; other < 100; ++other) list.push_back({centre, other});
  CHECK(static_cast<double>(list.memory_bytes()) < 4.2 * static_cast<double>(list.size()));
}

TEST_CASE("a rest length that is not stored is the distance at rest", "[constraints]") {
  Positions shape(3, 3);
  shape << 0, 0, 0, 3, 4, 0, 3, 4, 12;  // sides of 5, 12 and 13
  DistanceConstraints list = springs_at_rest_in(shape);
  list.vertices = {{0, 1}, {1, 2}, {2, 0}};
  const std::vector<double> sides = {5, 12, 13};
  const auto check = [&](const DistanceConstraints& springs) {
    for (std::size_t c = 0; c < sides.size(); ++c) CHECK(springs.rest(c) == sides[c]);
  };
  check(list);
  CHECK(list.rest_length.empty());

  const DistanceConstraints renumbered = list.renumbered({2, 0, 1});
  CHECK(renumbered.vertices == PairList{{2, 0}, {0, 1}, {1, 2}});
  check(renumbered);

  list.store_rest_lengths();
  CHECK(list.rest_length == sides);
  list.rest_length[1] = 7;  // a stored rest length is used
  CHECK(list.rest(1) == 7);
  CHECK(list.renumbered({2, 0, 1}).rest(1) == 7);
}

}  // namespace bendlab::lists_test
