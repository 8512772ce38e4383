#include "logs/bags/source_join.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace touchdown::logs {

void SourceRows::add(double arrival, double time, std::span<const double> row,
                     std::uint64_t position) {
  if (!std::isfinite(time)) return;
  rows.push_back({time, arrival, position, values.size()});
  values.insert(values.end(), row.begin(), row.end());
}

SourceJoin::SourceJoin(std::vector<SourceRows> sources, Config config)
    : config_(std::move(config)), sources_(sources.size()) {
  for (const std::vector<std::size_t>& columns : config_.columns) width_ += columns.size();
  for (std::size_t i = 0; i < sources.size(); ++i) {
    Source& source = sources_[i];
    source.all = std::move(sources[i]);
    std::deque<SourceRows::Row>& rows = source.all.rows;
    std::ranges::stable_sort(rows, {}, &SourceRows::Row::arrival);
    if (!rows.empty()) source.report = {rows.size(), rows.front().time, rows.back().time, {}, 0};
    if (i != config_.clock) std::ranges::stable_sort(rows, {}, &SourceRows::Row::time);
  }
  sort_joints();
}

void SourceJoin::sort_joints() {
  std::deque<SourceRows::Row>& rows = sources_[config_.clock].all.rows;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    std::size_t at = i;
    while (at > 0 && rows[at - 1].time > rows[i].time &&
           rows[at - 1].time <= rows[i].time + largest_disorder) {
      --at;
    }
    const auto place = [&](std::size_t k) { return rows.begin() + static_cast<std::ptrdiff_t>(k); };
    std::rotate(place(at), place(i), place(i + 1));
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

/// The source's row of this time, or the last one before it; null if it is stale.
const SourceRows::Row* SourceJoin::latest(const SourceRows& source,
                                          const SourceRows::Row& joints) const {
  constexpr double rounding = 1e-6;  // s: of times since 1970
  auto at = std::ranges::upper_bound(source.rows, joints.time, {}, &SourceRows::Row::time);
  while (at != source.rows.begin() &&
         joints.time - (--at)->time <= config_.stale_after + rounding) {
    if (std::abs(at->arrival - joints.arrival) <= arrival_window + config_.stale_after) return &*at;
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
