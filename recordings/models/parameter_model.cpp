#include "recordings/models/parameter_model.hpp"

#include <fmt/format.h>

#include "recordings/models/model_file.hpp"

namespace touchdown::recordings {

namespace {

/// Size limits: the parameters of a small network, and texts of reasonable length.
std::size_t most_parameters(std::string_view name) {
  constexpr std::size_t small_network = 100'000;
  return is_text_array(name) ? most_text : small_network;
}

ParameterModelFile file_from(const NpzArrays& arrays) {
  const std::string estimator(estimator_array);
  require_arrays(arrays, "model of parameters", {estimator});
  ParameterModelFile file{
      text_of_array(arrays.at(estimator), estimator), parameters_of(arrays), {}};
  const auto provenance = arrays.find(std::string(provenance_array));
  if (provenance != arrays.end()) file.provenance = provenance_from(provenance->second);
  return file;
}

}  // namespace

void write_parameter_model(const ParameterModelFile& file, const std::filesystem::path& path,
                           const std::optional<ModelMetadata>& metadata) {
  NpzArrays arrays;
  for (const auto& [name, values] : file.parameters) {
    if (is_text_array(name)) {
      throw Error(fmt::format("a parameter must not be called '{}'", name));
    }
    arrays[name] = {{values.size()}, values};
  }
  arrays[std::string(estimator_array)] = array_of_text(file.estimator);
  arrays[std::string(provenance_array)] = array_of(file.provenance);
  write_model(std::move(arrays), path, metadata);
}

ParameterModelFile read_parameter_model(const std::filesystem::path& path,
                                        std::optional<ModelMetadata>* metadata) {
  return read_model(path, most_parameters, metadata, file_from);
}

}  // namespace touchdown::recordings
