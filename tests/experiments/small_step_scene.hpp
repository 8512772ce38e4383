#pragma once

namespace touchdown::experiments {

/// A scenario file of one drop of 0.2 m: the shortest run with a flight.
inline constexpr const char* small_step_scene = R"(name: small_step
terrain:
  pieces:
    - flat: {length: 3.0}
    - step: {drop: 0.2, nosing_radius: 0.025}
velocity: [{time: 0.3, velocity: 0.6}]
end: {duration: 6.0, x: 1.5, settle: 0.3}
perturbation: {velocity: 0.1}
)";

}  // namespace touchdown::experiments
