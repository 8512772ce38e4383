#include "python/arrays.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"

namespace touchdown::python {

namespace {

std::string shape_text(const py::array& array) {
  std::string text;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) {
    text += fmt::format("{}{}", i > 0 ? ", " : "", array.shape(i));
  }
  return fmt::format("({}{})", text, array.ndim() == 1 ? "," : "");
}

}  // namespace

StepArray::StepArray(Array array)
    : array_(std::move(array)),
      data_(static_cast<const char*>(static_cast<const void*>(array_.data()))),
      steps_(static_cast<std::size_t>(array_.shape(0))),
      step_bytes_(static_cast<std::size_t>(array_.strides(0))),
      item_bytes_(array_.ndim() > 1 ? static_cast<std::size_t>(array_.strides(1)) : 0) {}

std::size_t ArrayMap::width(const char* name) const {
  if (!has(name)) return 0;
  const auto array = py::array_t<double>::ensure(arrays_[name]);
  if (!array) PyErr_Clear();
  return array && array.ndim() == 2 ? static_cast<std::size_t>(array.shape(1)) : 0;
}

StepArray ArrayMap::column(const char* name, std::size_t columns) {
  if (!has(name)) {
    throw InputError(fmt::format("{}: '{}' is missing: expected an array of shape (steps{}", what_,
                                 name, columns > 0 ? fmt::format(", {})", columns) : ",)"));
  }
  const auto array = StepArray::Array::ensure(arrays_[name]);
  if (!array) throw InputError(fmt::format("{}: '{}': expected an array of numbers", what_, name));
  const bool fits = array.ndim() == (columns > 0 ? 2 : 1) &&
                    (columns == 0 || array.shape(1) == static_cast<py::ssize_t>(columns)) &&
                    (!steps_ || array.shape(0) == static_cast<py::ssize_t>(*steps_));
  if (!fits) {
    const std::string steps = steps_ ? fmt::format("{}", *steps_) : "steps";
    throw InputError(fmt::format("{}: '{}' has the shape {}, expected ({},{}", what_, name,
                                 shape_text(array), steps,
                                 columns > 0 ? fmt::format(" {})", columns) : ")"));
  }
  StepArray column(array);
  steps_ = column.steps();
  return column;
}

}  // namespace touchdown::python
