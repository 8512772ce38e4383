#pragma once

namespace touchdown::models {

/// The scene of every robot: solver settings, light, sky and materials. This MJCF text follows the
/// robot's own sections and overrides them.
inline constexpr const char* scene_mjcf = R"(
  <option gravity="0 0 -9.81" timestep="0.001" cone="elliptic" impratio="1" integrator="Euler"/>
  <size njmax="500" nconmax="100"/>
  <statistic extent="1" center="0 0 0.5"/>
  <visual>
    <global fovy="34"/>
    <quality shadowsize="2048" offsamples="0" numslices="36" numstacks="4" numquads="2"/>
    <map znear="0.1" zfar="60" shadowclip="1.3" haze="0.35"/>
    <headlight ambient="0.36 0.37 0.40" diffuse="0.16 0.16 0.17" specular="0.05 0.05 0.05"/>
    <rgba haze="0.86 0.89 0.93 1"/>
  </visual>
  <asset>
    <texture name="touchdown_sky" type="skybox" builtin="gradient" rgb1="0.42 0.58 0.80"
             rgb2="0.90 0.92 0.95" width="512" height="3072"/>
    <texture name="touchdown_grid" type="2d" builtin="checker" rgb1="0.72 0.75 0.79"
             rgb2="0.80 0.82 0.85" mark="edge" markrgb="0.90 0.91 0.93" width="512" height="512"/>
    <material name="touchdown_floor" texture="touchdown_grid" texrepeat="2 2" texuniform="true"
              specular="0" shininess="0" reflectance="0"/>
    <material name="touchdown_step" rgba="0.80 0.775 0.72 1" specular="0.05" shininess="0.1"/>
    <material name="touchdown_edge" rgba="0.95 0.62 0.18 1" specular="0.1"/>
  </asset>
  <worldbody>
    <light name="touchdown_sun" directional="true" pos="3 -3 6" dir="-0.5 0.3 -0.86"
           diffuse="0.62 0.60 0.55" specular="0.3 0.3 0.3" ambient="0 0 0" castshadow="true"/>
    <light name="touchdown_fill" directional="true" dir="0.6 0.5 -0.45" diffuse="0.13 0.15 0.19"
           specular="0 0 0" ambient="0 0 0" castshadow="false"/>
  </worldbody>
)";

}  // namespace touchdown::models
