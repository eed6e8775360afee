// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/solution/field.hpp"

/// Arrays of numpy that keep what C++ computed, without a copy.
namespace shearfront::python {

namespace nb = nanobind;

using Array = nb::ndarray<nb::numpy, double>;
using Bytes = nb::ndarray<nb::numpy, std::uint8_t>;
/// What comes from numpy: made contiguous and double before.
using Numbers = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

[[nodiscard]] inline std::vector<double> vector_of(const Numbers& numbers) {
  return {numbers.data(), numbers.data() + numbers.size()};
}

/// Gives a vector to Python; the capsule frees it with the last array that shows it.
template <class T>
[[nodiscard]] std::pair<T*, nb::capsule> give(std::vector<T> values) {
  auto owned = std::make_unique<std::vector<T>>(std::move(values));
  T* data = owned->data();
  nb::capsule owner(owned.release(), [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return {data, owner};
}

[[nodiscard]] inline nb::object array_of(std::vector<double> values) {
  const std::size_t n = values.size();
  const auto [data, owner] = give(std::move(values));
  return nb::cast(Array(data, {n}, owner));
}

[[nodiscard]] inline nb::object matrix_of(std::vector<double> values, std::size_t n_rows,
                                          std::size_t n_columns) {
  const auto [data, owner] = give(std::move(values));
  return nb::cast(Array(data, {n_rows, n_columns}, owner));
}

[[nodiscard]] inline Eigen::VectorXd eigen_of(const Numbers& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}
[[nodiscard]] inline nb::object array_of(const Eigen::VectorXd& numbers) {
  return array_of(std::vector<double>(numbers.begin(), numbers.end()));
}
/// Row by row.
[[nodiscard]] inline nb::object matrix_of(const Eigen::MatrixXd& matrix) {
  const auto rows = matrix.transpose().reshaped();
  return matrix_of(std::vector<double>(rows.begin(), rows.end()), static_cast<std::size_t>(matrix.rows()),
                   static_cast<std::size_t>(matrix.cols()));
}

/// (phi, M): two views of the same samples, of this shape.
[[nodiscard]] inline nb::tuple views_of(std::vector<Sample> samples, std::size_t n_rows,
                                        std::size_t n_columns) {
  static_assert(sizeof(Sample) == 2 * sizeof(double));
  const auto [data, owner] = give(std::move(samples));
  double* first = n_rows * n_columns > 0 ? &data->phi : nullptr;
  const std::size_t shape[] = {n_rows, n_columns};
  const std::int64_t strides[] = {static_cast<std::int64_t>(2 * n_columns), 2};
  return nb::make_tuple(Array(first, 2, shape, owner, strides),
                        Array(first == nullptr ? first : first + 1, 2, shape, owner, strides));
}

/// The bytes of a vector of structures, for numpy to view with its own type.
template <class T>
[[nodiscard]] nb::object bytes_of(std::vector<T> values) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::size_t n = values.size() * sizeof(T);
  const auto [data, owner] = give(std::move(values));
  return nb::cast(Bytes(reinterpret_cast<std::uint8_t*>(data), {n}, owner));
}

}  // namespace shearfront::python
