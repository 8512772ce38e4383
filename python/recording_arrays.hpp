#pragma once

#include "python/arrays.hpp"
#include "recordings/recording.hpp"

namespace touchdown::python {

/// A recording as arrays, which view its rows where possible, and its info as a dict.
py::dict arrays_of(recordings::Recording recording);
py::dict dict_of(const recordings::RecordingInfo& info);

/// The inverse of `dict_of`.
recordings::RecordingInfo info_of(const py::dict& dict);

/// The inverse of `arrays_of`. It has ground truth if there is an array `base_position`. Errors:
/// `InputError` for arrays that are missing or have another shape.
recordings::Recording recording_of(const py::object& arrays, const py::dict& info);

}  // namespace touchdown::python
