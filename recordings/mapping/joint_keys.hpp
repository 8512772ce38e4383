#pragma once

#include "core/fields.hpp"
#include "recordings/mapping/mapping.hpp"
#include "recordings/mapping/mapping_reader.hpp"

namespace touchdown::recordings {

/// Reads the section `joints`: signals of hips, knees and wheels, and the commands of the servos.
void describe_joints(Fields& fields, MappingReader& reader, LogMapping& mapping);

}  // namespace touchdown::recordings
