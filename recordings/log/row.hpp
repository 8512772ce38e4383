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
  /// Only where the log has the true state of the base. A log that counts contact points but
  /// knows no forces has a normal force of 0 or infinity, one without contacts has NaN.
  std::optional<models::GroundTruth> truth;
};

/// Which of the values a record had.
using LogPresence = std::bitset<log_slot::count>;

/// The row as flat numbers, without loss. `truth` may be null.
LogValues to_values(const models::Observation& observation, const models::Action& action,
                    const models::GroundTruth* truth);

/// The inverse; what is absent gets its default or is derived from the IMU.
LogRow to_row(const LogValues& values, const LogPresence& present);

}  // namespace touchdown::recordings
