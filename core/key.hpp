#pragma once

#include <string>

namespace touchdown {

/// One key of a kind of YAML file, as the reference of keys lists it. All members are texts.
struct Key {
  std::string path;      ///< dotted, list items as `[]`: `fit.segments[].length`
  std::string type;      ///< "number", "list of texts", "one of a, b", "section"
  std::string unit;      ///< "N", "m/s²"; empty if the value has none
  std::string range;     ///< "0 to 10", "≥ 0"; empty: any value of the type
  std::string fallback;  ///< value of an absent key, as YAML, or "required", or "none"
  std::string meaning;   ///< one sentence

  friend bool operator==(const Key&, const Key&) = default;
};

}  // namespace touchdown
