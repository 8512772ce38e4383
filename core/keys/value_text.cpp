#include "core/keys/value_text.hpp"

#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace touchdown {

namespace {

std::string scalar_text(const YAML::Node& value) {
  double number = 0.0;
  if (YAML::convert<double>::decode(value, number)) {
    return std::isfinite(number) ? fmt::format("{}", number) : "none";
  }
  return value.Scalar().empty() ? "\"\"" : value.Scalar();
}

}  // namespace

std::string value_text(const YAML::Node& value) {
  if (value.IsScalar()) return scalar_text(value);
  std::vector<std::string> parts;
  for (const auto& part : value) {
    parts.push_back(
        value.IsMap() ? fmt::format("{}: {}", part.first.as<std::string>(), value_text(part.second))
                      : value_text(part));
  }
  return fmt::format(fmt::runtime(value.IsMap() ? "{{{}}}" : "[{}]"), fmt::join(parts, ", "));
}

std::string range_text(double low, double high) {
  if (std::isinf(high) || high >= 1e15) return fmt::format("≥ {}", low);
  return fmt::format("{} to {}", low, high);
}

}  // namespace touchdown
