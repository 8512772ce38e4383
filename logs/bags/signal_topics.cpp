#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/yaml.hpp"
#include "logs/bags/bag.hpp"
#include "logs/bags/topic_rows.hpp"
#include "logs/sample_times.hpp"

namespace touchdown::logs {

std::vector<std::string> SignalTopic::columns() const {
  std::vector<std::string> names = {stamp_column, log_time_column};
  for (const std::string& joint : joints) {
    for (const char* field : joint_fields) names.push_back(fmt::format("{}/{}", joint, field));
  }
  for (std::size_t i = 0; i < width; ++i) {
    for (const char* field : joint_fields) names.push_back(fmt::format("{}[{}]", field, i));
  }
  names.insert(names.end(), numbers.begin(), numbers.end());
  return names;
}

/// Messages of one robot are recorded about as long after their stamps, whatever their topic.
std::vector<std::string> clock_notes(const SignalTopic& topic, const SignalTopic& joints) {
  constexpr double most = SignalGuardConfig{}.maximum_gap;
  const double ahead = joints.stamp_delay - topic.stamp_delay;
  // A simulation's clock has another rate, too.
  if (!(std::abs(joints.stamp_delay) < longest_delay && std::abs(ahead) > most)) return {};
  return {fmt::format(
      "{}: its stamps are {} s {} those of {} by the times of recording: are they of another "
      "computer's clock? `time: {{from: log_time}}` takes the times of recording",
      topic.name, readable(std::abs(ahead), 3), ahead > 0.0 ? "ahead of" : "behind", joints.name)};
}

namespace {

/// Messages of each topic that show its joints and stamps.
constexpr std::uint64_t enough_messages = 100;

/// Lists the topics, most of them first; for messages.
std::string listed(const std::vector<BagTopic>& topics) {
  constexpr std::size_t most = 40;
  if (topics.empty()) return "it has no topics";
  std::vector<std::string> texts;
  for (const BagTopic& topic : topics) {
    if (texts.size() == most) {
      texts.push_back(fmt::format("and {} more", topics.size() - most));
      break;
    }
    texts.push_back(fmt::format("{} ({}, {} messages)", topic.name,
                                topic.type.empty() ? "no type" : topic.type, topic.messages));
  }
  return fmt::format("it has {}", fmt::join(texts, ", "));
}

/// Reads the rest of the bag, so that its topics and their counts are complete.
std::string all_topics(BagReader& bag) {
  BagMessage message;
  while (bag.next(message)) {
  }
  return listed(bag.topics());
}

void look_at_joints(const MessageNumbers& numbers, SignalTopic& topic) {
  for (const std::string_view name : numbers.joints()) {
    if (std::find(topic.joints.begin(), topic.joints.end(), name) == topic.joints.end()) {
      topic.joints.emplace_back(name);
    }
  }
  const std::uint32_t position = numbers.lengths.at(1);
  const std::uint32_t velocity = numbers.lengths.at(2);
  const std::uint32_t effort = numbers.lengths.at(3);
  topic.width =
      std::max({topic.width, std::size_t{position}, std::size_t{velocity}, std::size_t{effort}});
  if (velocity > 0) topic.has_velocity = true;
  if (effort > 0) topic.has_effort = true;
}

/// `numbers`: of the message before.
void look_at(const BagMessage& message, SignalTopic& topic, MessageNumbers& numbers) {
  bool is_other = false;
  try {
    is_other = topic.definition->decode(message.data, numbers);
  } catch (const InputError& error) {
    topic.fault = error.what();
    return;  // counted when the rows are read
  }
  ++topic.messages;
  if (const std::int64_t stamp = numbers.stamp(); stamp != 0) {
    topic.stamp_delays.push_back(1e-9 * static_cast<double>(message.time - stamp));
  }
  if (topic.type == joint_state_type) return look_at_joints(numbers, topic);
  const bool is_imu = topic.type == imu_type;
  constexpr std::size_t orientation = 2;
  if (is_imu && !std::isnan(numbers.values.at(orientation))) topic.has_orientation = true;
  if (!is_other) return;
  const std::set<std::string> known(topic.numbers.begin(), topic.numbers.end());
  for (const std::string& path : numbers.paths) {
    const bool is_covariance = path.find("_covariance[") != std::string::npos;
    if (is_imu && (is_covariance || path.starts_with("header."))) continue;
    if (!known.contains(path)) topic.numbers.push_back(path);
  }
}

/// Reads the definition of the topic's type.
void require_readable(const BagTopic& topic, BagReader& bag, const std::filesystem::path& path,
                      SignalTopic& found) {
  found.type = topic.type;
  std::string fault = "the bag has no definition of it in .msg";
  try {
    const bool is_known = topic.type == joint_state_type || topic.type == imu_type;
    if (is_known || !topic.definition.empty()) {
      found.definition = std::make_shared<MessageType>(topic.type, topic.definition);
    }
  } catch (const InputError& error) {
    fault = error.what();
  }
  if (!found.definition) {
    throw InputError(fmt::format("{}: topic {} has the type '{}', expected {} or {}; {}: {}",
                                 path.string(), topic.name, topic.type, joint_state_type, imu_type,
                                 fault, all_topics(bag)));
  }
  if (topic.encoding != "cdr") {
    throw InputError(fmt::format(
        "{}: topic {} has messages in '{}', expected cdr: convert the bag with rosbags-convert",
        path.string(), topic.name, topic.encoding));
  }
}

}  // namespace

std::vector<SignalTopic> find_signal_topics(const std::filesystem::path& path,
                                            const std::vector<std::string>& names,
                                            const std::atomic<bool>* stop) {
  BagReader bag(path, {}, stop);
  std::vector<SignalTopic> found;
  for (const std::string& name : names) found.emplace_back().name = name;
  std::vector<MessageNumbers> numbers(found.size());
  const auto is_complete = [](const SignalTopic& topic) {
    return topic.messages >= enough_messages;
  };
  BagMessage message;
  while (!std::all_of(found.begin(), found.end(), is_complete) && bag.next(message)) {
    for (std::size_t i = 0; i < found.size(); ++i) {
      SignalTopic& one = found[i];
      const BagTopic& topic = bag.topics()[message.topic];
      if (one.name != topic.name || is_complete(one)) continue;
      // A copy: reading on moves them.
      if (one.type.empty()) require_readable(BagTopic(topic), bag, path, one);
      look_at(message, one, numbers[i]);
    }
  }
  for (SignalTopic& one : found) {
    if (!one.stamp_delays.empty()) one.stamp_delay = median(one.stamp_delays);
    if (one.messages > 0) continue;
    if (!one.type.empty()) {
      throw InputError(fmt::format("{}: no message of topic {} can be decoded: {}", path.string(),
                                   one.name, one.fault));
    }
    const std::string all = all_topics(bag);
    std::vector<std::string> known;
    for (const BagTopic& topic : bag.topics()) {
      if (topic.name != one.name) known.push_back(topic.name);  // it may be there, without messages
    }
    throw InputError(fmt::format("{}: has no message of topic {}{}: {}", path.string(), one.name,
                                 did_you_mean(one.name, known), all));
  }
  return found;
}

std::string only_topic_of_type(const std::filesystem::path& path, const std::string& type,
                               const std::atomic<bool>* stop) {
  BagReader bag(path, {}, stop);
  const std::string all = all_topics(bag);
  std::vector<std::string> names;
  bool is_there = false;
  for (const BagTopic& topic : bag.topics()) {
    if (topic.type != type) continue;
    is_there = true;
    if (topic.messages > 0) names.push_back(topic.name);
  }
  if (names.size() == 1) return names.front();
  const bool is_empty = names.empty() && is_there;
  throw InputError(fmt::format("{}: {} of {}: {}{}", path.string(),
                               is_empty        ? "has no message"
                               : names.empty() ? "has no topic"
                                               : "has more than one topic",
                               type, is_empty ? "" : "name it in the mapping's `sources`: ", all));
}

}  // namespace touchdown::logs
