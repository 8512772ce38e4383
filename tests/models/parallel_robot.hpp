#pragma once

#include <string>

#include <fmt/format.h>

namespace touchdown::models {

/// A leg with a motor at the hip that drives the knee: thigh, crank, rod and shank are a
/// parallelogram, so that the shank stays parallel to the crank.
inline std::string parallel_leg(const std::string& side, double y) {
  return fmt::format(
      R"(
<body name="{0}_thigh" pos="0 {1} 0"><joint name="{0}_lift"/><geom fromto="0 0 0 .1 0 -.2"/>
<body name="{0}_shank" pos=".1 0 -.2"><joint name="{0}_bend"/><geom fromto="0 0 0 -.1 0 -.2"/>
<site name="{0}_lug" pos=".04 0 0"/>
<body name="{0}_rim" pos="-.1 {2} -.2"><joint name="{0}_roll"/>
<geom name="{0}_tyre" type="sphere" size=".07" contype="1"/></body></body></body>
<body name="{0}_crank" pos="0 {1} 0"><joint name="{0}_pull"/><geom fromto="0 0 0 .04 0 0"/>
<body name="{0}_rod" pos=".04 0 0"><joint name="{0}_hang"/><geom fromto="0 0 0 .1 0 -.2"/>
<site name="{0}_eye" pos=".1 0 -.2"/></body></body>)",
      side, y, 0.4 * y);
}

/// A robot with two such legs. One loop is of bodies, the other of sites.
inline std::string parallel_robot() {
  std::string motors;
  for (const char* side : {"left", "right"}) {
    for (const auto& [joint, most] : {std::pair("lift", 25), {"pull", 15}, {"roll", 5}}) {
      motors +=
          fmt::format("<motor joint=\"{}_{}\" ctrlrange=\"-{} {}\"/>\n", side, joint, most, most);
    }
  }
  return fmt::format(
      R"(<mujoco model="parallel">
<default><joint axis="0 1 0"/><geom type="capsule" size=".01" contype="0" conaffinity="0"/></default>
<worldbody><body name="trunk" pos="0 0 .5"><freejoint/>
<geom type="box" size=".1 .08 .05" pos="0 0 .05" contype="1"/><site name="imu"/>{}{}
</body></worldbody>
<equality><connect name="left_loop" body1="left_rod" body2="left_shank" anchor=".1 0 -.2"/>
<connect name="right_loop" site1="right_eye" site2="right_lug"/></equality>
<actuator>{}</actuator></mujoco>)",
      parallel_leg("left", 0.1), parallel_leg("right", -0.1), motors);
}

}  // namespace touchdown::models
