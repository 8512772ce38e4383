#include "recordings/beliefs/contact_intervals.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/yaml.hpp"
#include "recordings/beliefs/numbers_csv.hpp"

namespace touchdown::recordings {

namespace {

constexpr const char* expected_columns =
    "expected start, end and contact, or start, end, left and right";

/// Where each number of a stretch stands in a row.
struct StretchColumns {
  std::size_t start = 0, end = 0;
  std::array<std::size_t, models::wheel_count> contact = {};
};

std::optional<WrongBelief> place_columns(std::span<const std::string> names,
                                         StretchColumns& columns) {
  static const std::vector<std::string> known = {"start", "end", "contact", "left", "right"};
  std::array<std::optional<std::size_t>, 5> place;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = std::find(known.begin(), known.end(), names[i]);
    if (found == known.end()) {
      return WrongBelief{i, fmt::format("unknown name '{}'{}: {}", names[i],
                                        did_you_mean(names[i], known), expected_columns)};
    }
    auto& here = place.at(static_cast<std::size_t>(found - known.begin()));
    if (here) return WrongBelief{i, fmt::format("'{}' is there already", names[i])};
    here = i;
  }
  const bool is_of_both = place[2] && !place[3] && !place[4];
  const bool is_of_each = !place[2] && place[3] && place[4];
  if (!place[0] || !place[1] || !(is_of_both || is_of_each)) {
    return WrongBelief{names.size(), expected_columns};
  }
  columns = {*place[0], *place[1], {*place[is_of_both ? 2 : 3], *place[is_of_both ? 2 : 4]}};
  return std::nullopt;
}

std::optional<WrongBelief> stretch_of(std::span<const double> values, const StretchColumns& columns,
                                      ContactInterval& stretch) {
  stretch.start = values[columns.start];
  stretch.end = values[columns.end];
  if (!std::isfinite(stretch.start)) {
    return WrongBelief{columns.start, "start: expected a time in seconds"};
  }
  if (!(std::isfinite(stretch.end) && stretch.end > stretch.start)) {
    return WrongBelief{columns.end, fmt::format("end: {}: expected a time after the start, {}",
                                                stretch.end, stretch.start)};
  }
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    const double value = values[columns.contact[wheel]];
    if (value != 0.0 && value != 1.0) {
      return WrongBelief{columns.contact[wheel],
                         fmt::format("{}: expected 1 for contact or 0 for none", value)};
    }
    stretch.contact[wheel] = value == 1.0;
  }
  return std::nullopt;
}

/// The first stretch that starts after a time.
template <typename Stretches>
auto first_after(Stretches& stretches, double time) {
  return std::upper_bound(stretches.begin(), stretches.end(), time,
                          [](double t, const ContactInterval& one) { return t < one.start; });
}

/// Puts a stretch where it belongs among those before, or says which one is in its way.
std::optional<WrongBelief> insert(const ContactInterval& stretch, std::size_t start_column,
                                  std::vector<ContactInterval>& stretches) {
  const auto next = first_after(stretches, stretch.start);
  const ContactInterval* in_the_way = nullptr;
  if (next != stretches.end() && next->start < stretch.end) in_the_way = &*next;
  if (next != stretches.begin() && std::prev(next)->end > stretch.start) {
    in_the_way = &*std::prev(next);
  }
  if (in_the_way != nullptr) {
    return WrongBelief{start_column, fmt::format("{} to {} overlaps with {} to {}", stretch.start,
                                                 stretch.end, in_the_way->start, in_the_way->end)};
  }
  stretches.insert(next, stretch);
  return std::nullopt;
}

}  // namespace

const ContactInterval* ContactIntervals::at(double time) const {
  const auto after = first_after(intervals, time);
  if (after == intervals.begin()) return nullptr;
  const ContactInterval& before = *std::prev(after);
  return time < before.end ? &before : nullptr;
}

ContactIntervals read_contact_intervals(const std::filesystem::path& path) {
  ContactIntervals read{path.string(), {}};
  StretchColumns columns;
  read_numbers_csv(
      path, {[&](std::span<const std::string> names) { return place_columns(names, columns); },
             [&](std::span<const double> values, std::size_t /*line*/) {
               ContactInterval stretch;
               const std::optional<WrongBelief> wrong = stretch_of(values, columns, stretch);
               return wrong ? wrong : insert(stretch, columns.start, read.intervals);
             }});
  if (read.intervals.empty()) {
    throw InputError(fmt::format("{}:1:1: holds no stretch of contact", path.string()));
  }
  return read;
}

std::string to_csv(const ContactIntervals& intervals) {
  Table table{{"start", "end", "left", "right"}, {}};
  for (const ContactInterval& one : intervals.intervals) {
    table.rows.push_back(
        {exact(one.start), exact(one.end), one.contact[0] ? "1" : "0", one.contact[1] ? "1" : "0"});
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

}  // namespace touchdown::recordings
