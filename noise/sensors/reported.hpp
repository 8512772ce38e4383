#pragma once

#include <memory>
#include <span>
#include <vector>

#include "models/robot.hpp"
#include "noise/gaussian.hpp"
#include "noise/sensors/profile.hpp"

namespace touchdown::noise {

/// The sensors of one run. Turn what ideal sensors say, step after step, into what sensors of this
/// profile report: the same, to the bit, in however many parts a run is given to them.
/// Acceleration without gravity is what the accelerometer reports, minus gravity along the reported
/// orientation. At a step whose record is missing nothing is a number, not even the time. Pitch and
/// yaw, their rates and the clock stay as they are.
class ReportingSensors {
 public:
  ReportingSensors(const SensorProfile& profile, const NoiseKey& key, double period);
  ~ReportingSensors();
  ReportingSensors(ReportingSensors&&) noexcept;
  ReportingSensors& operator=(ReportingSensors&&) noexcept;

  /// Of the steps that come next.
  void report(std::span<models::Observation> next);

 private:
  class Reporter;
  std::unique_ptr<Reporter> reporter_;  ///< null for ideal sensors
};

/// The same for all steps of a run at once.
void report_through(const SensorProfile& profile, const NoiseKey& key, double period,
                    std::vector<models::Observation>& observations);

}  // namespace touchdown::noise
