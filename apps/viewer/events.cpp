#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/viewer/watch.hpp"

namespace touchdown::viewer {

using logs::LabelState;

std::vector<StepRange> ranges_of(const std::vector<std::uint8_t>& values) {
  std::vector<StepRange> ranges;
  for (std::size_t k = 0; k < values.size();) {
    std::size_t end = k + 1;
    while (end < values.size() && (values[end] != 0) == (values[k] != 0)) ++end;
    if (values[k] != 0) ranges.push_back({k, end});
    k = end;
  }
  return ranges;
}

std::array<std::vector<logs::LabelState>, models::wheel_count> labelled_contact(
    const logs::Recording& recording, const logs::ContactIntervals& labels) {
  std::array<std::vector<logs::LabelState>, models::wheel_count> contact;
  for (const models::Observation& row : recording.observation) {
    const logs::ContactInterval* const label = labels.at(row.time);
    for (std::size_t wheel = 0; wheel < contact.size(); ++wheel) {
      contact[wheel].push_back(label == nullptr        ? LabelState::unknown
                               : label->contact[wheel] ? LabelState::contact
                                                       : LabelState::air);
    }
  }
  return contact;
}

std::array<std::vector<logs::LabelState>, models::wheel_count> true_contact(
    const logs::Recording& recording, const scoring::LabelConfig& definition) {
  const auto truth = scoring::contact_labels(recording, definition);
  std::array<std::vector<logs::LabelState>, models::wheel_count> contact;
  for (std::size_t wheel = 0; wheel < contact.size(); ++wheel) {
    for (const std::uint8_t one : truth[wheel]) {
      contact[wheel].push_back(one != 0 ? LabelState::contact : LabelState::air);
    }
  }
  return contact;
}

bool is_known(const LoggedRun& run, std::size_t row) {
  const auto& [left, right] = run.contact;
  return row < std::min(left.size(), right.size()) && left[row] != LabelState::unknown &&
         right[row] != LabelState::unknown;
}

std::vector<StepRange> flights_of(const LoggedRun& run) {
  bool is_believed = !run.beliefs.empty();
  for (std::size_t k = 0; k < run.contact[0].size(); ++k) {
    is_believed = is_believed && !is_known(run, k);
  }
  const auto shortest = static_cast<std::size_t>(
      std::llround(scoring::ScoringConfig{}.minimum_flight / run.recording.period()));
  std::vector<StepRange> flights;
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    std::vector<std::uint8_t> in_air;
    if (is_believed) {
      for (const auto one : run.beliefs.front().contact[wheel]) in_air.push_back(one == 0 ? 1 : 0);
    } else {
      for (const LabelState one : run.contact[wheel]) {
        in_air.push_back(one == LabelState::air ? 1 : 0);
      }
    }
    for (const StepRange& flight : ranges_of(in_air)) {
      if (flight.end - flight.begin >= shortest) flights.push_back(flight);
    }
  }
  std::ranges::sort(flights, {},
                    [](const StepRange& flight) { return std::pair(flight.begin, flight.end); });
  return flights;
}

std::vector<StepRange> errors_of(const LoggedRun& run, std::size_t index) {
  constexpr double shortest = 0.005;  // s
  if (index >= run.beliefs.size()) return {};
  const auto& decisions = run.beliefs[index].contact;
  std::vector<std::uint8_t> wrong(run.contact[0].size());
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    const std::size_t steps = std::min(run.contact[wheel].size(), decisions[wheel].size());
    for (std::size_t k = 0; k < steps; ++k) {
      const LabelState truth = run.contact[wheel][k];
      if (truth == LabelState::unknown) continue;
      if ((truth == LabelState::contact) != (decisions[wheel][k] != 0)) wrong[k] = 1;
    }
  }
  std::vector<StepRange> errors = ranges_of(wrong);
  std::erase_if(errors, [&](const StepRange& range) {
    return static_cast<double>(range.end - range.begin) * run.recording.period() < shortest;
  });
  return errors;
}

}  // namespace touchdown::viewer
