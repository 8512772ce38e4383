#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <deque>

#include "models/robot.hpp"
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

}  // namespace touchdown::scenarios
