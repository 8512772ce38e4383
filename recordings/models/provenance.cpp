#include "recordings/models/provenance.hpp"

#include <sstream>

#include <fmt/format.h>

namespace touchdown::recordings {

NpyArray array_of(const ModelProvenance& provenance) {
  std::string lines;
  for (const auto& [key, value] : provenance) lines += fmt::format("{}: {}\n", key, value);
  return array_of_text(lines);
}

ModelProvenance provenance_from(const NpyArray& array) {
  ModelProvenance provenance;
  std::istringstream lines(text_of_array(array, std::string(provenance_array)));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) provenance[line.substr(0, colon)] = line.substr(colon + 2);
  }
  return provenance;
}

}  // namespace touchdown::recordings
