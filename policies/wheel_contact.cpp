#include "policies/wheel_contact.hpp"

#include "core/fields.hpp"
#include "estimator/upkie_observer.hpp"

namespace touchdown::policies {

WheelContact upkie_contact(double period) {
  return [period, observers = std::array<WheelContactObserver, models::wheel_count>()](
             const models::Observation& observation, double /*command*/) mutable {
    std::array<bool, models::wheel_count> in_contact = {};
    for (std::size_t wheel = 0; wheel < in_contact.size(); ++wheel) {
      const models::ServoReading& servo =
          observation.servo[models::index(models::wheel_servos[wheel])];
      in_contact[wheel] = observers[wheel].update(servo.torque, servo.velocity, period);
    }
    return in_contact;
  };
}

void describe(Fields& fields, PolicyConfig& policy) {
  fields.choose("law", {"balancer", "soft_landing"}, policy.law).doc("Control law.");
  fields
      .choose("contact", {"upkie_observer", "always", "free_fall", "support_force", "truth"},
              policy.contact)
      .doc("Contact source of the law; `truth` is an oracle.");
  fields.renamed("late", "delay");
  fields("delay", policy.delay, 0.0, 1.0).doc("s", "Delay of the contact signal.");
}

}  // namespace touchdown::policies
