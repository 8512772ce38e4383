#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "logs/log/byte_source.hpp"
#include "logs/log/notes.hpp"
#include "logs/log/row.hpp"
#include "logs/recording.hpp"
#include "logs/sample_times.hpp"

namespace touchdown::logs {

/// How the quaternion of a log was read, so that the other order of its numbers can be tried.
struct QuaternionReading {
  bool is_w_last = false;
  bool is_z_up = false;                                ///< its reference's z axis
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< `AssemblyConfig::axes`
};

/// The records of a log as they are, one at a time: MessagePack maps, the rows of another
/// robot's log (`mapped_records`), or a recording in memory. `LogReader` pulls them and cleans
/// their values.
class RecordSource {
 public:
  explicit RecordSource(const std::atomic<bool>* stop = nullptr) : notes_{stop} {}
  RecordSource(const RecordSource&) = delete;
  RecordSource& operator=(const RecordSource&) = delete;
  virtual ~RecordSource() = default;

  /// Proceeds to the next record. Returns false at the end.
  virtual bool next() = 0;

  virtual const LogValues& values() const = 0;
  /// The log's clock (ns).
  virtual std::int64_t stamp() const { return nanoseconds(time_of(values(), present())); }
  /// A vector is present only if the record has all of its elements.
  virtual const LogPresence& present() const = 0;
  /// The record in Upkie's layout, valid until the next one; may be empty for rows that are in
  /// another one.
  virtual std::string_view bytes() const = 0;
  /// Where the record begins in a file of such records, as "byte 120: "; empty if there is none.
  virtual std::string place() const { return {}; }
  /// Dotted paths of the needed keys that the record lacks, with the wrong value, if any:
  /// "observation.imu.orientation (3 numbers instead of 4)".
  virtual std::vector<std::string> missing() const { return {}; }

  /// Reads the origin of the log, if the present record has it: `info` of a log that touchdown
  /// wrote, or the name of the `robot`.
  virtual void read_origin(std::optional<RecordingInfo>& info, std::string& robot) const = 0;
  virtual QuaternionReading quaternion_reading() const { return {}; }

  LogNotes& notes() { return notes_; }
  const LogNotes& notes() const { return notes_; }

 private:
  LogNotes notes_;
};

/// The records of a log in MessagePack, without building them in memory. Unknown keys are skipped.
/// Errors: `InputError` for an empty log, and for bytes that are not MessagePack maps.
std::unique_ptr<RecordSource> packed_records(ByteSource source, std::string name);

}  // namespace touchdown::logs
