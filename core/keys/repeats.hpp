#pragma once

#include <vector>

#include "core/keys/key.hpp"

namespace touchdown {

/// Replaces the keys of a section that an earlier section has, too, by a reference to that one in
/// the section's type. Sections of one or two keys are kept.
std::vector<Key> without_repeats(const std::vector<Key>& keys);

}  // namespace touchdown
