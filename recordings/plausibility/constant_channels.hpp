#pragma once

#include <array>
#include <cstdint>

#include "models/robot.hpp"
#include "recordings/plausibility/findings.hpp"

namespace touchdown::recordings {

/// Finds channels that report the same number throughout a log, or often none: a dead sensor, or a
/// column that was filled with zeros. A position may rest; it counts only if its joint reports that
/// it moves.
class ConstantChannels {
 public:
  void add(const models::Observation& record);
  void report(Findings& findings) const;
  /// Whether both hips are 0 throughout: a mapping with `hip: none` fills in joints that the robot
  /// lacks.
  bool lacks_hips() const;

 private:
  /// One number per record.
  struct Channel {
    double first = 0.0;
    double sum_of_sizes = 0.0;
    std::int64_t count = 0;
    std::int64_t missing = 0;
    bool changes = false;

    void add(double value);
    bool is_constant() const;
    bool is_zero() const { return is_constant() && first == 0.0; }
  };
  struct Joint {
    Channel position;
    Channel velocity;
    Channel torque;

    bool is_zero() const { return position.is_zero() && velocity.is_zero() && torque.is_zero(); }
  };

  static void report_missing(std::string_view subject, const char* channel, const Channel& of_log,
                             Findings& findings);
  void report_joint(std::size_t servo, Findings& findings) const;
  static void report_vector(const char* name, const std::array<Channel, 3>& axes,
                            Findings& findings);

  std::array<Joint, models::servo_count> joints_;
  std::array<Channel, 4> orientation_;
  std::array<Channel, 3> angular_velocity_;
  std::array<Channel, 3> linear_acceleration_;
};

}  // namespace touchdown::recordings
