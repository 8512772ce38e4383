#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "recordings/mapping/mapping.hpp"

namespace touchdown::recordings {

/// Completes rows in which numbers are missing, as in a table that joins topics of several rates: a
/// missing number is held from an earlier row for as long as estimators bridge a gap (20 ms). Rows
/// without any number of a joint belong to another topic; their numbers are held for the rows of
/// the joints.
class RowHold {
 public:
  explicit RowHold(const LogMapping& mapping);

  /// Fills in missing numbers of a row. `time` in seconds; without one, nothing is held. Returns
  /// whether the row has a number of a joint.
  bool complete(std::span<double> row, double time);

  /// Rows that were completed, the largest age of a held number (s), and rows without joints.
  std::uint64_t completed() const { return completed_; }
  double oldest() const { return oldest_; }
  std::uint64_t without_joints() const { return without_joints_; }

 private:
  struct Held {
    std::size_t column = 0;
    bool is_of_joint = false;
    double value = 0.0;
    double time = -std::numeric_limits<double>::infinity();
  };
  void add(const MappedSignal& signal, bool is_of_joint);

  std::vector<Held> held_;
  std::uint64_t completed_ = 0;
  std::uint64_t without_joints_ = 0;
  double oldest_ = 0.0;
};

}  // namespace touchdown::recordings
