#include "logs/bags/source_join.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace touchdown::logs {

SourceJoin::SourceJoin(Config config, Emit emit)
    : config_(std::move(config)), emit_(std::move(emit)) {
  std::size_t offset = 0;
  for (const std::size_t width : config_.widths) {
    Source& source = sources_.emplace_back();
    source.offset = offset;
    source.width = width;
    offset += width;
  }
  joined_.resize(offset);
}

void SourceJoin::add(std::size_t index, double arrival, double time, std::span<const double> row,
                     std::uint64_t position) {
  if (!std::isfinite(time)) return;
  Source& source = sources_[index];
  if (source.report.rows++ == 0) source.report.first = time;
  source.report.last = time;
  if (index == config_.clock) {
    insert({arrival, time, position, {row.begin(), row.end()}});
  } else {
    source.by_arrival.push_back(
        source.held.insert({time, Held{arrival, {row.begin(), row.end()}}}));
  }
  while (!pending_.empty() && pending_.front().arrival + arrival_window < arrival) {
    emit(pending_.front());
    pending_.pop_front();
  }
  // A source must not fill the memory while the joints have no rows.
  const double oldest = (pending_.empty() ? arrival : pending_.front().arrival) - arrival_window -
                        config_.stale_after;
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

/// Adds the source's values to the joined row. Returns false if it has not had any so far.
bool SourceJoin::hold(Source& source, const Pending& pending) {
  const auto to = joined_.begin() + static_cast<std::ptrdiff_t>(source.offset);
  auto latest = source.held.upper_bound(pending.time);
  if (latest != source.held.begin()) {
    --latest;
    const double age = pending.time - latest->first;
    if (age <= config_.stale_after) {
      source.has_begun = true;
      source.report.ages.add(age);
      std::copy(latest->second.row.begin(), latest->second.row.end(), to);
      return true;
    }
  }
  std::fill_n(to, source.width, std::numeric_limits<double>::quiet_NaN());
  if (source.has_begun) ++source.report.stale;
  return source.has_begun;
}

void SourceJoin::emit(const Pending& pending) {
  bool has_begun = true;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (i != config_.clock) has_begun = hold(sources_[i], pending) && has_begun;
  }
  if (!has_begun) {
    ++rows_before_;
    return;
  }
  std::copy(pending.row.begin(), pending.row.end(),
            joined_.begin() + static_cast<std::ptrdiff_t>(sources_[config_.clock].offset));
  ++rows_;
  emit_(joined_, pending.position);
}

void SourceJoin::finish() {
  for (const Pending& pending : pending_) emit(pending);
  pending_.clear();
}

}  // namespace touchdown::logs
