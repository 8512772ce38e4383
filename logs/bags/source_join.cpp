#include "logs/bags/source_join.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace touchdown::logs {

void SourceRows::add(double arrival, double time, std::span<const double> row,
                     std::uint64_t position) {
  if (!std::isfinite(time)) {
    if (without_time++ == 0) first_without_time = position;
    return;
  }
  rows.push_back({time, arrival, position, values.size()});
  values.insert(values.end(), row.begin(), row.end());
}

namespace {

using Rows = std::deque<SourceRows::Row>;

/// Rows in front of a step back and behind it that are wrong, if the clock did not start again.
struct WrongRows {
  std::size_t before = 0;
  std::size_t behind = 0;
};

/// Whether the clock goes on from `latest` at this row, and at most of those behind it, of which
/// one may be wrong, too.
bool goes_on(const Rows& rows, std::size_t next, double latest) {
  constexpr std::size_t looked_at = 2 * SourceJoin::longest_error;
  const auto is_later = [&](std::size_t i) {
    return rows[i].time >= latest - SourceJoin::largest_disorder;
  };
  if (next >= rows.size() || !is_later(next)) return false;
  const std::size_t end = std::min(next + looked_at, rows.size());
  std::size_t later = 0;
  for (std::size_t i = next; i < end; ++i) later += is_later(i) ? 1 : 0;
  return 2 * later > end - next;
}

/// `latest` has the latest time up to each row of the recording before the step. Empty if few wrong
/// rows do not explain it.
std::optional<WrongRows> wrong_rows(std::span<const double> latest, const Rows& rows,
                                    std::size_t step) {
  for (std::size_t count = 1; count <= SourceJoin::longest_error; ++count) {
    for (std::size_t before = 0; before <= std::min(count, latest.size() - 1); ++before) {
      const std::size_t next = step + count - before;
      if (goes_on(rows, next, latest[latest.size() - 1 - before])) {
        return WrongRows{before, count - before};
      }
    }
  }
  if (latest.size() <= SourceJoin::longest_error) return WrongRows{latest.size(), 0};
  if (rows.size() - step <= SourceJoin::longest_error) return WrongRows{0, rows.size() - step};
  return std::nullopt;
}

}  // namespace

ClockSteps split_recordings(std::deque<SourceRows::Row>& rows) {
  ClockSteps steps;
  std::vector<double> latest;  // up to each row of the recording
  std::size_t kept = 0;
  double span = 0.0;
  const auto leave_out = [&](std::size_t from, std::size_t count) {
    if (count > 0 && steps.left_out == 0) steps.first_left_out = rows[from];
    steps.left_out += count;
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!latest.empty() && rows[i].time < latest.back() - SourceJoin::largest_disorder) {
      if (steps.steps_back++ == 0) steps.first_back = rows[i];
      if (const std::optional<WrongRows> wrong = wrong_rows(latest, rows, i)) {
        leave_out(kept - wrong->before, wrong->before);
        leave_out(i, wrong->behind);
        kept -= wrong->before;
        latest.resize(latest.size() - wrong->before);
        i += wrong->behind;
        if (i == rows.size()) break;
      } else {
        steps.restarts.push_back(rows[i].position);
        span += latest.back() - rows[kept - latest.size()].time;
        latest.clear();
      }
    }
    latest.push_back(latest.empty() ? rows[i].time : std::max(latest.back(), rows[i].time));
    rows[kept] = rows[i];
    rows[kept++].recording = steps.restarts.size();
  }
  constexpr std::uint64_t few = 3;
  constexpr double shortest = 0.5;  // s, of recordings that somebody keeps
  const auto restarts = static_cast<double>(steps.restarts.size());
  steps.is_scrambled = steps.left_out > few + rows.size() / 20 ||
                       (steps.restarts.size() >= few && span < shortest * restarts);
  rows.resize(kept);
  return steps;
}

SourceJoin::SourceJoin(std::vector<SourceRows> sources, Config config)
    : config_(std::move(config)), sources_(sources.size()) {
  for (const std::vector<std::size_t>& columns : config_.columns) width_ += columns.size();
  for (std::size_t i = 0; i < sources.size(); ++i) {
    Source& source = sources_[i];
    source.all = std::move(sources[i]);
    Rows& rows = source.all.rows;
    const bool is_clock = i == config_.clock;
    std::ranges::stable_sort(rows, {}, &SourceRows::Row::arrival);
    if (is_clock || !config_.has_arrival) source.report.steps = split_recordings(rows);
    if (!rows.empty()) {
      source.report.first = rows.front().time;
      source.report.last = rows.back().time;
    }
    std::ranges::stable_sort(rows, {}, &SourceRows::Row::time);
    if (is_clock) std::ranges::stable_sort(rows, {}, &SourceRows::Row::recording);
  }
}

bool SourceJoin::next(std::vector<double>& row) {
  const Source& joints = sources_[config_.clock];
  while (next_ < joints.all.rows.size()) {
    const SourceRows::Row& given = joints.all.rows[next_++];
    row.resize(width_);
    bool has_begun = true;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (i != config_.clock) has_begun = hold(i, given, row) && has_begun;
    }
    if (!has_begun) {
      ++rows_before_;
      continue;
    }
    std::size_t from = given.first;
    for (const std::size_t column : config_.columns[config_.clock]) {
      row[column] = joints.all.values[from++];
    }
    position_ = given.position;
    ++rows_;
    return true;
  }
  return false;
}

bool SourceJoin::are_together(const SourceRows::Row& one, const SourceRows::Row& other) const {
  if (!config_.has_arrival) return one.recording == other.recording;
  return std::abs(one.arrival - other.arrival) <= arrival_window + config_.stale_after;
}

/// The source's row of this time, or the last one before it; null if it is stale.
const SourceRows::Row* SourceJoin::latest(const SourceRows& source,
                                          const SourceRows::Row& joints) const {
  constexpr double rounding = 1e-6;  // s: of times since 1970
  auto at = std::ranges::upper_bound(source.rows, joints.time, {}, &SourceRows::Row::time);
  while (at != source.rows.begin() &&
         joints.time - (--at)->time <= config_.stale_after + rounding) {
    if (are_together(*at, joints)) return &*at;
  }
  return nullptr;
}

/// Writes the source's values into the joined row. Returns false if it has not had any so far.
bool SourceJoin::hold(std::size_t index, const SourceRows::Row& joints, std::vector<double>& row) {
  Source& source = sources_[index];
  const SourceRows::Row* const held = latest(source.all, joints);
  if (held != nullptr) {
    source.has_begun = true;
    source.report.ages.add(joints.time - held->time);
  } else if (source.has_begun) {
    ++source.report.stale;
  }
  std::size_t from = held == nullptr ? 0 : held->first;
  for (const std::size_t column : config_.columns[index]) {
    row[column] =
        held == nullptr ? std::numeric_limits<double>::quiet_NaN() : source.all.values[from++];
  }
  return source.has_begun;
}

}  // namespace touchdown::logs
