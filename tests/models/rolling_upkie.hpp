#pragma once

#include <fmt/format.h>

#include "tests/models/edited_upkie.hpp"

namespace touchdown {

/// Upkie with a hip roll above each leg, `left_roll` and `right_roll`, about the x axis of the
/// base. `joint`: more attributes of these hinges; `servo`: the elements that drive one, with {}
/// for its side. The bodies between torso and legs have hardly any mass.
inline std::string rolling_upkie(const std::string& joint = "", const std::string& servo =
                                                                    "<position name=\"{0}_roll\" "
                                                                    "joint=\"{0}_roll\" kp=\"150\" "
                                                                    "forcerange=\"-40 40\"/>") {
  const auto above = [&](const std::string& side) {
    return Edit{fmt::format("<body name=\"{}_upper_leg\" pos=\"([^\"]*)\">", side),
                fmt::format("<body name=\"{0}_roll\" pos=\"$1\"><inertial pos=\"0 0 0\" "
                            "mass=\"0.01\" diaginertia=\"1e-5 1e-5 1e-5\"/>"
                            "<joint name=\"{0}_roll\" axis=\"1 0 0\" {1}/>"
                            "<body name=\"{0}_upper_leg\">",
                            side, joint)};
  };
  return edited_upkie(
      {above("left"),
       above("right"),
       {"<body name=\"right_roll\"", "</body><body name=\"right_roll\""},
       {"</body>\\s*</worldbody>", "</body></body></worldbody>"},
       {"</actuator>", fmt::format(fmt::runtime(servo), "left") +
                           fmt::format(fmt::runtime(servo), "right") + "</actuator>"}});
}

}  // namespace touchdown
