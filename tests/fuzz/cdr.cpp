#include "logs/bags/topic_rows.hpp"
#include "tests/fuzz/entry.hpp"

namespace touchdown::fuzz {

/// A payload in CDR, as a JointState and as an Imu, twice: the second one is held against the
/// first.
TOUCHDOWN_FUZZ(cdr) {
  for (const char* const type : {logs::joint_state_type, logs::imu_type}) {
    logs::SignalTopic topic;
    topic.type = type;
    topic.joints = {"a", "b"};
    logs::TopicRows rows(topic, topic.columns(), {});
    for (const std::int64_t time : {std::int64_t{0}, std::int64_t{1'000'000}}) {
      const bool is_row = rows.update({0, time, input});
      if (is_row && rows.malformed() > 0) __builtin_trap();
    }
  }
}

}  // namespace touchdown::fuzz
