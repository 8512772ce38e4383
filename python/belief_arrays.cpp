#include "python/belief_arrays.hpp"

#include <fmt/format.h>

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

}  // namespace touchdown::python
