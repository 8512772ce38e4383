#pragma once

#include <pybind11/pybind11.h>

#include "models/robot.hpp"

namespace touchdown::python {

/// What a dictionary of Upkie's spine says: `info["spine_observation"]` of a gym environment, or
/// `observation` of a log's record. A number or a vector that is not there, or None, is NaN, which
/// estimators know as a sensor that failed; without a `time`, it is `time`. Errors: `InputError`
/// for what is no such dictionary, and for values of another kind.
models::Observation observation_of(const pybind11::dict& spine, double time);

}  // namespace touchdown::python
