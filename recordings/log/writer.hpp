#pragma once

#include <ostream>

#include "recordings/log/keys.hpp"
#include "recordings/log/packing.hpp"
#include "recordings/log/row.hpp"
#include "recordings/recording.hpp"

namespace touchdown::recordings {

/// Which ground truth a log holds.
enum class WrittenTruth : int { none, of_robot, of_robot_and_joints };

/// The truth that a run knows: of the joints where its actuators are not ideal.
WrittenTruth truth_of(const Recording& recording);

/// Writes a log in Upkie's layout, row by row, at a constant memory: one MessagePack map per
/// control step, ground truth under `observation.sim`, `info` under `config.touchdown` of the first
/// record. Reading it back gives the same bits. Wrap it in `write_atomically` to get a file whole
/// or not at all.
class LogWriter {
 public:
  /// Every row must have the ground truth that is to be written. `stream` must outlive the writer.
  LogWriter(std::ostream& stream, RecordingInfo info, WrittenTruth truth);
  /// A robot's log: nobody says where it comes from, and its records have the values that are
  /// `present`, a vector's by its first number.
  LogWriter(std::ostream& stream, const LogPresence& present);

  /// Errors: `Error` when the stream fails or the ground truth is missing.
  void write(const models::Observation& observation, const models::Action& action,
             const models::GroundTruth* truth);
  /// As above, a row as flat numbers.
  void write(const LogValues& values);

  /// Writes the info of a run that had no steps; does nothing after a `write`.
  void finish();

 private:
  void pack_node(int node, const LogValues& values);
  void pack_value(const LogKey& key, const LogValues& values);
  void flush();

  std::ostream& stream_;
  RecordingInfo info_;
  bool with_truth_ = false;
  bool is_first_ = true;
  LogKeyTree tree_;
  msgpack::sbuffer buffer_;
  LogPacker packer_;
};

}  // namespace touchdown::recordings
