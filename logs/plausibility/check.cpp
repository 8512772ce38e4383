#include "logs/plausibility/check.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace touchdown::logs {

void Findings::add(std::string_view subject, const std::string& finding) {
  auto found = std::ranges::find(findings_, finding, &Finding::text);
  if (found == findings_.end()) found = findings_.insert(findings_.end(), {finding, {}});
  found->subjects.emplace_back(subject);
}

std::vector<std::string> Findings::lines() const {
  std::vector<std::string> lines;
  for (const Finding& finding : findings_) {
    lines.push_back(fmt::format("{}: {}", fmt::join(finding.subjects, ", "), finding.text));
  }
  return lines;
}

PlausibilityCheck::PlausibilityCheck(double period, const CheckedRobot& robot, double start,
                                     const QuaternionReading& reading)
    : windows_(period, reading),
      clock_(period, start),
      held_(period),
      joint_range_(robot),
      relations_(reading),
      lateness_(period),
      load_(robot.legs.value_or(LegGeometry{}), robot.legs.has_value()) {}

void PlausibilityCheck::add(const models::Observation& reported, const ServoTargets& targets) {
  clock_.add(reported.time);
  held_.add(reported);
  constant_.add(reported);
  stopped_.add(reported);
  // One value beyond its sensor's range would be the mean of a whole window.
  const models::Observation record = sensor_range_.add(reported);
  joint_range_.add(record);
  chatter_.add(record);
  lateness_.add(record);
  const std::optional<CheckedWindow> window = windows_.add(record, targets);
  if (!window) return;
  relations_.add(*window);
  load_.add(*window);
  if (const std::optional<CheckedWindow> stretch = still_.add(*window)) {
    relations_.add_still(*stretch);
    load_.add_still(*stretch);
  }
}

std::vector<std::string> PlausibilityCheck::findings() const {
  Findings findings;
  clock_.report(findings);
  const bool has_signs = held_.report(findings);
  const bool measures_acceleration = constant_.report(findings);
  stopped_.report(findings);
  sensor_range_.report(findings);
  chatter_.report(findings);
  const bool has_positions = joint_range_.report(findings);
  relations_.report(findings, measures_acceleration);
  // The wheels of a robot that hangs follow its swinging.
  if (!load_.hangs()) lateness_.report(findings);
  // A leg's load follows from its pose, its torques with their signs, and the vertical.
  if (has_positions && has_signs && relations_.is_upright() && !constant_.lacks_hips()) {
    load_.report(findings, relations_.drives());
  }
  return findings.lines();
}

}  // namespace touchdown::logs
