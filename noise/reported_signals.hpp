#pragma once

#include <memory>
#include <span>
#include <vector>

#include "models/robot.hpp"
#include "noise/gaussian.hpp"
#include "noise/sensor_profile.hpp"

namespace touchdown::noise {

/// The sensors of one run. They turn ideal observations into those that sensors of this profile
/// report. The result is the same, to the bit, however the run is split into calls. Acceleration
/// without gravity is the reported acceleration minus gravity along the reported orientation. At a
/// step without a record all values are NaN, even the time. Pitch, yaw, their rates and the time
/// are not changed otherwise.
class ReportingSensors {
 public:
  ReportingSensors(const SensorProfile& profile, const NoiseKey& key, double period);
  ~ReportingSensors();
  ReportingSensors(ReportingSensors&&) noexcept;
  ReportingSensors& operator=(ReportingSensors&&) noexcept;

  /// Processes the next steps of the run in place.
  void report(std::span<models::Observation> next);

 private:
  class Reporter;
  std::unique_ptr<Reporter> reporter_;  ///< null for ideal sensors
};

/// Shifts targets of positions by the zeros of the joints that sensors of this profile have in a
/// run: a servo tracks its target with the position that it reports.
void report_targets(const SensorProfile& profile, const NoiseKey& key,
                    std::span<models::Action> actions);

/// The same for all steps of a run.
void report_through(const SensorProfile& profile, const NoiseKey& key, double period,
                    std::vector<models::Observation>& observations);

}  // namespace touchdown::noise
