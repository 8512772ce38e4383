#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "logs/recording.hpp"
#include "models/robot.hpp"
#include "policies/course.hpp"
#include "policies/policy.hpp"
#include "policies/wheel_contact.hpp"
#include "scenarios/scenario.hpp"
#include "simulators/simulator.hpp"

namespace touchdown::scenarios {

/// Delays contact by a number of control steps, which may change from step to step. Before the
/// first contact, both wheels are in contact.
class ContactDelay {
 public:
  using WheelContacts = std::array<bool, models::wheel_count>;

  /// `longest` delay (steps).
  explicit ContactDelay(std::size_t longest) : newest_first_(longest + 1, {true, true}) {}

  /// Adds the contact of this step and returns that of `steps` earlier, at most the longest.
  WheelContacts add(const WheelContacts& now, std::size_t steps) {
    newest_first_.pop_back();
    newest_first_.push_front(now);
    return newest_first_[std::min(steps, newest_first_.size() - 1)];
  }

 private:
  std::deque<WheelContacts> newest_first_;
};

/// The contact source of the scenario's policy: `contact_source` if it is given, else the one named
/// by `policy.contact`. Its reports are delayed by `policy.delay` (s). `truth` is an oracle: it
/// reads `simulator`, which must outlive the result.
policies::WheelContact policy_contact(const Scenario& scenario,
                                      const simulators::Simulator& simulator,
                                      policies::WheelContact contact_source = {});

/// External forces on the robot during the next control step: its tether, its guides and the timed
/// forces that act now.
std::vector<simulators::ExternalWrench> external_wrenches(const Scenario& scenario,
                                                          const simulators::Simulator& simulator);

/// One run of a scenario, control step by control step:
///
///     for (;;) {
///       rollout.act();
///       if (rollout.outcome()) break;
///       rollout.advance();
///     }
///
/// Commands and forces may be added between two steps, until the run is over. `scenario()` then
/// contains them: it repeats the run.
class Rollout {
 public:
  /// Resets `simulator`, which must outlive this and have the scenario's robot, terrain, mass and
  /// simulation. If `contact_source` is given, it replaces the scenario's, with the same delay.
  Rollout(Scenario scenario, simulators::Simulator& simulator,
          policies::WheelContact contact_source = {});

  /// Computes the policy's action for the present observation, and whether the run is over.
  const models::Action& act();
  /// How the run ended, once it is over.
  const std::optional<logs::Outcome>& outcome() const { return outcome_; }
  /// Simulates one control step under the last action.
  void advance();

  /// Drives at this velocity (m/s) and yaw rate (rad/s) from now on. It replaces later commands.
  void drive(double velocity, double yaw_rate);
  /// Bends the legs until the hip is at this angle (rad), at a rate in rad/s, `delay` seconds from
  /// now. It replaces commands after that.
  void crouch(double hip, double rate, double delay = 0.0);
  /// The driving command at present.
  policies::VelocityCommand driving() const {
    return policies::command_at(scripts_->velocity, time());
  }
  /// The last hip angle that was commanded until now (rad); the start's without a command.
  double commanded_hip() const;
  /// Adds a force on the base. It should not begin before now.
  void apply(const policies::TimedForce& force);

  /// The scenario with all commands and forces so far.
  Scenario scenario() const;

 private:
  double time() const { return simulator_.observation().time; }

  Scenario scenario_;
  simulators::Simulator& simulator_;
  std::shared_ptr<policies::CourseScripts> scripts_;
  std::unique_ptr<policies::Policy> policy_;
  models::Action action_;
  std::optional<logs::Outcome> outcome_;
  double passed_;  ///< first time past `end.x` (s)
};

}  // namespace touchdown::scenarios
