#pragma once

#include <regex>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/files.hpp"

namespace touchdown {

inline const std::string upkie_mjcf = TOUCHDOWN_SOURCE_DIR "/models/upkie.xml";

/// A pattern in Upkie's MJCF, and its replacement.
using Edit = std::pair<std::string, std::string>;

/// A text with all matches of each pattern replaced, one edit after the other.
inline std::string edited(std::string text, const std::vector<Edit>& edits) {
  for (const auto& [pattern, by] : edits) {
    const std::regex expression(pattern);
    EXPECT_TRUE(std::regex_search(text, expression)) << pattern;
    text = std::regex_replace(text, expression, by);
  }
  return text;
}

/// Upkie's MJCF with edits.
inline std::string edited_upkie(const std::vector<Edit>& edits) {
  return edited(read_file(upkie_mjcf), edits);
}

/// Elements that are added before the end of the MJCF.
inline Edit added(const std::string& elements) { return {"</mujoco>", elements + "</mujoco>"}; }

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
