#pragma once

#include <filesystem>
#include <string>

#include "estimator/models/metadata.hpp"

namespace touchdown::recordings {

/// Converts a model file to a C++ header, for programs without files. It defines
/// `touchdown::compiled::<name>` for `touchdown::make_estimator`, adapted by `use`
/// (estimator/models/model_for_robot.hpp). The header needs the installed component `estimator`
/// only. Errors: `InputError` that names the file, if no estimator can be made from it.
std::string header_of_model(const std::filesystem::path& path, const std::string& name,
                            const ModelUse& use = {});

}  // namespace touchdown::recordings
