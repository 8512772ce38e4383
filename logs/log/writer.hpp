#pragma once

#include <ostream>

#include "logs/log/packing.hpp"
#include "logs/log/row.hpp"
#include "logs/recording.hpp"

namespace touchdown::logs {

/// The ground truth that a log contains, and the motors of closed legs.
struct WrittenTruth {
  bool of_robot = false;
  bool of_joints = false;       ///< torques on the joints
  std::size_t held_joints = 0;  ///< the number of held joints
  std::size_t motors = 0;       ///< the number of motors
};

/// The ground truth that a run has. Joint torques are included if the actuators are not ideal.
WrittenTruth truth_of(const Recording& recording);

/// Marks the values of a log of touchdown with this ground truth.
LogPresence written_values(const WrittenTruth& truth);

/// Writes a log in Upkie's layout, row by row, with constant memory. Each control step is one
/// MessagePack map. Ground truth is under `observation.sim`, `info` under `config.touchdown` of the
/// first record. Reading it back gives the same bits. For files, use it within `write_atomically`.
class LogWriter {
 public:
  /// Every row must have the ground truth that `truth` specifies. `stream` must outlive the writer.
  LogWriter(std::ostream& stream, RecordingInfo info, const WrittenTruth& truth);
  /// For a robot's log: without origin, and with the values that are `present`. For a vector, its
  /// first number counts. A robot's name is under `config.robot` of the first record.
  LogWriter(std::ostream& stream, const LogPresence& present, std::string robot = {});

  /// Errors: `Error` when the stream fails or the ground truth is missing.
  void write(const models::Observation& observation, const models::Action& action,
             const models::GroundTruth* truth);
  /// The same for a row of flat numbers.
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
  bool is_first_;
  LogKeyTree tree_;
  msgpack::sbuffer buffer_;
  LogPacker packer_;
};

}  // namespace touchdown::logs
