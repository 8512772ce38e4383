#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "estimator/force/dynamic_loads.hpp"
#include "experiments/logs/robot.hpp"
#include "logs/log/contact_intervals.hpp"
#include "logs/log/reader.hpp"
#include "logs/plausibility/check.hpp"
#include "logs/signals_from.hpp"

namespace touchdown::experiments {

/// The input of an estimator at one step of a log, and the wheels' ground truth if the log or its
/// labels have it.
struct LogStep {
  Signals signals;
  /// Normal force on the left and the right wheel (N); infinite for a wheel in contact with an
  /// unknown force.
  std::optional<std::array<double, models::wheel_count>> normal_force = {};
  /// By the log itself, whatever its labels say.
  std::optional<std::array<double, models::wheel_count>> truth = {};
  DynamicLoads::Loads loads = {};  ///< that the torques give, for logs with labels
};

/// Reads a log step by step, as the inputs of an estimator.
class LogSteps {
 public:
  /// `reader` and `labels` must outlive this. `labels`, if given, replace the log's own ground
  /// truth. `robot` is the requested one, for the findings and `robot_mass`; a doubt about the
  /// log's own becomes a warning of the reader. Errors: those of the reader; `InputError` for a log
  /// with fewer than 100 steps per second, where every step would be a gap (`SignalGuardConfig`),
  /// or with more than 20,000.
  explicit LogSteps(logs::LogReader& reader, const logs::ContactIntervals* labels = nullptr,
                    const LogRobot& robot = {});
  ~LogSteps();

  /// The next step, valid until the next call; null at the end of the log.
  const LogStep* next();

  /// The log's description. The period of a robot's log is that of `logs::nominal_rate`: clocks
  /// jitter, and some estimators support only certain rates.
  const logs::RecordingInfo& info() const { return info_; }
  std::int64_t period_us() const { return info_.control_period_us; }
  double period() const { return 1.0 / sample_rate_; }
  double sample_rate() const { return sample_rate_; }
  /// For labels (kg): of the requested robot, else `scoring::robot_mass`.
  double robot_mass() const { return robot_mass_; }

  /// Number of steps so far with an IMU orientation that contradicts gravity. Their vertical
  /// acceleration is NaN.
  std::uint64_t upside_down() const { return signals_.assembler().count(RecordFault::upside_down); }

  /// What is implausible about the steps so far, and about labels that contradict the load that the
  /// torques give, one line each.
  std::vector<std::string> findings() const;

  /// Sixteen hexadecimal digits that identify the torques and accelerations so far: equal for
  /// copies of a log, whatever their format.
  std::string digest() const;

  /// Of the steps so far, the share that labels cover; 1 without labels.
  double labelled_share() const {
    return labels_ == nullptr ? 1.0 : static_cast<double>(labelled_) / static_cast<double>(steps_);
  }

  /// For the end of the log. Errors: `InputError` for labels that cover no step, or that end
  /// clearly after the log.
  void require_labels_within() const;

 private:
  class LabelCheck;

  void add_to_digest(const Signals& signals);

  logs::LogReader& reader_;
  const logs::ContactIntervals* labels_;
  logs::CheckedRobot robot_;
  double sample_rate_;
  logs::RecordingInfo info_;
  double robot_mass_;
  logs::StepSignals signals_;
  logs::PlausibilityCheck plausibility_;
  std::unique_ptr<LabelCheck> label_check_;  ///< null without labels
  std::uint64_t digest_ = 0;
  std::int64_t steps_ = 0;
  std::int64_t labelled_ = 0;  ///< steps
  LogStep step_;
};

}  // namespace touchdown::experiments
