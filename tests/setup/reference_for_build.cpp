// The time for compiling this file is the unit of the build budget (build_budget.py), so the budget means the
// same on every machine. The file must never change, and nothing runs it.
#include <Eigen/Dense>
#include <algorithm>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <variant>
#include <vector>

namespace {

template <int size>
double decomposed(const Eigen::Matrix<double, size, size>& a) {
  const Eigen::JacobiSVD<Eigen::Matrix<double, size, size>> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, size, size>> eigen(a * a.transpose());
  return svd.singularValues().sum() + eigen.eigenvalues().sum() + a.fullPivLu().determinant();
}

using Value = std::variant<int, double, std::string, std::vector<double>>;

double number_of(const Value& value) {
  return std::visit(
      []<class Held>(const Held& held) -> double {
        if constexpr (std::is_arithmetic_v<Held>)
          return static_cast<double>(held);
        else
          return static_cast<double>(held.size());
      },
      value);
}

}  // namespace

double reference_for_build(const std::string& text) {
  const nlohmann::json json = nlohmann::json::parse(text);
  std::map<std::string, std::function<double()>> numbers;
  for (const auto& [key, value] : json.items())
    numbers[key] = [size = value.size()] { return number_of(Value(static_cast<int>(size))); };
  double sum = std::regex_match(text, std::regex("[a-z]+[0-9]*")) ? 1 : 0;
  for (const auto& [key, number] : numbers) sum += number();
  sum += decomposed<3>(Eigen::Matrix3d::Identity());
  return sum + static_cast<double>(json.dump().size());
}
