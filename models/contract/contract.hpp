#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "models/mjcf/document.hpp"
#include "models/mjcf/types.hpp"
#include "models/robot_description.hpp"

namespace touchdown::models {

/// Looks up the names of the contract in a compiled model. Messages have the place of the element
/// in the robot's file, and the names that this file uses.
class Contract {
 public:
  Contract(const MjcfDocument& document, const PartNames& parts, const mjModel& model)
      : document_(document), parts_(parts), model_(model) {}

  /// Errors: `InputError` if the model has no such element, with the nearest name.
  int find(mjtObj type, const char* tag, std::string_view name) const;

  /// An error about the robot as a whole, at its base or its root.
  [[noreturn]] void fail(const std::string& message) const;
  // Errors about the body, joint, geom or actuator of this number in the model.
  [[noreturn]] void fail_at_body(int body, const std::string& message) const;
  [[noreturn]] void fail_at_joint(int joint, const std::string& message) const;
  [[noreturn]] void fail_at_geom(int geom, const std::string& message) const;
  [[noreturn]] void fail_at_actuator(int actuator, const std::string& message) const;
  [[noreturn]] void fail_at_site(int site, const std::string& message) const;
  /// An error about a servo's joint: "joint 'left_hip': …".
  [[noreturn]] void fail_at_servo(std::size_t servo, const std::string& message) const;
  /// The same about its motor: "motor 'left_hip': …".
  [[noreturn]] void fail_at_motor(std::size_t servo, const std::string& message) const;

  /// "file:line:1" of an actuator.
  std::string place_of_actuator(int actuator) const;
  /// The name of a joint or geom in messages, as in the file; its body's name if it has none.
  std::string name_of(mjtObj type, int id) const;

  const PartNames& parts() const { return parts_; }

 private:
  const tinyxml2::XMLElement* body_element(int body) const;
  const tinyxml2::XMLElement* actuator_element(int actuator) const;
  /// The child of a body with one of these tags, by its number among them.
  const tinyxml2::XMLElement* child(int body, int number,
                                    std::initializer_list<std::string_view> tags) const;
  [[noreturn]] void fail_at(const tinyxml2::XMLElement* element, const std::string& message) const;

  const MjcfDocument& document_;
  const PartNames& parts_;
  const mjModel& model_;
};

}  // namespace touchdown::models
