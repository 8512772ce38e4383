#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "recordings/recording.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown {

/// Called now and then with the simulated time (s); returning false stops the run early.
using PlayProgress = std::function<bool(double time)>;

/// Play `scenario` exactly as it stands (no draws) in the engine called `simulator` ("mujoco",
/// "bullet") and record every control step. Falling, running out of time and diverging are
/// outcomes, not errors. The recording's info carries `seed` and `run` for the record.
/// Errors: `InputError` for an unknown engine or a robot that breaks the naming contract.
Recording play(const Scenario& scenario, std::string_view simulator, std::uint64_t seed = 0,
               std::int64_t run = 0, const PlayProgress& progress = {});

}  // namespace touchdown
