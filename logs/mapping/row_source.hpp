#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "logs/log/notes.hpp"
#include "logs/mapping/mapping.hpp"

namespace touchdown::logs {

/// Another robot's log as rows of numbers: a CSV file, NumPy's arrays, several files with clocks of
/// their own, the topics of a ROS 2 bag, or the arrays of a robot's loop.
class RowSource {
 public:
  explicit RowSource(LogNotes& notes) : notes_(notes) {}
  RowSource(const RowSource&) = delete;
  RowSource& operator=(const RowSource&) = delete;
  virtual ~RowSource() = default;

  /// The names of the columns, of each source.
  virtual std::span<const SourceNames> names() const = 0;
  /// Selects the columns of a mapping. Call it once, before the first row.
  virtual void select(const LogMapping& mapping) = 0;
  /// Writes the selected numbers of the next row in the order of `LogMapping::columns`; empty cells
  /// are NaN. Returns false at the end.
  virtual bool next(std::vector<double>& row) = 0;
  /// Where the row is, for messages.
  virtual std::string place() const = 0;

 protected:
  LogNotes& notes() const { return notes_; }

 private:
  LogNotes& notes_;
};

/// Opens a log: a file by its extension (comma-separated values with a line of names, or NumPy's
/// arrays); with `sources` files of one folder (`log` is the folder, or one of them) or topics of a
/// ROS 2 bag; a bag without `sources` has one JointState and one Imu. Each row of the joints gets
/// the latest values of the other sources. Errors, also of `select` and `next`: `InputError` with
/// file:line:column, or file and array, for
/// - another extension;
/// - a cell that is not a number;
/// - rows or arrays of different length, or an array without the wanted columns;
/// - sources without a time in common; and as in `BagReader` and `find_signal_topics`.
/// Reading a bag ends with `Stopped` once `notes.stop` is true. `notes` must outlive the source.
std::unique_ptr<RowSource> open_rows(const std::filesystem::path& log, const LogSources& sources,
                                     LogNotes& notes);

/// Opens one file, whose columns are all of its mapping's.
std::unique_ptr<RowSource> open_file(const std::filesystem::path& file, LogNotes& notes);

}  // namespace touchdown::logs
