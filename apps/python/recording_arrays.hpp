#pragma once

#include <array>
#include <memory>

#include "apps/python/arrays.hpp"
#include "logs/recording.hpp"
#include "scoring/labels.hpp"

namespace touchdown::python {

/// Contact by wheel and step.
using WheelLabels = std::array<scoring::ContactSequence, models::wheel_count>;
py::array_t<bool> array_of(const WheelLabels& labels);

/// A recording as arrays, which view its rows where possible, and its info as a dict.
py::dict arrays_of(logs::Recording recording);
py::dict dict_of(const logs::RecordingInfo& info);

/// The inverse of `dict_of`.
logs::RecordingInfo info_of(const py::dict& dict);

/// The inverse of `arrays_of`. It has ground truth if there is an array `base_position`. Errors:
/// `InputError` for arrays that are missing or have another shape.
logs::Recording recording_of(const py::object& arrays, const py::dict& info);

/// The same for a `Recording` of Python, which has its info.
std::shared_ptr<const logs::Recording> recording_of(const py::object& recording);

/// Reads a dictionary of Upkie's spine: `info["spine_observation"]` of a gym environment, or
/// `observation` of a log's record. A missing number or vector, or None, becomes NaN: a failed
/// sensor for estimators. `time` (s) is used if the dictionary has none. Errors: `InputError` for
/// anything but such a dictionary, and for values of another type.
models::Observation observation_of(const py::dict& spine, double time);

}  // namespace touchdown::python
