#include <cmath>

#include <fmt/format.h>

#include "logs/plausibility/channels.hpp"

namespace touchdown::logs {

void ChatterCheck::add(const models::Observation& record) {
  constexpr double averaged = 40.0;  // records: shorter than the flight of a 10 cm drop
  constexpr double least = 0.1;      // N·m: damped wheels alternate in their last digits
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    Joint& joint = joints_[i];
    const double torque = record.servo[i].torque;
    const bool changes = torque * joint.last < 0.0 && std::abs(torque - joint.last) > least;
    joint.changing += (static_cast<double>(changes) - joint.changing) / averaged;
    joint.last = torque;
    if (joint.changing < 0.85 || joint.cycles) continue;
    joint.cycles = true;
    if (std::isnan(since_)) since_ = record.time;
  }
}

void ChatterCheck::report(Findings& findings) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (!joints_[i].cycles) continue;
    findings.add(models::servo_names.at(i),
                 fmt::format("torque changes its sign in most records at {} s: a limit cycle, "
                             "are the servo's gains too high for its rate",
                             fixed(since_, 1)));
  }
}

}  // namespace touchdown::logs
