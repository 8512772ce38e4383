#pragma once

#include <array>
#include <cstdint>

#include "recordings/log/row.hpp"

namespace touchdown::recordings {

/// Completes records in which a servo did not report: its numbers are held from the last record
/// that has them, for as long as estimators bridge a gap (20 ms), and are NaN afterwards. Upkie's
/// spine tolerates such failures, too.
class HeldServos {
 public:
  HeldServos();

  /// Fills in the missing numbers of servos. Returns false for a record that lacks other needed
  /// keys or most servos, and before the first whole record: nothing is held then.
  bool complete(LogValues& values, LogPresence& present);
  /// Remembers the numbers of a record that has them all.
  void remember(const LogValues& values, const LogPresence& present);

  /// Records that were completed by held numbers, the largest age of a held number (s), and records
  /// with numbers that are missing for longer.
  std::uint64_t records() const { return records_; }
  double oldest() const { return oldest_; }
  std::uint64_t lost() const { return lost_; }

 private:
  static constexpr std::size_t count = log_slot::imu_orientation - log_slot::servo;

  LogPresence needed_;
  bool is_started_ = false;
  std::array<double, count> value_ = {};
  std::array<double, count> time_ = {};  ///< of the value (s)
  std::uint64_t records_ = 0;
  std::uint64_t lost_ = 0;
  double oldest_ = 0.0;
};

}  // namespace touchdown::recordings
