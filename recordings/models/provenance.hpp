#pragma once

#include <map>
#include <string>

#include "recordings/models/npy.hpp"

namespace touchdown::recordings {

/// Where a model comes from: scenario, simulator, seeds, runs, seconds, … as text.
using ModelProvenance = std::map<std::string, std::string>;

/// A text as an array of its bytes: `bytes(npz["provenance"].astype("u1")).decode()`.
NpyArray array_of_text(const std::string& text);

/// The inverse. Errors: `InputError` that begins with `name` for numbers that are no bytes.
std::string text_of_array(const NpyArray& array, const std::string& name);

/// As "key: value" lines.
NpyArray array_of(const ModelProvenance& provenance);
ModelProvenance provenance_from(const NpyArray& array);

}  // namespace touchdown::recordings
