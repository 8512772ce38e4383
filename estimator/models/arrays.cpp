#include "estimator/models/arrays.hpp"

#include "core/error.hpp"

namespace touchdown {

void require_arrays(const ModelArrays& arrays, std::string_view what,
                    std::vector<std::string> names) {
  std::erase_if(names, [&](const std::string& name) { return arrays.contains(name); });
  if (names.empty()) return;
  std::string list = names.front();
  for (std::size_t i = 1; i < names.size(); ++i) list += ", " + names[i];
  throw InputError("is no " + std::string(what) + ": missing " + list);
}

ModelArray array_of_text(const std::string& text) {
  ModelArray array{{text.size()}, {}};
  for (const char c : text) array.data.push_back(static_cast<unsigned char>(c));
  return array;
}

std::string text_of_array(const ModelArray& array, const std::string& name) {
  std::string text;
  for (const double byte : array.data) {
    if (!(byte >= 0.0 && byte <= 255.0)) throw InputError(name + ": expected bytes of a text");
    text += static_cast<char>(static_cast<int>(byte));
  }
  return text;
}

}  // namespace touchdown
