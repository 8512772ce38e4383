#pragma once

#include <optional>
#include <string>
#include <vector>

#include "logs/plausibility/chatter.hpp"
#include "logs/plausibility/rules.hpp"

namespace touchdown::logs {

/// Checks whether the signals of a log can be those of a wheeled biped. It reads the log record by
/// record, in constant memory. A finding is one line: the channel, what is wrong about it, and the
/// likely cause. The recordings of a simulated robot have no findings, also with bad sensors
/// (noise/profiles/harsh.yaml).
class PlausibilityCheck {
 public:
  /// `period`: between two records (s).
  explicit PlausibilityCheck(double period, const CheckedRobot& robot = {});

  /// `targets`: the commands of the step before.
  void add(const models::Observation& reported, const ServoTargets& targets = {});

  /// One line per finding so far.
  std::vector<std::string> findings() const;

 private:
  WindowCollector windows_;
  StillStretches still_;
  ClockCheck clock_;
  ConstantChannels constant_;
  StoppedChannels stopped_;
  SensorRangeCheck sensor_range_;
  JointRangeCheck joint_range_;
  JointMotionCheck motion_;
  ServoLawCheck servo_law_;
  TurningCheck turning_;
  DrivingCheck driving_;
  GravityCheck gravity_;
  LoadCheck load_;
  ChatterCheck chatter_;
};

}  // namespace touchdown::logs
