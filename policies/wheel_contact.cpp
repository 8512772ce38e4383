#include "policies/wheel_contact.hpp"

#include <utility>

#include "core/fields.hpp"
#include "estimator/upkie_observer.hpp"
#include "policies/script.hpp"

namespace touchdown::policies {

WheelContact upkie_contact(double period) {
  return [period, observers = std::array<WheelContactObserver, models::wheel_count>()](
             const models::Observation& observation, const models::Action* /*previous*/) mutable {
    std::array<bool, models::wheel_count> in_contact = {};
    for (std::size_t wheel = 0; wheel < in_contact.size(); ++wheel) {
      const models::ServoReading& servo =
          observation.servo[models::index(models::wheel_servos[wheel])];
      in_contact[wheel] = observers[wheel].update(servo.torque, servo.velocity, period);
    }
    return in_contact;
  };
}

WheelContact scripted_contact(ContactScript script) {
  return [script = std::move(script)](const models::Observation& observation,
                                      const models::Action* /*previous*/) {
    const ContactCommand* command = in_force(script, observation.time);
    using Contacts = std::array<bool, models::wheel_count>;
    return command == nullptr ? Contacts{true, true} : Contacts{command->left, command->right};
  };
}

void describe(Fields& fields, ContactCommand& command, const ContactScript& script) {
  fields("time", command.time, 0.0, 1e6).doc("s", "Time from which the policy receives it.");
  fields("left", command.left).doc("Whether the left wheel is in contact.");
  fields("right", command.right).doc("Whether the right wheel is in contact.");
  check_order(fields, command, script);
}

void describe(Fields& fields, PolicyConfig& policy) {
  fields.choose("law", {"balancer", "soft_landing"}, policy.law).doc("Control law.");
  fields
      .choose("contact",
              {"upkie_observer", "always", "free_fall", "load_filter", "truth", "script"},
              policy.contact)
      .doc("Contact source of the law; `truth` is an oracle, `script` repeats recorded contact.");
  fields("delay", policy.delay, 0.0, 1.0).doc("s", "Delay of the contact signal.");
  fields.list_if_any("contact_script", policy.contact_script, policy.contact_script)
      .doc("Recorded contact for `contact: script`.");
}

}  // namespace touchdown::policies
