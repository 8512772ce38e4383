#pragma once

#include <filesystem>
#include <memory>

#include "core/error.hpp"
#include "estimator/force/closed_legs.hpp"
#include "estimator/models/make_estimator.hpp"

namespace touchdown {

/// Loads a model file that `touchdown fit` or `convert` wrote, or one of the same arrays. Beside a
/// grid, a file may hold other arrays, which are not read. Errors: `InputError`, one line that
/// begins with the file's name, if the file is unreadable, was changed since the fit, or is no
/// model.
Model load_model(const std::filesystem::path& path);

/// Loads a model file and makes its estimator. For files without metadata see `make_estimator`.
/// Errors: as above, also if the model has another estimator, rate or robot than `use`.
std::unique_ptr<ContactEstimator> load_estimator(const std::filesystem::path& path,
                                                 const ModelUse& use = {});

/// The metadata of the file that `load_estimator` uses.
ModelMetadata load_metadata(const std::filesystem::path& path, const ModelUse& use = {});

/// Loads the closed legs that `touchdown check ROBOT --legs FILE` wrote, for
/// `AssemblyConfig::closed_legs`. Errors: `InputError`.
ClosedLegs load_closed_legs(const std::filesystem::path& path);

}  // namespace touchdown
