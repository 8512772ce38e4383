#pragma once

#include <optional>
#include <vector>

#include "estimator/signals.hpp"
#include "python/arrays.hpp"

namespace touchdown::python {

/// Signals of a run, read from arrays with the names of `touchdown export`: `time`, `position`,
/// `velocity`, `torque` (six joints), `linear_acceleration`, `angular_velocity`,
/// `vertical_acceleration`, `ground_velocity_command`, and optionally `has_record`.
class SignalArrays {
 public:
  /// Errors: `InputError` for arrays that are missing, renamed or have another shape.
  explicit SignalArrays(const py::object& arrays);

  std::size_t steps() const { return map_.steps(); }
  bool has_record(std::size_t step) const { return !has_record_ || (*has_record_)(step) != 0.0; }
  Signals at(std::size_t step) const;
  /// Period (s): the median of the first thousand steps; nothing for fewer than two steps.
  std::optional<double> period() const;

 private:
  ArrayMap map_;
  StepArray time_;
  StepArray position_;
  StepArray velocity_;
  StepArray torque_;
  StepArray linear_acceleration_;
  StepArray angular_velocity_;
  StepArray vertical_acceleration_;
  StepArray ground_velocity_command_;
  std::optional<StepArray> has_record_;
  bool has_layout_of_signals_;
};

/// Signals of one step: numbers, and rows of six and of three. Errors: as above.
Signals signals_of_step(const py::object& step);

/// Arrays that view the signals of a run, with the same names.
py::dict arrays_of(std::vector<Signals> steps);

}  // namespace touchdown::python
