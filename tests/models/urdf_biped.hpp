#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

namespace touchdown::models {

/// A link of 1 kg.
inline std::string urdf_link(const std::string& name, const std::string& more = "") {
  return fmt::format(
      "<link name=\"{}\"><inertial><mass value=\"1\"/><inertia ixx=\".01\" "
      "iyy=\".01\" izz=\".01\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>{}</link>",
      name, more);
}

/// A wheeled biped in a URDF with the names of the contract.
inline std::string urdf_biped(const std::string& more = "", const std::string& base = "") {
  std::string text = "<robot name=\"biped\">" + more + urdf_link("base", base) + urdf_link("imu") +
                     "<joint name=\"imu\" type=\"fixed\"><parent link=\"base\"/><child "
                     "link=\"imu\"/></joint>";
  for (const auto& [side, y] : {std::pair("left", 0.1), std::pair("right", -0.1)}) {
    std::string parent = "base";
    for (const char* part : {"hip", "knee", "wheel"}) {
      const std::string name = fmt::format("{}_{}", side, part);
      const bool is_wheel = std::string_view(part) == "wheel";
      text += urdf_link(name, is_wheel ? "<collision><geometry><sphere radius=\".06\"/></geometry>"
                                         "</collision>"
                                       : "");
      text += fmt::format(
          "<joint name=\"{0}\" type=\"continuous\"><origin xyz=\"0 {1} {2}\"/><parent "
          "link=\"{3}\"/><child link=\"{0}\"/><axis xyz=\"0 1 0\"/><limit effort=\"20\" "
          "velocity=\"9\"/></joint>",
          name, parent == "base" ? y : 0.0, parent == "base" ? 0.0 : -0.2, parent);
      parent = name;
    }
  }
  return text + "</robot>";
}

}  // namespace touchdown::models
