#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "recordings/models/provenance.hpp"

namespace touchdown::recordings {

/// A model that is a few named arrays of numbers: a handful, or the weights of a small network.
using Parameters = std::map<std::string, std::vector<double>, std::less<>>;

struct ParameterModelFile {
  std::string estimator;  ///< whose parameters they are
  Parameters parameters;
  ModelProvenance provenance;
};

/// The array that only these files have: its bytes are the estimator's name.
inline constexpr std::string_view estimator_array = "estimator";

/// Writes one `.npz`: an array for each parameter, `estimator` and `provenance` as the bytes of
/// their texts. Errors: `Error` when it cannot be written, and for a parameter that has one of
/// those names.
void write_parameter_model(const ParameterModelFile& file, const std::filesystem::path& path);

/// The inverse, to the bit. Errors: `InputError` that names the file: unreadable, no such model,
/// values that are not finite.
ParameterModelFile read_parameter_model(const std::filesystem::path& path);

/// The parameter of this name, which has to have `size` values. Errors: `InputError` otherwise.
const std::vector<double>& parameter(const Parameters& parameters, std::string_view name,
                                     std::size_t size);

/// As above, of one value.
double parameter(const Parameters& parameters, std::string_view name);

}  // namespace touchdown::recordings
