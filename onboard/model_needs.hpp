#pragma once

#include <filesystem>

#include "onboard/npz.hpp"

namespace touchdown {

/// What of a model's file belongs to the model: of parameters and of a network all there is, of a
/// grid and of a phase model the arrays that they are made of, whatever else somebody keeps beside
/// them. Errors: `InputError` for an unreadable file.
NpzNeeds model_needs(const std::filesystem::path& path);

}  // namespace touchdown
