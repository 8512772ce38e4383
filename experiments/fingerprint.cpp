#include "experiments/fingerprint.hpp"

#include <fmt/format.h>

namespace touchdown {

std::string Fingerprint::text() const { return fmt::format("{:016x}", state_); }

}  // namespace touchdown
