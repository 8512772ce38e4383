#include "models/mjcf/defaults.hpp"

#include <cmath>
#include <cstdlib>
#include <sstream>

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

const XMLElement* parent_of(const XMLElement& element) {
  return element.Parent() == nullptr ? nullptr : element.Parent()->ToElement();
}

bool is_default(const XMLElement* element) {
  return element != nullptr && std::string_view(element->Name()) == "default";
}

/// The name of the class that counts for an element; empty for the main class.
std::string_view class_of(const XMLElement& element) {
  if (const std::string_view own = attribute(element, "class"); !own.empty()) return own;
  for (const XMLElement* above = parent_of(element); above != nullptr; above = parent_of(*above)) {
    if (const auto child = attribute(*above, "childclass"); !child.empty()) return child;
  }
  return {};
}

/// The <default> of a class; null if there is none.
const XMLElement* default_of(const MjcfDocument& document, std::string_view name) {
  const XMLElement* found = nullptr;
  document.visit([&](const XMLElement& element) {
    if (found != nullptr || !is_default(&element)) return;
    const bool is_main = !is_default(parent_of(element));
    if (name.empty() ? is_main : attribute(element, "class") == name) found = &element;
  });
  return found;
}

}  // namespace

std::string_view attribute_or_default(const MjcfDocument& document, const XMLElement& element,
                                      const char* name) {
  if (element.Attribute(name) != nullptr) return attribute(element, name);
  const XMLElement* at = default_of(document, class_of(element));
  for (; is_default(at); at = parent_of(*at)) {
    for (const auto* e = at->FirstChildElement(element.Name()); e != nullptr;
         e = e->NextSiblingElement(element.Name())) {
      if (e->Attribute(name) != nullptr) return attribute(*e, name);
    }
  }
  return {};
}

std::vector<double> numbers(std::string_view text) {
  std::vector<double> all;
  std::istringstream words{std::string(text)};
  for (std::string word; words >> word;) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    all.push_back(*end == '\0' ? value : std::nan(""));
  }
  return all;
}

bool is_visual(const MjcfDocument& document, const XMLElement& geom) {
  const auto is_none = [&](const char* bit) {
    return numbers(attribute_or_default(document, geom, bit)) == std::vector<double>{0.0};
  };
  return is_none("contype") && is_none("conaffinity");
}

}  // namespace touchdown::models
