#pragma once

#include <filesystem>
#include <string>

#include "estimator/npz/load_estimator.hpp"

namespace touchdown::logs {

/// Writes a model's file, which `load_model` reads, completely or not at all. Errors: `Error`.
void save_model(const Model& model, const std::filesystem::path& path);

/// Writes any arrays as a `.npz` file, with large arrays deflated. Errors: `Error`.
void write_npz(ModelArrays arrays, const std::filesystem::path& path);

/// A model file, adapted by `model_for`. Errors: `InputError` that names the file.
Model load_model_for(const std::filesystem::path& path, const ModelUse& use);

/// A model as a C++ header, for programs without files. It defines `touchdown::compiled::<name>`
/// for `touchdown::make_estimator`, and names its file, `source`. It needs the installed component
/// `estimator` only.
std::string header_of_model(const Model& model, const std::string& source, const std::string& name);

}  // namespace touchdown::logs
