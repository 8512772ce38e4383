#pragma once

#include <optional>
#include <vector>

#include "estimator/signals.hpp"
#include "python/arrays.hpp"

namespace touchdown::python {

/// What estimators hear of a run, from arrays by the names of `touchdown export`: `time`,
/// `position`, `velocity`, `torque` (six joints), `linear_acceleration`, `angular_velocity`,
/// `vertical_acceleration`, `ground_velocity_command`, and `heard` if it is there.
class SignalArrays {
 public:
  /// Errors: `InputError` for arrays that are missing or of another shape.
  explicit SignalArrays(const py::object& arrays);

  std::size_t steps() const { return map_.steps(); }
  bool has_record(std::size_t step) const { return !heard_ || (*heard_)(step) != 0.0; }
  Signals at(std::size_t step) const;
  /// Between steps (s), the median of the first thousand; nothing for less than two steps.
  std::optional<double> period() const;

 private:
  ArrayMap map_;
  Column time_;
  Column position_;
  Column velocity_;
  Column torque_;
  Column linear_acceleration_;
  Column angular_velocity_;
  Column vertical_acceleration_;
  Column ground_velocity_command_;
  std::optional<Column> heard_;
  bool joints_lie_as_in_signals_;
};

/// One step, by the same names: numbers, and rows of six and of three. Errors: as above.
Signals signals_of_step(const py::object& step);

/// The inverse, by views of the steps.
py::dict arrays_of(std::vector<Signals> steps);

}  // namespace touchdown::python
