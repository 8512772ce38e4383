#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace touchdown::logs {

/// A topic of a ROS 2 bag.
struct BagTopic {
  std::string name;
  std::string type;            ///< "sensor_msgs/msg/Imu"; empty if the bag does not give it
  std::string encoding;        ///< of its messages, "cdr" in ROS 2
  std::uint64_t messages = 0;  ///< read so far
  bool operator==(const BagTopic&) const = default;
};

/// A message of a bag.
struct BagMessage {
  std::size_t topic = 0;  ///< index among the reader's topics
  std::int64_t time = 0;  ///< when it was recorded (ns)
  std::string_view data;  ///< valid until the next message is read
};

/// Selects the topics to read, by name.
using TopicFilter = std::function<bool(std::string_view topic)>;

}  // namespace touchdown::logs
