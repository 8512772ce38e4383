#pragma once

#include <map>
#include <string>

#include "estimator/models/parameters.hpp"
#include "recordings/models/npy.hpp"

namespace touchdown::recordings {

/// Origin of a model: scenario, simulator, seeds, runs, seconds, … as text.
using ModelProvenance = std::map<std::string, std::string>;

/// Converts to and from the bytes of "key: value" lines.
NpyArray array_of(const ModelProvenance& provenance);
ModelProvenance provenance_from(const NpyArray& array);

}  // namespace touchdown::recordings
