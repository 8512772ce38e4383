#include "recordings/models/parameter_model.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "recordings/models/npz.hpp"

namespace touchdown::recordings {

namespace {

constexpr std::string_view provenance_array = "provenance";

bool is_text(std::string_view name) { return name == estimator_array || name == provenance_array; }

/// As many as a small network has, and texts of any sensible length.
std::size_t most_parameters(std::string_view name) {
  constexpr std::size_t most_text = std::size_t{1} << 20U;
  constexpr std::size_t small_network = 100'000;
  return is_text(name) ? most_text : small_network;
}

ParameterModelFile file_from(const NpzArrays& arrays) {
  const std::string estimator(estimator_array);
  require_arrays(arrays, "model of parameters", {estimator});
  ParameterModelFile file;
  for (const auto& [name, array] : arrays) {
    if (name == estimator) {
      file.estimator = text_of_array(array, name);
    } else if (name == provenance_array) {
      file.provenance = provenance_from(array);
    } else if (std::all_of(array.data.begin(), array.data.end(),
                           [](double value) { return std::isfinite(value); })) {
      file.parameters[name] = array.data;
    } else {
      throw InputError(fmt::format("{}: expected finite numbers", name));
    }
  }
  return file;
}

}  // namespace

void write_parameter_model(const ParameterModelFile& file, const std::filesystem::path& path) {
  NpzArrays arrays;
  for (const auto& [name, values] : file.parameters) {
    if (is_text(name)) throw Error(fmt::format("a parameter must not be called '{}'", name));
    arrays[name] = {{values.size()}, values};
  }
  arrays[std::string(estimator_array)] = array_of_text(file.estimator);
  arrays[std::string(provenance_array)] = array_of(file.provenance);
  write_npz(arrays, path);
}

ParameterModelFile read_parameter_model(const std::filesystem::path& path) {
  return made_of_npz(path, most_parameters, file_from);
}

const std::vector<double>& parameter(const Parameters& parameters, std::string_view name,
                                     std::size_t size) {
  const auto found = parameters.find(name);
  if (found == parameters.end()) throw InputError(fmt::format("parameter '{}' is missing", name));
  if (found->second.size() == size) return found->second;
  throw InputError(
      fmt::format("{}: expected {} values, found {}", name, size, found->second.size()));
}

double parameter(const Parameters& parameters, std::string_view name) {
  return parameter(parameters, name, 1)[0];
}

}  // namespace touchdown::recordings
