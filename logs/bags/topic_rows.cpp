#include "logs/bags/topic_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "logs/sample_times.hpp"

namespace touchdown::logs {

namespace {

double seconds(std::int64_t nanoseconds) {
  constexpr std::int64_t second = 1'000'000'000;
  const std::int64_t whole = nanoseconds / second;
  return static_cast<double>(whole) + 1e-9 * static_cast<double>(nanoseconds % second);
}

constexpr std::size_t no_slot = static_cast<std::size_t>(-1);
/// Columns of a message's time are none of its numbers.
constexpr std::size_t stamp_slot = no_slot - 1, log_time_slot = no_slot - 2;

std::size_t place_in(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? no_slot : static_cast<std::size_t>(found - names.begin());
}

/// What `seconds` does not hold of it (s).
double rest_of(std::int64_t time) {
  return 1e-9 * static_cast<double>(time - nanoseconds(seconds(time)));
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return place_in(names, name) != no_slot;
}

}  // namespace

TopicRows::TopicRows(SignalTopic topic, std::vector<TopicColumn> columns, const Config& config)
    : topic_(std::move(topic)),
      config_(config),
      row_(columns.size()),
      columns_(std::move(columns)),
      held_(columns_.size()),
      has_log_time_(std::ranges::find(columns_, log_time_column, &TopicColumn::name) !=
                    columns_.end()) {}

bool TopicRows::update(const BagMessage& message) {
  bool is_other = number_at_.size() != columns_.size();  // the first message
  try {
    is_other |= topic_.definition->decode(message.data, numbers_);
  } catch (const InputError& error) {
    if (malformed_++ == 0) first_malformed_ = error.what();
    return false;
  }
  const bool are_joints = topic_.type == joint_state_type;
  is_other = is_other || (are_joints && !std::ranges::equal(names_, numbers_.joints()));
  if (is_other) find_columns();
  const std::int64_t stamp = numbers_.stamp();
  const double log_time = seconds(message.time);
  const bool lacks_stamp = stamp == 0 && std::abs(topic_.stamp_delay) < longest_delay;
  const std::int64_t stamp_ns = config_.uses_log_time || lacks_stamp ? message.time : stamp;
  const double stamp_time = seconds(stamp_ns);
  time_ = has_log_time_ ? log_time : stamp_time;
  for (std::size_t i = 0; i < row_.size(); ++i) {
    const bool is_rest = columns_[i].is_rest;
    if (number_at_[i] == stamp_slot) {
      row_[i] = is_rest ? rest_of(stamp_ns) : stamp_time;
    } else if (number_at_[i] == log_time_slot) {
      row_[i] = is_rest ? rest_of(message.time) : log_time;
    } else if (is_rest) {
      row_[i] = 0.0;
    } else {
      row_[i] = number_at_[i] == no_slot ? std::numeric_limits<double>::quiet_NaN()
                                         : numbers_.values[number_at_[i]];
      if (are_joints) hold(i);
    }
  }
  if (are_joints && is_row_) count_kind();
  return is_row_;
}

/// Finds the columns among the numbers of the message, which has other ones than the last.
void TopicRows::find_columns() {
  const std::vector<std::string>& paths = numbers_.paths;
  number_at_.clear();
  const auto add = [&](const std::string& column, const std::string& path) {
    number_at_.push_back(column == stamp_column      ? stamp_slot
                         : column == log_time_column ? log_time_slot
                                                     : place_in(paths, path));
  };
  if (topic_.type != joint_state_type) {
    for (const TopicColumn& column : columns_) add(column.name, column.name);
    return;
  }
  names_.assign(numbers_.joints().begin(), numbers_.joints().end());
  std::optional<bool> has_first;
  for (const auto& [column, is_rest] : columns_) {
    // NAME/position, or position[2]
    const std::size_t slash = column.rfind('/');
    std::string index = column.substr(std::min(column.find('['), column.size()));
    std::string field = column.substr(0, column.size() - index.size());
    if (slash != std::string::npos) {
      index = fmt::format("[{}]", place_in(names_, column.substr(0, slash)));
      field = column.substr(slash + 1);
    }
    add(column, field + index);
    if (has_first || column == stamp_column || column == log_time_column) continue;
    has_first = slash == std::string::npos
                    ? std::ranges::any_of(
                          joint_fields,
                          [&](const std::string& list) { return contains(paths, list + index); })
                    : contains(names_, column.substr(0, slash));
  }
  is_row_ = has_first.value_or(true);
}

/// Replaces a value that the message lacks by the latest one, if it is not stale.
void TopicRows::hold(std::size_t column) {
  Held& held = held_[column];
  double& number = row_[column];
  if (std::isfinite(number)) {
    held = {{{number, time_}, held[0]}};
    return;
  }
  number = std::numeric_limits<double>::quiet_NaN();
  for (const HeldNumber& one : held) {
    const std::optional<double> age = one.age(time_, config_.stale_after);
    if (!age) continue;
    number = one.value;
    ages_.add(*age);
    return;
  }
}

/// A driver may name its joints in any order.
void TopicRows::count_kind() {
  std::vector<std::string> kind = names_;
  std::sort(kind.begin(), kind.end());
  constexpr std::size_t most = 16;
  if (kinds_.size() < most || kinds_.contains(kind)) ++kinds_[kind];
  if (kind != last_kind_) ++alternations_;
  last_kind_ = std::move(kind);
}

void TopicRows::add_to(LogNotes& notes) const {
  if (malformed_ > 0) {
    notes.warnings.push_back(fmt::format("{}: {} messages are left out, the first because {}",
                                         topic_.name, malformed_, first_malformed_));
  }
  if (ages_.count() > 0) {
    notes.warnings.push_back(fmt::format(
        "{}: {} values that a message lacks are held from an earlier one, ages {:.1f} ms (median) "
        "to {:.1f} ms",
        topic_.name, ages_.count(), 1e3 * ages_.median(), 1e3 * ages_.largest()));
  }
  const std::string alternate = publishers();
  if (!alternate.empty()) notes.findings.push_back(alternate);
}

/// Kinds of messages that alternate; empty without such.
std::string TopicRows::publishers() const {
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
  return fmt::format(
      "{} kinds of messages alternate on {}: {}: do {} publishers share it, so that its rate is "
      "theirs together? Record one of them alone, or give each a topic of its own",
      kinds.size(), topic_.name, fmt::join(kinds, ", "), kinds.size());
}

}  // namespace touchdown::logs
