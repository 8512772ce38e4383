#include "logs/bags/topic_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/yaml.hpp"
#include "logs/bags/bag.hpp"

namespace touchdown::logs {

namespace {

constexpr std::array<const char*, 3> joint_fields = {"position", "velocity", "effort"};
constexpr std::array<const char*, 10> imu_fields = {
    "orientation.x",         "orientation.y",        "orientation.z",      "orientation.w",
    "angular_velocity.x",    "angular_velocity.y",   "angular_velocity.z", "linear_acceleration.x",
    "linear_acceleration.y", "linear_acceleration.z"};

/// A header without a stamp was sent now, unless the clock is a simulation's, which starts at zero.
constexpr double longest_delay = 60.0;  // s

double seconds(std::int64_t nanoseconds) {
  constexpr std::int64_t second = 1'000'000'000;
  const std::int64_t whole = nanoseconds / second;
  return static_cast<double>(whole) + 1e-9 * static_cast<double>(nanoseconds % second);
}

std::size_t slot_of(const std::vector<std::string>& columns, const std::string& name,
                    std::size_t none) {
  const auto found = std::find(columns.begin(), columns.end(), name);
  return found == columns.end() ? none : static_cast<std::size_t>(found - columns.begin());
}

}  // namespace

std::vector<std::string> SignalTopic::columns() const {
  std::vector<std::string> names = {stamp_column, log_time_column};
  for (const std::string& joint : joints) {
    for (const char* field : joint_fields) names.push_back(fmt::format("{}/{}", joint, field));
  }
  if (type == imu_type) names.insert(names.end(), imu_fields.begin(), imu_fields.end());
  return names;
}

/// Messages of one robot are recorded about as long after their stamps, whatever their topic.
std::vector<std::string> clock_notes(const SignalTopic& topic, const SignalTopic& joints) {
  constexpr double most = SignalGuardConfig{}.maximum_gap;
  const double ahead = joints.stamp_delay - topic.stamp_delay;
  // A simulation's clock has another rate, too.
  if (!(std::abs(joints.stamp_delay) < longest_delay && std::abs(ahead) > most)) return {};
  return {fmt::format(
      "{}: its stamps are {:.3g} s {} those of {} by the times of recording: are they of another "
      "computer's clock? `time: {{from: log_time}}` takes the times of recording",
      topic.name, std::abs(ahead), ahead > 0.0 ? "ahead of" : "behind", joints.name)};
}

TopicRows::TopicRows(SignalTopic topic, const std::vector<std::string>& columns,
                     const Config& config)
    : topic_(std::move(topic)), config_(config), row_(columns.size()) {
  stamp_slot_ = slot_of(columns, stamp_column, no_slot);
  log_time_slot_ = slot_of(columns, log_time_column, no_slot);
  for (std::size_t i = 0; i < imu_fields.size(); ++i) {
    imu_slot_[i] = slot_of(columns, imu_fields[i], no_slot);
  }
  for (const std::string& name : topic_.joints) {
    Joint joint{name};
    for (std::size_t i = 0; i < joint_fields.size(); ++i) {
      joint.slot[i] = slot_of(columns, fmt::format("{}/{}", name, joint_fields[i]), no_slot);
    }
    joints_.push_back(std::move(joint));
  }
  // The joint of the first column is the first one.
  const auto first_slot = [](const Joint& joint) {
    return *std::min_element(joint.slot.begin(), joint.slot.end());
  };
  std::stable_sort(joints_.begin(), joints_.end(),
                   [&](const Joint& a, const Joint& b) { return first_slot(a) < first_slot(b); });
  std::erase_if(joints_, [&](const Joint& joint) { return first_slot(joint) == no_slot; });
}

void TopicRows::set_time(const MessageStamp& stamp, std::int64_t recorded) {
  const double log_time = seconds(recorded);
  const bool lacks_stamp = stamp.is_zero() && std::abs(topic_.stamp_delay) < longest_delay;
  time_ = config_.uses_log_time || lacks_stamp ? log_time : seconds(stamp.time());
  if (stamp_slot_ != no_slot) row_[stamp_slot_] = time_;
  if (log_time_slot_ != no_slot) {
    row_[log_time_slot_] = log_time;
    time_ = log_time;
  }
}

bool TopicRows::update(const BagMessage& message) {
  try {
    if (topic_.type == imu_type) {
      decode(message.data, imu_);
      set_time(imu_.stamp, message.time);
      take(imu_);
      return true;
    }
    decode(message.data, joint_state_);
  } catch (const InputError& error) {
    if (malformed_++ == 0) first_malformed_ = error.what();
    return false;
  }
  set_time(joint_state_.stamp, message.time);
  return take(joint_state_);
}

void TopicRows::put(std::size_t slot, Held& held, double value, bool is_given) {
  if (slot == no_slot) return;
  if (is_given && std::isfinite(value)) {
    row_[slot] = value;
    held = {{{value, time_}, held[0]}};
    return;
  }
  row_[slot] = std::numeric_limits<double>::quiet_NaN();
  for (const HeldNumber& one : held) {
    const std::optional<double> age = one.age(time_, config_.stale_after);
    if (!age) continue;
    row_[slot] = one.value;
    ages_.add(*age);
    return;
  }
}

bool TopicRows::take(const JointState& state) {
  bool is_row = joints_.empty();
  for (Joint& joint : joints_) {
    const auto named = std::find(state.name.begin(), state.name.end(), joint.name);
    const auto i = static_cast<std::size_t>(named - state.name.begin());
    const bool is_there = named != state.name.end();
    if (is_there && &joint == &joints_.front()) is_row = true;
    const auto value = [&](const std::vector<double>& values) {
      return is_there && !values.empty() ? values[i] : std::numeric_limits<double>::quiet_NaN();
    };
    put(joint.slot[0], joint.held[0], value(state.position), is_there);
    put(joint.slot[1], joint.held[1], value(state.velocity), is_there);
    put(joint.slot[2], joint.held[2], value(state.effort), is_there);
  }
  return is_row;
}

void TopicRows::take(const ImuState& state) {
  std::size_t field = 0;
  const auto put_all = [&](const auto& values) {
    for (const double value : values) {
      const std::size_t slot = imu_slot_.at(field++);
      if (slot != no_slot) row_[slot] = value;
    }
  };
  put_all(state.orientation);
  put_all(state.angular_velocity);
  put_all(state.linear_acceleration);
}

std::vector<std::string> TopicRows::notes() const {
  std::vector<std::string> notes;
  if (malformed_ > 0) {
    notes.push_back(fmt::format("{}: {} messages are left out, the first because {}", topic_.name,
                                malformed_, first_malformed_));
  }
  if (ages_.count() > 0) {
    notes.push_back(fmt::format(
        "{}: {} values that a message lacks are held from an earlier one, ages {:.1f} ms (median) "
        "to {:.1f} ms",
        topic_.name, ages_.count(), 1e3 * ages_.median(), 1e3 * ages_.largest()));
  }
  return notes;
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
  if (state.stamp.is_zero()) return;
  const double delay = 1e-9 * static_cast<double>(message.time - state.stamp.time());
  topic.stamp_delay = topic.has_stamps ? std::min(topic.stamp_delay, delay) : delay;
  topic.has_stamps = true;
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
                                            const std::vector<std::string>& names,
                                            const std::atomic<bool>* stop) {
  BagReader bag(path, {}, stop);
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
  for (const BagTopic& topic : bag.topics()) {
    if (topic.type == type && topic.messages > 0) names.push_back(topic.name);
  }
  if (names.size() == 1) return names.front();
  throw InputError(fmt::format("{}: {} topic of {}: name it in the mapping's `sources`: {}",
                               path.string(), names.empty() ? "has no" : "has more than one", type,
                               all));
}

}  // namespace touchdown::logs
