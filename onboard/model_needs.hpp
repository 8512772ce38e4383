#pragma once

#include <filesystem>

#include "onboard/npz.hpp"

namespace touchdown {

/// Which arrays of a file belong to the model: all arrays of a parameter model or a network; of a
/// grid or a phase model only its own, because the file may hold others. Errors: `InputError` for
/// an unreadable file.
NpzNeeds model_needs(const std::filesystem::path& path);

}  // namespace touchdown
