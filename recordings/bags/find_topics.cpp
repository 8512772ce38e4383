#include "recordings/bags/find_topics.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/yaml.hpp"
#include "recordings/bags/bag.hpp"

namespace touchdown::recordings {

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

void look_at(const JointState& state, SignalTopic& topic) {
  for (const std::string_view name : state.name) {
    if (std::find(topic.joints.begin(), topic.joints.end(), name) == topic.joints.end()) {
      topic.joints.emplace_back(name);
    }
  }
  if (!state.velocity.empty()) topic.has_velocity = true;
  if (!state.effort.empty()) topic.has_effort = true;
}

void look_at(const ImuState& state, SignalTopic& topic) {
  if (!std::isnan(state.orientation[0])) topic.has_orientation = true;
}

template <typename State>
void look_at(const BagMessage& message, SignalTopic& topic) {
  State state;
  try {
    decode(message.data, state);
  } catch (const InputError&) {
    return;  // counted when the rows are read
  }
  look_at(state, topic);
  ++topic.messages;
  if (topic.has_stamps || state.stamp.is_zero()) return;
  topic.has_stamps = true;
  topic.stamp_delay = 1e-9 * static_cast<double>(message.time - state.stamp.time());
}

void check_readable(const BagTopic& topic, BagReader& bag, const std::filesystem::path& path) {
  if (topic.type != joint_state_type && topic.type != imu_type) {
    throw InputError(fmt::format("{}: topic {} has the type '{}', expected {} or {}: {}",
                                 path.string(), topic.name, topic.type, joint_state_type, imu_type,
                                 all_topics(bag)));
  }
  if (topic.encoding != "cdr") {
    throw InputError(fmt::format(
        "{}: topic {} has messages in '{}', expected cdr: convert the bag with rosbags-convert",
        path.string(), topic.name, topic.encoding));
  }
}

}  // namespace

std::vector<SignalTopic> find_signal_topics(const std::filesystem::path& path,
                                            const std::vector<std::string>& names) {
  BagReader bag(path);
  std::vector<SignalTopic> found;
  for (const std::string& name : names) found.emplace_back().name = name;
  const auto is_complete = [](const SignalTopic& topic) {
    return topic.messages >= enough_messages;
  };
  BagMessage message;
  while (!std::all_of(found.begin(), found.end(), is_complete) && bag.next(message)) {
    const BagTopic topic = bag.topics()[message.topic];  // a copy: reading on moves them
    for (SignalTopic& one : found) {
      if (one.name != topic.name || is_complete(one)) continue;
      if (one.type.empty()) check_readable(topic, bag, path);
      one.type = topic.type;
      if (one.type == imu_type) {
        look_at<ImuState>(message, one);
      } else {
        look_at<JointState>(message, one);
      }
    }
  }
  for (const SignalTopic& one : found) {
    if (one.messages > 0) continue;
    if (!one.type.empty()) {
      throw InputError(
          fmt::format("{}: no message of topic {} can be decoded", path.string(), one.name));
    }
    const std::string all = all_topics(bag);
    std::vector<std::string> known;
    for (const BagTopic& topic : bag.topics()) known.push_back(topic.name);
    throw InputError(fmt::format("{}: has no message of topic {}{}: {}", path.string(), one.name,
                                 did_you_mean(one.name, known), all));
  }
  return found;
}

std::string only_topic_of_type(const std::filesystem::path& path, const std::string& type) {
  BagReader bag(path);
  const std::string all = all_topics(bag);
  std::vector<std::string> names;
  for (const BagTopic& topic : bag.topics()) {
    if (topic.type == type && topic.messages > 0) names.push_back(topic.name);
  }
  if (names.size() == 1) return names.front();
  throw InputError(fmt::format("{}: {} topic of {}: name it in the mapping's `sources`: {}",
                               path.string(), names.empty() ? "has no" : "has more than one", type,
                               all));
}

}  // namespace touchdown::recordings
