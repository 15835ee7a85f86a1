// The number of bytes in the solver's arrays.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "bendlab/constraints/state.hpp"

namespace bendlab {

template <class T, class Allocator>
std::size_t bytes_of(const std::vector<T, Allocator>& array) {
  return array.size() * sizeof(T);
}

template <class T, class Allocator>
std::size_t bytes_of(const std::vector<std::vector<T>, Allocator>& rows) {
  std::size_t sum = rows.size() * sizeof(std::vector<T>);
  for (const std::vector<T>& row : rows) sum += bytes_of(row);
  return sum;
}

inline std::size_t bytes_of(const Eigen::VectorXd& vector) {
  return static_cast<std::size_t>(vector.size()) * sizeof(double);
}

inline std::size_t bytes_of(const Eigen::SparseMatrix<double>& matrix) {
  return static_cast<std::size_t>(matrix.nonZeros()) * (sizeof(double) + sizeof(int)) +
         static_cast<std::size_t>(matrix.outerSize() + 1) * sizeof(int);
}

inline std::size_t bytes_of(const PairList& pairs) {
  return pairs.memory_bytes();
}

inline std::size_t bytes_of(const BatchOrder& order) {
  return bytes_of(order.first) + bytes_of(order.length) + bytes_of(order.at_place) + bytes_of(order.stacks) +
         bytes_of(order.colours);
}

template <class Real>
std::size_t bytes_of(const StrainBatch<Real>& batch) {
  return bytes_of(batch.order) + bytes_of(batch.a) + bytes_of(batch.b) + bytes_of(batch.c) +
         bytes_of(batch.q00) + bytes_of(batch.q01) + bytes_of(batch.q10) + bytes_of(batch.q11) +
         bytes_of(batch.softness) + bytes_of(batch.multiplier);
}

template <class Real>
std::size_t bytes_of(const DistanceBatch<Real>& batch) {
  return bytes_of(batch.order) + bytes_of(batch.a) + bytes_of(batch.b) + bytes_of(batch.rest_length) +
         bytes_of(batch.softness) + bytes_of(batch.multiplier);
}

template <class Real, class Kind>
std::size_t bytes_of(const ElementBatch<Real, Kind>& batch) {
  std::size_t sum = bytes_of(batch.order) + bytes_of(batch.softness) + bytes_of(batch.multiplier) +
                    bytes_of(batch.length) + bytes_of(batch.yield) + bytes_of(batch.hardening);
  for (const auto& corner : batch.corner) sum += bytes_of(corner);
  for (const auto& rest : batch.rest) sum += bytes_of(rest);
  return sum;
}

template <class Real>
std::size_t bytes_of(const OwnBatch<Real>& batch) {
  return bytes_of(batch.list.vertices) + bytes_of(batch.list.softness) + bytes_of(batch.order) +
         bytes_of(batch.groups) + bytes_of(batch.multiplier);
}

template <class Real>
std::size_t bytes_of(const State<Real>& state) {
  return bytes_of(state.position) + bytes_of(state.previous) + bytes_of(state.velocity) +
         bytes_of(state.position_remainder) + bytes_of(state.velocity_remainder) + bytes_of(state.mass) +
         bytes_of(state.contacts);
}

template <class Real>
std::size_t bytes_of(const Constraints<Real>& constraints) {
  std::size_t sum = bytes_of(constraints.own);
  constraints.for_each([&](const auto& batch) { sum += bytes_of(batch); });
  return sum;
}

}  // namespace bendlab
