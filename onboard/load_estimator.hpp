#pragma once

#include <filesystem>
#include <memory>

#include "estimator/models/make_estimator.hpp"

namespace touchdown {

/// The estimator that `touchdown fit` fitted, from its file, ready to listen. Files without a
/// passport, older or from elsewhere, are taken as `make_estimator` says. Errors: `InputError`, one
/// line that begins with the file: unreadable, changed since it was fitted, of another estimator,
/// rate or robot than `use` says.
std::unique_ptr<ContactEstimator> load_estimator(const std::filesystem::path& path,
                                                 const ModelUse& use = {});

/// What the file says about itself, as far as that decides what `load_estimator` does.
ModelMetadata load_metadata(const std::filesystem::path& path, const ModelUse& use = {});

}  // namespace touchdown
