#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "logs/held_number.hpp"
#include "logs/mapping/mapping.hpp"

namespace touchdown::logs {

/// Returns the position of a row, for messages.
using SourceLocation = std::function<std::string()>;

/// Receives another robot's log. `wanted` selects columns from the names; if it selects none, only
/// the names are read. `row` then receives the numbers of these columns row by row; empty cells are
/// NaN.
struct SourceLogSink {
  std::function<std::vector<SourceColumn>(const SourceNames& names)> wanted;
  std::function<void(std::span<const double> row, const SourceLocation& place)> row;
  /// Gets a line about rows that were left out; may be empty.
  std::function<void(const std::string& line)> note = {};
};

/// Reads the wanted columns of a log by its extension: comma-separated values (a line of names,
/// then a line per row) or NumPy's arrays. Errors: exceptions of the sink, and `InputError` with
/// file:line:column, or file and array, for
/// - another extension;
/// - a cell that is not a number;
/// - rows or arrays of different length, or an array without the wanted columns.
void read_source_log(const std::filesystem::path& path, const SourceLogSink& sink);

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
    HeldNumber last = {};
  };
  void add(const MappedSignal& signal, bool is_of_joint);

  std::vector<Held> held_;
  std::uint64_t completed_ = 0;
  std::uint64_t without_joints_ = 0;
  double oldest_ = 0.0;
};

/// Receives the rows of a log with several sources. `mapping` gets the names of their columns.
/// `row` then receives the numbers of `LogMapping::columns`, joined at the joints' clock.
struct JoinedLogSink {
  std::function<const LogMapping&(std::span<const SourceNames> sources)> mapping;
  std::function<void(std::span<const double> row, const SourceLocation& place)> row;
};

/// Reads a log with several sources: files of one folder (`log` is the folder, or one of them), or
/// topics of a ROS 2 bag; without `sources`, the bag's only JointState and its only Imu. Each row
/// of the joints gets the latest values of the other sources. Returns one line for each thing that
/// a user should know, such as the ages of held values. Errors: `InputError` as in
/// `read_source_log`, `BagReader` and `find_signal_topics`, and for sources without a time in
/// common.
std::vector<std::string> read_joined_log(const std::filesystem::path& log,
                                         const LogSources& sources, const JoinedLogSink& sink);

}  // namespace touchdown::logs
