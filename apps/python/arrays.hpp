#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>
#include <vector>

#include "estimator/contact_estimator.hpp"

namespace touchdown::python {

namespace py = pybind11;

/// Rows that NumPy arrays view without a copy. They live as long as the last such array.
template <typename Row>
class SharedRows {
 public:
  explicit SharedRows(std::vector<Row> rows)
      : rows_(std::make_unique<std::vector<Row>>(std::move(rows)).release()),
        owner_(rows_, [](void* all) { delete static_cast<std::vector<Row>*>(all); }) {}

  /// The first row, to point at its members; a spare row if there are none.
  Row& front() { return rows_->empty() ? spare_ : rows_->front(); }

  /// A view of one value per row. `first` points at that of the first row.
  template <typename T>
  py::array_t<T> view(const T* first) const {
    const std::vector<py::ssize_t> shape = {size()};
    if (rows_->empty()) return py::array_t<T>(shape);
    return py::array_t<T>(shape, {bytes}, first, owner_);
  }

  /// A view of several values per row, `apart` bytes from each other.
  template <typename T>
  py::array_t<T> view(const T* first, std::size_t columns, std::size_t apart = sizeof(T)) const {
    const std::vector<py::ssize_t> shape = {size(), static_cast<py::ssize_t>(columns)};
    if (rows_->empty()) return py::array_t<T>(shape);
    return py::array_t<T>(shape, {bytes, static_cast<py::ssize_t>(apart)}, first, owner_);
  }

 private:
  static constexpr auto bytes = static_cast<py::ssize_t>(sizeof(Row));
  py::ssize_t size() const { return static_cast<py::ssize_t>(rows_->size()); }

  std::vector<Row>* rows_;
  py::capsule owner_;
  Row spare_ = {};
};

/// An array that owns the values.
template <typename T>
py::array_t<T> array_of(std::vector<T> values) {
  SharedRows<T> rows(std::move(values));
  return rows.view(&rows.front());
}

/// Numbers of a caller's array by step, with any strides. Reading needs no Python lock;
/// construction and destruction do.
class StepArray {
 public:
  /// Converts to numbers if needed, aligned for the processor.
  static constexpr int flags = static_cast<int>(py::array::forcecast) |
                               static_cast<int>(py::detail::npy_api::NPY_ARRAY_ALIGNED_);
  using Array = py::array_t<double, flags>;

  explicit StepArray(Array array);

  std::size_t steps() const { return steps_; }
  /// Numbers per step.
  std::size_t items() const {
    return array_.ndim() > 1 ? static_cast<std::size_t>(array_.shape(1)) : 1;
  }
  double operator()(std::size_t step, std::size_t item = 0) const {
    return *reinterpret_cast<const double*>(data_ + step * step_bytes_ + item * item_bytes_);
  }

 private:
  Array array_;  ///< keeps the numbers alive
  const char* data_;
  std::size_t steps_;
  std::size_t step_bytes_;
  std::size_t item_bytes_;
};

/// A mapping of names to arrays: a dict, or the result of `numpy.load`.
class ArrayMap {
 public:
  /// `what` names the mapping in error messages.
  ArrayMap(py::object arrays, std::string what)
      : arrays_(std::move(arrays)), what_(std::move(what)) {}

  bool has(const char* name) const { return arrays_.contains(name); }

  /// An array of one number per step, or of `columns` numbers. The first array sets the number of
  /// steps. Errors: `InputError` if it is missing or has another shape.
  StepArray column(const char* name, std::size_t columns = 0);

  /// The numbers per step of an array; zero if it is missing or has one number per step.
  std::size_t width(const char* name) const;

  std::size_t steps() const { return steps_.value_or(0); }

 private:
  py::object arrays_;
  std::string what_;
  std::optional<std::size_t> steps_;
};

/// Arrays that view beliefs by step: `p_contact` and `contact` (left and right wheel),
/// `p_any_wheel`, `p_both_wheels`, `status` (its number), `load` and `load_deviation` (N).
py::dict arrays_of(std::vector<Belief> beliefs);

/// The inverse. `given` holds such arrays (`p_contact` or `contact` suffices), or is one array of
/// probabilities or decisions, per wheel or for the robot. By default, contact is p ≥ 0.5 and the
/// wheels are independent. `source` names the estimator in error messages.
/// Errors: `InputError` for other shapes, and for numbers that are no probabilities.
std::vector<Belief> beliefs_of(const py::object& given, std::size_t steps,
                               const std::string& source);

/// Errors: `InputError` for what Python accepts in a path and no system does, such as "a\0".
std::filesystem::path path_of(const py::object& object);

}  // namespace touchdown::python
