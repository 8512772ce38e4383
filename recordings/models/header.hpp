#pragma once

#include <filesystem>
#include <string>

#include "estimator/models/metadata.hpp"

namespace touchdown::recordings {

/// The model of a file as a C++ header for a program without files: `touchdown::compiled::<name>`,
/// which `touchdown::make_estimator` takes, as `use` says (estimator/models/model_for_robot.hpp). It
/// needs the installed component `estimator` only. Errors: `InputError` that names the file, for
/// what no estimator can be made of.
std::string header_of_model(const std::filesystem::path& path, const std::string& name,
                            const ModelUse& use = {});

}  // namespace touchdown::recordings
