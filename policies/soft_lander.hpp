#pragma once

#include "policies/course.hpp"
#include "policies/policy.hpp"
#include "policies/side_view.hpp"
#include "policies/wheel_contact.hpp"

namespace touchdown::policies {

/// A balancer that uses contact: it balances its centre of mass instead of its torso, keeps the
/// ground's speed on its wheels while they are in the air, and yields with its knees when it lands,
/// each leg along its own line, or when one wheel hangs over an edge: it sinks between its wheels
/// instead of rolling over the one that stands. docs/policy.md has its equations and what each part
/// brings. What both wheels do is the balancer's (policies/wheel_balancer.hpp), and so are its
/// gains.
class SoftLander : public Policy {
 public:
  SoftLander(const WheelBalancerConfig& config, Course course, const SideView& robot,
             WheelContact contact);

  void reset(const models::Observation& observation) override;
  models::Action act(const models::Observation& observation) override;

  /// How much the legs yield: 0, as stiff as on the ground, to 1.
  double softness() const { return softness_; }

 private:
  /// Whether both wheels have been told off the ground for longer than false alarms last.
  bool flies() const;
  void update_ground_velocity(const models::Observation& observation);
  void update_softness();
  void command_leg(std::size_t side, const models::Observation& observation,
                   models::Action& action) const;

  WheelBalancerConfig config_;
  Course course_;
  SideView robot_;
  WheelContact told_;

  std::array<bool, models::wheel_count> contact_ = {true, true};
  double held_velocity_ = 0.0;    ///< of the ground, as last felt (m/s)
  double integral_ = 0.0;         ///< m/s
  double ground_velocity_ = 0.0;  ///< what is asked of the wheels (m/s)
  double in_air_ = 0.0;           ///< since the last wheel left the ground (s)
  double one_in_air_ = 0.0;       ///< since the first did (s)
  double standing_ = 0.0;         ///< since one touched it again after a flight (s)
  double on_ground_ = 0.0;        ///< since both did, but for bumps (s)
  double softness_ = 0.0;
};

}  // namespace touchdown::policies
