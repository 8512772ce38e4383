#pragma once

#include "python/arrays.hpp"
#include "recordings/recording.hpp"

namespace touchdown::python {

/// All of a recording as arrays, by views of its rows where they hold what is shown, and where it
/// comes from.
py::dict arrays_of(recordings::Recording recording);
py::dict dict_of(const recordings::RecordingInfo& info);

/// The inverse. Truth is there if `base_position` is. Errors: `InputError` for arrays that are
/// missing or of another shape.
recordings::Recording recording_of(const py::object& arrays, const py::dict& info);

}  // namespace touchdown::python
