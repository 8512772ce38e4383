#pragma once

#include <bitset>
#include <optional>

#include "models/robot.hpp"
#include "recordings/log/keys.hpp"

namespace touchdown::recordings {

/// One control step of a log.
struct LogRow {
  models::Observation observation;
  models::Action action;
  /// Only if the log has the true state of the base. If the log has contact points but no forces,
  /// normal forces are 0 or infinity; without contacts they are NaN.
  std::optional<models::GroundTruth> truth;
};

/// Marks the values that a record has.
using LogPresence = std::bitset<log_slot::count>;

/// Converts a step to flat numbers, without loss. `truth` may be null.
LogValues to_values(const models::Observation& observation, const models::Action& action,
                    const models::GroundTruth* truth);

/// The inverse. Absent values get their default or are derived from the IMU.
LogRow to_row(const LogValues& values, const LogPresence& present);

}  // namespace touchdown::recordings
