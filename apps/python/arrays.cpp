#include "apps/python/arrays.hpp"

#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "models/robot.hpp"

namespace touchdown::python {

namespace {

double probability(const StepArray& column, std::size_t step, std::size_t item,
                   const std::string& source) {
  const double p = column(step, item);
  if (p >= 0.0 && p <= 1.0) return p;
  throw InputError(
      fmt::format("{}: {} at step {}: expected a probability, from 0 to 1", source, p, step));
}

/// The given arrays by name; a bare array is `p_contact`.
py::dict named(const py::object& given) {
  if (py::isinstance<py::dict>(given)) return given;
  py::dict arrays;
  const auto array = StepArray::Array::ensure(given);
  if (!array || array.ndim() != 1) {
    arrays["p_contact"] = given;
  } else {  // one number per step counts for both wheels
    py::array_t<double> both({array.shape(0), py::ssize_t{models::wheel_count}});
    auto values = both.mutable_unchecked<2>();
    for (py::ssize_t k = 0; k < array.shape(0); ++k) values(k, 0) = values(k, 1) = array.at(k);
    arrays["p_contact"] = both;
  }
  return arrays;
}

std::string shape_text(const py::array& array) {
  return fmt::format("({}{})", fmt::join(array.shape(), array.shape() + array.ndim(), ", "),
                     array.ndim() == 1 ? "," : "");
}

}  // namespace

py::dict arrays_of(std::vector<Belief> beliefs) {
  static_assert(sizeof(SignalStatus) == sizeof(int));
  SharedRows<Belief> rows(std::move(beliefs));
  Belief& first = rows.front();
  py::dict arrays;
  arrays["p_contact"] =
      rows.view(&first.wheel[0].p_contact, models::wheel_count, sizeof(WheelBelief));
  arrays["contact"] = rows.view(&first.wheel[0].contact, models::wheel_count, sizeof(WheelBelief));
  arrays["p_any_wheel"] = rows.view(&first.p_any_wheel);
  arrays["p_both_wheels"] = rows.view(&first.p_both_wheels);
  arrays["status"] = rows.view(reinterpret_cast<const int*>(&first.status));
  arrays["load"] = rows.view(&first.wheel[0].load.force, models::wheel_count, sizeof(WheelBelief));
  arrays["load_deviation"] =
      rows.view(&first.wheel[0].load.deviation, models::wheel_count, sizeof(WheelBelief));
  return arrays;
}

std::vector<Belief> beliefs_of(const py::object& given, std::size_t steps,
                               const std::string& source) {
  const py::dict arrays = named(given);
  ArrayMap map(arrays, source);
  const bool has_decisions = map.has("contact");
  const StepArray p = map.column(map.has("p_contact") || !has_decisions ? "p_contact" : "contact",
                                 models::wheel_count);
  if (p.steps() != steps) {
    throw InputError(
        fmt::format("{}: beliefs about {} steps, expected {}", source, p.steps(), steps));
  }
  std::optional<StepArray> decisions;
  std::optional<StepArray> any_wheel;
  std::optional<StepArray> both_wheels;
  if (has_decisions) decisions.emplace(map.column("contact", models::wheel_count));
  if (map.has("p_any_wheel")) any_wheel.emplace(map.column("p_any_wheel"));
  if (map.has("p_both_wheels")) both_wheels.emplace(map.column("p_both_wheels"));
  std::vector<Belief> beliefs(steps);
  for (std::size_t k = 0; k < steps; ++k) {
    Belief& belief = beliefs[k];
    for (std::size_t w = 0; w < models::wheel_count; ++w) {
      belief.wheel[w].p_contact = probability(p, k, w, source);
    }
    apply_threshold(belief, 0.5);
    for (std::size_t w = 0; w < models::wheel_count && decisions; ++w) {
      belief.wheel[w].contact = (*decisions)(k, w) != 0.0;
    }
    if (any_wheel) belief.p_any_wheel = probability(*any_wheel, k, 0, source);
    if (both_wheels) belief.p_both_wheels = probability(*both_wheels, k, 0, source);
  }
  return beliefs;
}

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

std::filesystem::path path_of(const py::object& object) {
  try {
    return object.cast<std::filesystem::path>();
  } catch (const py::cast_error&) {
    throw InputError(fmt::format("{}: expected a path", py::repr(object).cast<std::string>()));
  }
}

}  // namespace touchdown::python
