#include "logs/bags/source_join.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace touchdown::logs {

SourceJoin::SourceJoin(Config config)
    : config_(std::move(config)), sources_(config_.columns.size()) {
  for (const std::vector<std::size_t>& columns : config_.columns) width_ += columns.size();
}

void SourceJoin::add(std::size_t index, double arrival, double time, std::span<const double> row,
                     std::uint64_t position) {
  if (!std::isfinite(time)) return;
  Source& source = sources_[index];
  if (source.report.rows++ == 0) source.report.first = time;
  source.report.last = time;
  arrival_ = arrival;
  latest_ = index;
  if (index == config_.clock) {
    insert({arrival, time, position, {row.begin(), row.end()}});
  } else {
    source.by_arrival.push_back(
        source.held.insert({time, Held{arrival, {row.begin(), row.end()}}}));
  }
}

bool SourceJoin::pop(std::vector<double>& row) {
  while (!pending_.empty() &&
         (is_finished_ || pending_.front().arrival + arrival_window < arrival_)) {
    const Pending pending = std::move(pending_.front());
    pending_.pop_front();
    if (join(pending, row)) return true;
  }
  forget_old();
  return false;
}

/// A source must not fill the memory while the joints have no rows.
void SourceJoin::forget_old() {
  const double oldest = (pending_.empty() ? arrival_ : pending_.front().arrival) - arrival_window -
                        config_.stale_after;
  Source& source = sources_[latest_];
  while (!source.by_arrival.empty() && source.by_arrival.front()->second.arrival < oldest) {
    source.held.erase(source.by_arrival.front());
    source.by_arrival.pop_front();
  }
}

void SourceJoin::insert(Pending pending) {
  auto at = pending_.end();
  while (at != pending_.begin()) {
    const double before = std::prev(at)->time;
    if (before <= pending.time || before > pending.time + largest_disorder) break;
    --at;
  }
  // The arrivals stay in order, so that the front is due first.
  if (at != pending_.end()) pending.arrival = at->arrival;
  pending_.insert(at, std::move(pending));
}

/// Writes the source's values into the joined row. Returns false if it has not had any so far.
bool SourceJoin::hold(std::size_t index, double time, std::vector<double>& row) {
  Source& source = sources_[index];
  const std::vector<std::size_t>& columns = config_.columns[index];
  auto latest = source.held.upper_bound(time);
  if (latest != source.held.begin()) {
    --latest;
    const double age = time - latest->first;
    if (age <= config_.stale_after) {
      source.has_begun = true;
      source.report.ages.add(age);
      for (std::size_t i = 0; i < columns.size(); ++i) row[columns[i]] = latest->second.row[i];
      return true;
    }
  }
  for (const std::size_t column : columns) row[column] = std::numeric_limits<double>::quiet_NaN();
  if (source.has_begun) ++source.report.stale;
  return source.has_begun;
}

/// Returns false for a row of the joints before another source has begun.
bool SourceJoin::join(const Pending& pending, std::vector<double>& row) {
  row.resize(width_);
  bool has_begun = true;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (i != config_.clock) has_begun = hold(i, pending.time, row) && has_begun;
  }
  if (!has_begun) {
    ++rows_before_;
    return false;
  }
  const std::vector<std::size_t>& columns = config_.columns[config_.clock];
  for (std::size_t i = 0; i < columns.size(); ++i) row[columns[i]] = pending.row[i];
  position_ = pending.position;
  ++rows_;
  return true;
}

}  // namespace touchdown::logs
