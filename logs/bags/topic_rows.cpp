#include "logs/bags/topic_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"

namespace touchdown::logs {

namespace {

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

TopicRows::TopicRows(SignalTopic topic, const std::vector<std::string>& columns,
                     const Config& config)
    : topic_(std::move(topic)), config_(config), row_(columns.size()), columns_(columns) {
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
  for (std::size_t place = 0; place < topic_.width; ++place) {
    Joint joint{.name = {}, .place = place};
    for (std::size_t i = 0; i < joint_fields.size(); ++i) {
      joint.slot[i] = slot_of(columns, fmt::format("{}[{}]", joint_fields[i], place), no_slot);
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
    if (topic_.definition) {
      topic_.definition->decode(message.data, numbers_);
      take(numbers_, message.time);
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
    const auto i =
        joint.name.empty() ? joint.place : static_cast<std::size_t>(named - state.name.begin());
    const std::size_t count = std::max(
        {state.name.size(), state.position.size(), state.velocity.size(), state.effort.size()});
    const bool is_there = i < count;
    if (is_there && &joint == &joints_.front()) is_row = true;
    const auto value = [&](const std::vector<double>& values) {
      return i < values.size() ? values[i] : std::numeric_limits<double>::quiet_NaN();
    };
    put(joint.slot[0], joint.held[0], value(state.position), is_there);
    put(joint.slot[1], joint.held[1], value(state.velocity), is_there);
    put(joint.slot[2], joint.held[2], value(state.effort), is_there);
  }
  if (is_row) count_kind(state);
  return is_row;
}

/// A driver may name its joints in any order.
void TopicRows::count_kind(const JointState& state) {
  std::vector<std::string> kind(state.name.begin(), state.name.end());
  std::sort(kind.begin(), kind.end());
  constexpr std::size_t most = 16;
  if (kinds_.size() < most || kinds_.contains(kind)) ++kinds_[kind];
  if (kind != last_kind_) ++alternations_;
  last_kind_ = std::move(kind);
}

void TopicRows::take(const MessageNumbers& numbers, std::int64_t recorded) {
  if (paths_ != numbers.paths) {
    paths_ = numbers.paths;
    number_at_.clear();
    for (const std::string& column : columns_) {
      number_at_.push_back(slot_of(paths_, column, no_slot));
    }
  }
  set_time(stamp_of(numbers), recorded);
  for (std::size_t i = 0; i < row_.size(); ++i) {
    if (i == stamp_slot_ || i == log_time_slot_) continue;
    row_[i] = number_at_[i] == no_slot ? std::numeric_limits<double>::quiet_NaN()
                                       : numbers.values[number_at_[i]];
  }
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

std::vector<std::string> TopicRows::findings() const {
  std::uint64_t rows = 0;
  for (const auto& [names, count] : kinds_) rows += count;
  std::vector<std::string> kinds;
  std::uint64_t others = rows;
  for (const auto& [names, count] : kinds_) {
    constexpr std::uint64_t few = 20;  // of the rows: a driver that starts sends some others
    if (few * count < rows) continue;
    kinds.push_back(fmt::format("{} with {} names", count, names.size()));
    others = std::min(others, rows - count);
  }
  // One kind after the other: a driver that was configured anew.
  if (kinds.size() < 2 || 2 * alternations_ < others) return {};
  return {fmt::format(
      "{} kinds of messages alternate on {}: {}: do {} publishers share it, so that its rate is "
      "theirs together? Record one of them alone, or give each a topic of its own",
      kinds.size(), topic_.name, fmt::join(kinds, ", "), kinds.size())};
}

}  // namespace touchdown::logs
