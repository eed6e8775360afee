// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nanobind/nanobind.h>

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// Structs as lists of Python, and back to the bit: what pickles of them hold. A struct takes part by a function
///   template <Of<Struct> T, class Visit> void members(T& x, Visit&& visit)
/// that calls visit(member) for all of them: the same function serves for writing and reading.
namespace shearfront::python {

namespace nb = nanobind;

/// T or const T.
template <class T, class Which>
concept Of = std::is_same_v<std::remove_const_t<T>, Which>;

class StateWriter {
 public:
  template <class T>
  void operator()(const T& x) {
    list_.append(written(x));
  }
  template <class T>
  [[nodiscard]] static nb::object written(const T& x) {
    if constexpr (std::is_enum_v<T>) {
      return nb::cast(static_cast<std::size_t>(x));
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      return nb::cast(x);
    } else {
      StateWriter writer;
      members(x, writer);
      return writer.list_;
    }
  }
  template <class T>
  [[nodiscard]] static nb::object written(const std::optional<T>& x) {
    return x ? written(*x) : nb::none();
  }
  template <class T>
  [[nodiscard]] static nb::object written(const std::vector<T>& xs) {
    nb::list all;
    for (const T& x : xs) all.append(written(x));
    return all;
  }
  [[nodiscard]] static nb::object written(const Eigen::MatrixXd& matrix) {
    nb::list all;
    for (const double x : matrix.reshaped()) all.append(x);
    return nb::make_tuple(matrix.rows(), all);
  }

 private:
  nb::list list_;
};

class StateReader {
 public:
  explicit StateReader(nb::handle list) : list_(nb::cast<nb::sequence>(list)) {}

  template <class T>
  void operator()(T& x) {
    read(list_[next_++], x);
  }
  template <class T>
  static void read(nb::handle from, T& x) {
    if constexpr (std::is_enum_v<T>) {
      x = static_cast<T>(nb::cast<std::size_t>(from));
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      x = nb::cast<T>(from);
    } else {
      members(x, StateReader(from));
    }
  }
  template <class T>
  static void read(nb::handle from, std::optional<T>& x) {
    if (from.is_none()) return x.reset();
    read(from, x.emplace());
  }
  template <class T>
  static void read(nb::handle from, std::vector<T>& xs) {
    for (const nb::handle one : nb::cast<nb::sequence>(from)) read(one, xs.emplace_back());
  }
  static void read(nb::handle from, Eigen::MatrixXd& matrix) {
    const auto [n_rows, list] = nb::cast<std::pair<Eigen::Index, nb::list>>(from);
    std::vector<double> values;
    read(list, values);
    matrix = Eigen::Map<Eigen::MatrixXd>(values.data(), n_rows,
                                         n_rows == 0 ? 0 : static_cast<Eigen::Index>(values.size()) / n_rows);
  }

 private:
  nb::sequence list_;
  std::size_t next_ = 0;
};

}  // namespace shearfront::python
