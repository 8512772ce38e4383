#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace touchdown::logs {

/// A topic of a ROS 2 bag.
struct BagTopic {
  std::string name;
  std::string type;            ///< "sensor_msgs/msg/Imu"; empty if the bag does not give it
  std::string encoding;        ///< of its messages, "cdr" in ROS 2
  std::uint64_t messages = 0;  ///< that `BagReader` read so far
  /// Of its type, as `MessageType` reads it; empty if the bag does not give it.
  std::string definition = {};
  bool operator==(const BagTopic&) const = default;
};

/// The topics of a bag in the order in which they are found, each once.
class BagTopics {
 public:
  /// The index of a topic, which is added if it is new.
  std::size_t index_of(const BagTopic& topic) {
    const auto [known, is_new] =
        index_.try_emplace({topic.name, topic.type, topic.encoding}, all_.size());
    if (is_new) all_.push_back({topic.name, topic.type, topic.encoding, 0, topic.definition});
    return known->second;
  }
  BagTopic& operator[](std::size_t index) { return all_[index]; }
  const std::vector<BagTopic>& all() const { return all_; }

 private:
  std::vector<BagTopic> all_;
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> index_;
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
