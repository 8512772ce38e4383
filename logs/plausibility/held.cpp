#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string>

#include <fmt/format.h>

#include "logs/plausibility/check.hpp"

namespace touchdown::logs {

namespace {

constexpr std::array<const char*, 3> joint_channel_names = {"position", "velocity", "torque"};
constexpr std::array<const char*, 3> imu_channel_names = {"orientation", "angular_velocity",
                                                          "linear_acceleration"};
constexpr std::int64_t few_changes = 60;
constexpr double least_period = 1.8;  // records
constexpr double few_records = 300;

}  // namespace

void HeldChannels::Channel::add(bool changes) {
  ++gap;
  if (!changes) return;
  if (is_started) ++gaps.at(std::min(gap, longest));
  is_started = true;
  gap = 0;
}

bool HeldChannels::Channel::is_constant() const {
  return std::reduce(gaps.begin(), gaps.end()) < few_changes;
}

double HeldChannels::Channel::period() const {
  const std::int64_t changes = std::reduce(gaps.begin(), gaps.end());
  std::int64_t below = 0;
  std::size_t middle = 0;
  while (middle < longest && 2 * (below += gaps.at(middle)) < changes) ++middle;
  double alike = 0.0;
  double sum = 0.0;
  for (std::size_t i = std::max<std::size_t>(middle, 1) - 1; i <= std::min(middle + 1, longest);
       ++i) {
    alike += static_cast<double>(gaps.at(i));
    sum += static_cast<double>(i) * static_cast<double>(gaps.at(i));
  }
  const double mean = sum / std::max(1.0, alike);
  // Gaps of 2 and 3 records are those of one rate, gaps of 1 to 3 any ones.
  const auto low = static_cast<std::size_t>(mean + 0.02);
  const double fitting = static_cast<double>(
      gaps.at(low) +
      (low < longest && mean - static_cast<double>(low) > 0.02 ? gaps.at(low + 1) : 0));
  constexpr double nearly_all = 0.9;
  return middle < longest && fitting >= nearly_all * static_cast<double>(changes) ? mean : 0.0;
}

std::size_t HeldChannels::Alternation::publishers(double records) const {
  constexpr double least = 1e-4;   // rad, of a record
  constexpr double clearly = 1.4;  // noise gives 1, motion less
  if (!(sums[0] > least * records)) return 1;
  if (sums[0] > clearly * sums[1]) return 2;
  return std::min(sums[0], sums[1]) > clearly * sums[2] ? 3 : 1;
}

void HeldChannels::add(const models::Observation& record) {
  std::size_t channel = 0;
  const auto compare = [&](bool is_other) { channels_.at(channel++).add(is_other); };
  const auto differ = [](double a, double b) { return a != b && std::isfinite(a + b); };
  for (std::size_t i = 0; i < record.servo.size(); ++i) {
    const models::ServoReading& servo = record.servo[i];
    compare(differ(servo.position, last_.servo[i].position));
    compare(differ(servo.velocity, last_.servo[i].velocity));
    compare(differ(servo.torque, last_.servo[i].torque));
    Alternation& one = alternations_[i];
    if (!std::isfinite(servo.position + servo.torque)) continue;
    for (std::size_t k = 0; k < one.last.size() && records_ > 2.0; ++k) {
      // A wheel that is reported within one turn jumps by it.
      constexpr double jump = 3.0;  // rad
      one.sums[k] += std::min(jump, std::abs(servo.position - one.last[k]));
    }
    one.last = {servo.position, one.last[0], one.last[1]};
    if ((servo.torque == 0.0) != (one.torque == 0.0)) ++one.zeros;
    one.torque = servo.torque;
    one.lowest = std::min(one.lowest, servo.torque);
    one.highest = std::max(one.highest, servo.torque);
    if (servo.torque != 0.0) one.nearest = std::min(one.nearest, std::abs(servo.torque));
  }
  const models::ImuReading& imu = record.imu;
  compare(imu.orientation.coeffs() != last_.imu.orientation.coeffs());
  compare(imu.angular_velocity != last_.imu.angular_velocity);
  // Removing gravity by the orientation moves an acceleration that is held.
  const Eigen::Vector3d& raw = imu.raw_linear_acceleration;
  const bool has_raw = raw.allFinite() && !raw.isZero();
  compare(has_raw ? raw != last_.imu.raw_linear_acceleration
                  : imu.linear_acceleration != last_.imu.linear_acceleration);
  last_ = record;
  records_ += 1.0;
}

void HeldChannels::report_alternation(Findings& findings) const {
  std::size_t publishers = 1;
  int joints = 0;
  int zeros = 0;
  for (const Alternation& one : alternations_) {
    publishers = std::max(publishers, one.publishers(records_));
    if (one.publishers(records_) > 1) ++joints;
    if (2.0 * static_cast<double>(one.zeros) > records_) ++zeros;
  }
  if (joints > 1) {
    findings.add("positions",
                 fmt::format("repeat a pattern of {0} records: do several "
                             "publishers share a topic, or were logs merged? Record one of them "
                             "alone",
                             publishers));
  }
  if (zeros > 1) {
    findings.add("torques",
                 "are 0 in every other record: do two publishers share a topic, of which one has "
                 "no effort? Record the other one alone");
  }
}

/// The wheels of a robot that balances push both ways, and their torques come near 0.
bool HeldChannels::report_signs(Findings& findings) const {
  for (std::size_t i = 0; i < alternations_.size(); ++i) {
    const Alternation& one = alternations_.at(i);
    const double largest = std::max(one.highest, -one.lowest);
    const bool is_wheel = i % 3 == 2;
    if (one.lowest < 0.0 && one.highest > 0.0) return true;
    if (is_wheel && !(one.nearest < 0.1 * largest)) return true;
  }
  findings.add("torques",
               "never change their sign, not even those of the wheels: are they sizes without a "
               "sign, or percent of a limit? Map a column with signs");
  return false;
}

bool HeldChannels::report(Findings& findings) const {
  if (records_ < few_records) return true;
  report_alternation(findings);
  report_rates(findings);
  return report_signs(findings);
}

void HeldChannels::report_rates(Findings& findings) const {
  const double rate = 1.0 / period_;
  const auto rates = [&](double period) {
    return fmt::format("{} times a second, rows come at {} Hz", readable(rate / period, 3),
                       readable(rate, 4));
  };
  std::vector<std::size_t> held;
  double shortest = 1e9;
  double longest = 0.0;
  std::size_t changing = 0;
  for (std::size_t i = 0; i < all; ++i) {
    if (channels_.at(i).is_constant()) continue;
    ++changing;
    const double period = channels_.at(i).period();
    if (period < least_period) continue;
    held.push_back(i);
    shortest = std::min(shortest, period);
    longest = std::max(longest, period);
  }
  if (held.empty()) return;
  if (held.size() == changing && longest < 1.1 * shortest) {
    findings.add("all signals",
                 fmt::format("change {}: were rows repeated? Log at the rate of the readings",
                             rates(longest)));
    return;
  }
  // A bus reads all joints at once.
  const auto joints = std::ranges::count_if(held, [](std::size_t i) { return i < of_joints; });
  const auto changing_joints = std::ranges::count_if(
      std::span(channels_).first(of_joints), [](const Channel& one) { return !one.is_constant(); });
  const bool are_all_joints = joints == changing_joints && longest < 1.1 * shortest;
  if (are_all_joints) {
    findings.add("joints", fmt::format("change {}: their readings are repeated", rates(longest)));
  }
  for (const std::size_t i : held) {
    if (are_all_joints && i < of_joints) continue;
    // Upkie's IMU measures 400 times a second, and slower ones serve, too.
    constexpr double enough = 95.0;  // Hz
    if (i >= of_joints && rate / channels_.at(i).period() > enough) continue;
    const std::string name = i >= of_joints
                                 ? imu_channel_names.at(i - of_joints)
                                 : fmt::format("{} {}", models::servo_names.at(i / joint_channels),
                                               joint_channel_names.at(i % joint_channels));
    findings.add(name, fmt::format("changes {}: its readings are repeated",
                                   rates(channels_.at(i).period())));
  }
}

}  // namespace touchdown::logs
