#pragma once

#include "core/fields.hpp"
#include "recordings/mapping/mapping.hpp"
#include "recordings/mapping/mapping_reader.hpp"

namespace touchdown::recordings {

/// Reads when the rows of a log were logged: `time` or `period`, or a clock for each source.
void describe_time(Fields& fields, MappingReader& reader, LogMapping& mapping);

/// Reads the IMU's own clock, if its columns have other names than those of the joints.
void describe_imu_clock(Fields& fields, MappingReader& reader, LogMapping& mapping);

}  // namespace touchdown::recordings
