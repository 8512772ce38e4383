#pragma once

#include <array>
#include <limits>

#include "logs/plausibility/findings.hpp"
#include "models/robot.hpp"

namespace touchdown::logs {

/// Finds servos in a limit cycle: their torque changes its sign in most records. Noise about zero
/// changes it in half of them.
class ChatterCheck {
 public:
  void add(const models::Observation& record);
  void report(Findings& findings) const;

 private:
  struct Joint {
    double last = 0.0;      ///< torque (N·m)
    double changing = 0.5;  ///< share of recent records that change the torque's sign
    bool cycles = false;
  };
  std::array<Joint, models::servo_count> joints_;
  double since_ = std::numeric_limits<double>::quiet_NaN();  ///< of the first limit cycle (s)
};

}  // namespace touchdown::logs
