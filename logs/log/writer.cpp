#include "logs/log/writer.hpp"

#include "core/error.hpp"

namespace touchdown::logs {

namespace {

bool is_written(const LogKey& key, const WrittenTruth& truth) {
  switch (key.role) {
    case LogKey::Role::alias:
      return false;
    case LogKey::Role::truth:
      return truth.of_robot;
    case LogKey::Role::joint_truth:
      return truth.of_joints;
    case LogKey::Role::held_truth:
      return key.slot < log_slot::held + 3 * truth.held_joints;
    case LogKey::Role::motor:
      return key.slot < log_slot::motor + 3 * truth.motors;
    default:
      return true;
  }
}

}  // namespace

WrittenTruth truth_of(const Recording& recording) {
  WrittenTruth written;
  if (!recording.observation.empty()) written.motors = recording.observation.front().motor.size();
  if (recording.truth.empty()) return written;
  const models::GroundTruth& first = recording.truth.front();
  return {true, first.joint_torque.has_value(), first.held.size(), written.motors};
}

LogPresence written_values(const WrittenTruth& truth) {
  LogPresence written;
  for (const LogKey& key : log_keys()) {
    for (std::size_t i = 0; i < key.size && is_written(key, truth); ++i) written.set(key.slot + i);
  }
  return written;
}

LogWriter::LogWriter(std::ostream& stream, RecordingInfo info, const WrittenTruth& truth)
    : LogWriter(stream, written_values(truth)) {
  info_ = std::move(info);
  info_.robot.clear();
  with_truth_ = truth.of_robot;
  is_first_ = true;
}

LogWriter::LogWriter(std::ostream& stream, const LogPresence& present, std::string robot)
    : stream_(stream),
      is_first_(!robot.empty()),
      tree_(
          [&](const LogKey& key) { return key.role != LogKey::Role::alias && present[key.slot]; }),
      packer_(buffer_) {
  info_.robot = std::move(robot);
}

void LogWriter::write(const models::Observation& observation, const models::Action& action,
                      const models::GroundTruth* truth) {
  if (with_truth_ && truth == nullptr) throw Error("a row of a simulated run has no ground truth");
  write(to_values(observation, action, truth));
}

void LogWriter::write(const LogValues& values) {
  const LogKeyTree::Node& record = tree_.node(0);
  packer_.pack_map(static_cast<std::uint32_t>(record.children.size()) + (is_first_ ? 1U : 0U));
  if (is_first_) pack_origin(packer_, info_);
  is_first_ = false;
  for (const int child : record.children) pack_node(child, values);
  flush();
}

void LogWriter::finish() {
  if (!is_first_) return;
  packer_.pack_map(1);
  pack_origin(packer_, info_);
  is_first_ = false;
  flush();
}

void LogWriter::flush() {
  stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  buffer_.clear();
  if (!stream_) throw Error("the log cannot be written: is the disk full?");
}

void LogWriter::pack_node(int index, const LogValues& values) {
  const LogKeyTree::Node& node = tree_.node(index);
  pack_text(packer_, node.name);
  if (node.key != nullptr) {
    pack_value(*node.key, values);
    return;
  }
  packer_.pack_map(static_cast<std::uint32_t>(node.children.size()));
  for (const int child : node.children) pack_node(child, values);
}

void LogWriter::pack_value(const LogKey& key, const LogValues& values) {
  if (key.is_flag) {
    values[key.slot] != 0.0 ? packer_.pack_true() : packer_.pack_false();
    return;
  }
  if (key.size > 1) packer_.pack_array(static_cast<std::uint32_t>(key.size));
  for (std::size_t i = 0; i < key.size; ++i) pack_float64(buffer_, values[key.slot + i]);
}

}  // namespace touchdown::logs
