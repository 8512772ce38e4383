#include "recordings/models/provenance.hpp"

#include <sstream>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::recordings {

NpyArray array_of_text(const std::string& text) {
  NpyArray array{{text.size()}, {}};
  for (const char c : text) array.data.push_back(static_cast<unsigned char>(c));
  return array;
}

std::string text_of_array(const NpyArray& array, const std::string& name) {
  std::string text;
  for (const double byte : array.data) {
    if (!(byte >= 0.0 && byte <= 255.0)) {
      throw InputError(fmt::format("{}: expected bytes of a text", name));
    }
    text += static_cast<char>(static_cast<int>(byte));
  }
  return text;
}

NpyArray array_of(const ModelProvenance& provenance) {
  std::string lines;
  for (const auto& [key, value] : provenance) lines += fmt::format("{}: {}\n", key, value);
  return array_of_text(lines);
}

ModelProvenance provenance_from(const NpyArray& array) {
  ModelProvenance provenance;
  std::istringstream lines(text_of_array(array, "provenance"));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) provenance[line.substr(0, colon)] = line.substr(colon + 2);
  }
  return provenance;
}

}  // namespace touchdown::recordings
