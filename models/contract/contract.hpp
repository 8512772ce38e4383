#pragma once

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

  /// Errors: `InputError` if the model has no such element.
  int find(mjtObj type, std::string_view kind, std::string_view name) const;

  [[noreturn]] void fail(const std::string& message) const;
  /// An error about the element of this tag and name.
  [[noreturn]] void fail_at(const char* tag, std::string_view name,
                            const std::string& message) const;
  /// An error about a servo's joint: "joint 'left_hip': …".
  [[noreturn]] void fail_at_joint(std::size_t servo, const std::string& message) const;
  /// The same about its motor.
  [[noreturn]] void fail_at_motor(std::size_t servo, const std::string& message) const;

  /// The name of an element in messages; its body's name if it has none.
  std::string name_of(mjtObj type, int id) const;

  const PartNames& parts() const { return parts_; }

 private:
  const MjcfDocument& document_;
  const PartNames& parts_;
  const mjModel& model_;
};

}  // namespace touchdown::models
