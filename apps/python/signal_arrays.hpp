#pragma once

#include <array>
#include <optional>
#include <vector>

#include "apps/python/arrays.hpp"
#include "estimator/record.hpp"

namespace touchdown::python {

/// The arrays of targets, by member of `JointTarget`.
struct TargetArray {
  const char* name;
  double JointTarget::*member;
};
inline constexpr std::array<TargetArray, 5> target_arrays = {
    {{"target_position", &JointTarget::position},
     {"target_velocity", &JointTarget::velocity},
     {"target_torque", &JointTarget::feedforward_torque},
     {"target_kp", &JointTarget::kp},
     {"target_kd", &JointTarget::kd}}};

/// The signals that an estimator uses. Arrays of others may be missing: they are 0.
struct SignalNeeds {
  bool torque = true;
  bool position = true;
  bool velocity = true;
  bool acceleration = true;  ///< along the vertical
  bool angular_velocity = true;
  bool acceleration_vector = true;
  bool command = true;
};

/// Signals of a run, read from arrays with the names of `touchdown convert`: `time`, `position`,
/// `velocity`, `torque` (six joints), `linear_acceleration`, `angular_velocity`,
/// `vertical_acceleration`, `ground_velocity_command`, `orientation` (w x y z, to a frame with z
/// down), and optionally `has_record` and the targets of six joints: `target_position`,
/// `target_velocity`, `target_torque`, `target_kp`, `target_kd`.
///
/// The vertical acceleration is that of its array, or else follows from `linear_acceleration` and
/// `orientation`, as it always does if that acceleration is `AccelerationSource::proper`: the
/// orientation then takes out gravity. `AssemblyConfig::axes` rotates all vectors of the IMU.
class SignalArrays {
 public:
  /// `is_one_step`: numbers, and rows of six and of three, instead of arrays with a row per step.
  /// Errors: `InputError` for arrays that are needed and missing or have another shape.
  SignalArrays(const py::object& arrays, const SignalNeeds& needs, AssemblyConfig imu,
               bool is_one_step = false);

  std::size_t steps() const { return map_.steps(); }
  bool has_record(std::size_t step) const { return !has_record_ || (*has_record_)(step) != 0.0; }
  Signals at(std::size_t step) const;
  /// Period (s): the median of the first thousand steps; nothing for fewer than two steps.
  std::optional<double> period() const;

 private:
  StepArray column(const char* name, std::size_t columns);
  std::optional<StepArray> column(const char* name, std::size_t columns, bool is_needed);

  py::object arrays_;
  bool is_one_step_;
  ArrayMap map_;
  AssemblyConfig imu_;
  StepArray time_;
  bool derives_;  ///< accelerations from the orientation
  std::optional<StepArray> position_;
  std::optional<StepArray> velocity_;
  std::optional<StepArray> torque_;
  std::optional<StepArray> linear_acceleration_;
  std::optional<StepArray> angular_velocity_;
  std::optional<StepArray> vertical_acceleration_;
  std::optional<StepArray> ground_velocity_command_;
  std::optional<StepArray> orientation_;
  std::array<std::optional<StepArray>, 5> target_;  ///< by member of `JointTarget`
  std::optional<StepArray> has_record_;
};

/// Arrays that view the signals of a run, with the same names.
py::dict arrays_of(std::vector<Signals> steps);

}  // namespace touchdown::python
