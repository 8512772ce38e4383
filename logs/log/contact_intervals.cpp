#include "logs/log/contact_intervals.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/table.hpp"
#include "core/yaml.hpp"
#include "logs/log/numbers_csv.hpp"

namespace touchdown::logs {

namespace {

constexpr const char* expected_columns =
    "expected start, end and contact, or start, end, left and right; perhaps sure";

/// Column of each number of an interval.
struct IntervalColumns {
  std::size_t start = 0, end = 0;
  std::array<std::size_t, models::wheel_count> contact = {};
  std::optional<std::size_t> sure = {};
};

IntervalColumns find_columns(const NumbersCsv& csv) {
  static const std::vector<std::string> known = {"start", "end",   "contact",
                                                 "left",  "right", "sure"};
  const std::vector<std::string>& names = csv.names();
  std::array<std::optional<std::size_t>, 6> place;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = std::find(known.begin(), known.end(), names[i]);
    if (found == known.end()) {
      csv.complain(i, fmt::format("unknown name '{}'{}: {}", names[i],
                                  did_you_mean(names[i], known), expected_columns));
    }
    auto& here = place.at(static_cast<std::size_t>(found - known.begin()));
    if (here) csv.complain(i, fmt::format("'{}' appears twice", names[i]));
    here = i;
  }
  const bool is_of_both = place[2] && !place[3] && !place[4];
  const bool is_of_each = !place[2] && place[3] && place[4];
  if (!place[0] || !place[1] || !(is_of_both || is_of_each)) {
    csv.complain(names.size(), expected_columns);
  }
  return {*place[0], *place[1], {*place[is_of_both ? 2 : 3], *place[is_of_both ? 2 : 4]}, place[5]};
}

/// The interval of the present row.
ContactInterval interval_in(const NumbersCsv& csv, const IntervalColumns& columns) {
  const std::span<const double> values = csv.values();
  ContactInterval interval{values[columns.start], values[columns.end]};
  if (!std::isfinite(interval.start)) {
    csv.complain(columns.start, "start: expected a time in seconds");
  }
  if (!(std::isfinite(interval.end) && interval.end > interval.start)) {
    csv.complain(columns.end, fmt::format("end: {}: expected a time after the start, {}",
                                          interval.end, interval.start));
  }
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    const double value = values[columns.contact[wheel]];
    if (value != 0.0 && value != 1.0) {
      csv.complain(columns.contact[wheel],
                   fmt::format("{}: expected 1 for contact or 0 for none", value));
    }
    interval.contact[wheel] = value == 1.0;
  }
  if (columns.sure) {
    const double sure = values[*columns.sure];
    if (!(sure >= 0.0 && sure <= 1.0)) {
      csv.complain(*columns.sure, fmt::format("sure: {}: expected a probability, 0 to 1", sure));
    }
    interval.sure = sure;
  }
  return interval;
}

ContactIntervals read_rows(const std::filesystem::path& path) {
  ContactIntervals read{path.string(), {}};
  NumbersCsv csv(path);
  const IntervalColumns columns = find_columns(csv);
  std::map<double, ContactInterval> intervals;  // by start: rows of the file have any order
  while (csv.next()) {
    const ContactInterval interval = interval_in(csv, columns);
    const auto next = intervals.upper_bound(interval.start);
    const ContactInterval* overlapping = nullptr;
    if (next != intervals.end() && next->first < interval.end) overlapping = &next->second;
    if (next != intervals.begin() && std::prev(next)->second.end > interval.start) {
      overlapping = &std::prev(next)->second;
    }
    if (overlapping != nullptr) {
      csv.complain(columns.start, fmt::format("{} to {} overlaps with {} to {}", interval.start,
                                              interval.end, overlapping->start, overlapping->end));
    }
    intervals.emplace(interval.start, interval);
  }
  for (const auto& [start, interval] : intervals) read.intervals.push_back(interval);
  return read;
}

}  // namespace

double to_microsecond(double time) { return std::round(1e6 * time) / 1e6; }

const ContactInterval* ContactIntervals::at(double time) const {
  const double here = to_microsecond(time);
  const auto after = std::ranges::upper_bound(
      intervals, here, {}, [](const ContactInterval& one) { return to_microsecond(one.start); });
  if (after == intervals.begin()) return nullptr;
  const ContactInterval& before = *std::prev(after);
  const double end = to_microsecond(before.end);
  return here < end || (here == end && after == intervals.end()) ? &before : nullptr;
}

ContactIntervals read_contact_intervals(const std::filesystem::path& path) {
  ContactIntervals read = read_rows(path);
  if (read.intervals.empty()) {
    throw InputError(fmt::format("{}:1:1: contains no contact interval", path.string()));
  }
  return read;
}

ContactIntervals read_begun_intervals(const std::filesystem::path& path) {
  return is_there(path) ? read_rows(path) : ContactIntervals{path.string(), {}};
}

std::string to_csv(const ContactIntervals& intervals) {
  TextTable table{{"start", "end", "left", "right"}, {}};
  const bool has_sure = std::ranges::any_of(
      intervals.intervals, [](const ContactInterval& one) { return one.sure.has_value(); });
  if (has_sure) table.header.emplace_back("sure");
  for (const ContactInterval& one : intervals.intervals) {
    std::vector<std::string>& row = table.rows.emplace_back();
    row = {exact(to_microsecond(one.start)), exact(to_microsecond(one.end)),
           one.contact[0] ? "1" : "0", one.contact[1] ? "1" : "0"};
    if (has_sure) row.push_back(fmt::format("{:.3f}", one.sure.value_or(1.0)));
  }
  return touchdown::to_csv(table);
}

std::vector<ContactIntervals> read_contact_intervals(const std::vector<std::string>& files,
                                                     std::size_t logs) {
  if (!files.empty() && files.size() != logs) {
    throw InputError(fmt::format("labels: expected a file for each log, in their order: {} for {}",
                                 files.size(), logs));
  }
  std::vector<ContactIntervals> all;
  for (const std::string& file : files) all.push_back(read_contact_intervals(file));
  return all;
}

}  // namespace touchdown::logs
