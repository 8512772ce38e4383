#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "models/mjcf/document.hpp"

namespace touchdown::models {

/// The value of an element's attribute, or else that of its default class: the element's own class,
/// the `childclass` of the nearest body above it, or the main class; each with the classes around
/// it. Empty if none has it.
std::string_view attribute_or_default(const MjcfDocument& document,
                                      const tinyxml2::XMLElement& element, const char* name);

/// The numbers of an attribute; NaN for a word that is none.
std::vector<double> numbers(std::string_view text);

/// Whether a geom has no contact bit: it is drawn, and touches nothing.
bool is_visual(const MjcfDocument& document, const tinyxml2::XMLElement& geom);

}  // namespace touchdown::models
