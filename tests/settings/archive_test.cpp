// State that is written is read back to the bit.
#include "bendlab/settings/archive.hpp"

#include <limits>

#include "tests/catch.hpp"

namespace bendlab::archive_test {
namespace {

struct Inner {
  std::vector<std::string> names;
  int count = 0;
  void archive(Archive& state) { state(names, count); }
  bool operator==(const Inner&) const = default;
};

struct Everything {
  double number = 0;
  float not_a_number = 0;
  bool yes = false;
  std::string text;
  std::vector<double> numbers;
  std::vector<Inner> inner;
  std::optional<double> there, absent = 1;
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> matrix;
  Eigen::VectorXd vector;
  Eigen::Vector3d fixed = Eigen::Vector3d::Zero();
  void archive(Archive& state) {
    state(number, not_a_number, yes, text, numbers, inner, there, absent, matrix, vector, fixed);
  }
};

Everything example() {
  Everything e;
  e.number = -0.1, e.not_a_number = std::numeric_limits<float>::quiet_NaN(), e.yes = true;
  e.text = std::string("a\0b", 3);
  e.numbers = {1, 1e-310, std::numeric_limits<double>::infinity()};
  e.inner = {{{"x", ""}, 2}, {}};
  e.there = 4, e.absent.reset();
  e.matrix.setRandom(4, 3), e.vector.setRandom(7), e.fixed.setRandom();
  return e;
}

}  // namespace

TEST_CASE("archive: written values are read back", "[archive]") {
  Everything written = example(), read;
  Archive out;
  written.archive(out);
  Archive in(out.bytes());
  read.archive(in);
  CHECK(in.at_end());
  CHECK(read.number == written.number);
  CHECK(std::isnan(read.not_a_number));
  CHECK(read.yes);
  CHECK(read.text == written.text);
  CHECK(read.numbers == written.numbers);
  CHECK(read.inner == written.inner);
  CHECK(read.there == written.there);
  CHECK(read.absent == written.absent);
  CHECK(read.matrix == written.matrix);
  CHECK(read.vector == written.vector);
  CHECK(read.fixed == written.fixed);
  Archive again;
  read.archive(again);
  CHECK(again.bytes() == out.bytes());
}

TEST_CASE("archive: an archive that ends too early is an error, at any place", "[archive]") {
  Archive out;
  example().archive(out);
  for (std::size_t size = 0; size < out.bytes().size(); ++size) {
    Everything read;
    Archive in(out.bytes().substr(0, size));
    CHECK_THROWS_AS(read.archive(in), std::runtime_error);
  }
}

TEST_CASE("archive: invalid bytes give an error or a valid value", "[archive]") {
  const auto matrix_of = [](Eigen::Index rows, Eigen::Index columns) {
    Archive out;
    out(rows, columns);
    std::vector<double> values(4, 1.0);
    return out.bytes() + std::string(reinterpret_cast<const char*>(values.data()), 4 * sizeof(double));
  };
  const auto read = []<class Value>(Value value, const std::string& bytes) {
    Archive in(bytes);
    in(value);
    return value;
  };
  CHECK(read(Eigen::MatrixXd(), matrix_of(2, 2)) == Eigen::MatrixXd::Ones(2, 2));
  constexpr Eigen::Index half = Eigen::Index{1} << 32;  // half · half is 0 in 64 bits
  using Sizes = std::vector<std::pair<Eigen::Index, Eigen::Index>>;
  for (const auto& [rows, columns] : Sizes{{half, half}, {-1, -4}, {-2, 1}, {3, 2}, {half, 1}})
    CHECK_THROWS_AS(read(Eigen::MatrixXd(), matrix_of(rows, columns)), std::runtime_error);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  CHECK_THROWS_AS(read(Rows(), matrix_of(4, 1)), std::runtime_error);
  CHECK(read(false, "\2"));
  CHECK(read(std::optional<char>(), "\2x") == 'x');
}

}  // namespace bendlab::archive_test
