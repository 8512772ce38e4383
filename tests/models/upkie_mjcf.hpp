#pragma once

#include <string>

namespace touchdown {

inline const std::string upkie_mjcf = TOUCHDOWN_SOURCE_DIR "/models/upkie.xml";

}  // namespace touchdown
