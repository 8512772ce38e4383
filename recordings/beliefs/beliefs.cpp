#include "recordings/beliefs/beliefs.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/yaml.hpp"

namespace touchdown::recordings {

namespace {

constexpr std::size_t time_name = 0;
constexpr std::size_t first_p = 1;
constexpr std::size_t first_contact = 3;
constexpr std::size_t needed = 3;

const std::vector<std::string>& known_names() {
  static const std::vector<std::string> names = {"time", "p_left", "p_right", "contact_left",
                                                 "contact_right"};
  return names;
}

constexpr const char* expected_names =
    "expected time, p_left, p_right and, for decisions, contact_left and contact_right";

/// The error of a value under one of the known names; empty if the value is valid.
std::string complaint(std::size_t name, double value, double last_time) {
  if (name == time_name) {
    if (!std::isfinite(value)) return fmt::format("{}: expected a time in seconds", value);
    if (value > last_time) return {};
    return fmt::format("{}: expected a time after the one before, {}", value, last_time);
  }
  if (name < first_contact) {
    if (value >= 0.0 && value <= 1.0) return {};
    return fmt::format("{}: expected a probability from 0 to 1", value);
  }
  if (value == 0.0 || value == 1.0) return {};
  return fmt::format("{}: expected 1 for contact or 0 for none", value);
}

}  // namespace

std::string Beliefs::place(std::size_t index) const {
  if (index < line.size()) return fmt::format("{}:{}", file, line[index]);
  return fmt::format("{}: belief {}", file, index);
}

std::optional<ColumnError> BeliefColumns::set_names(std::span<const std::string> names) {
  const std::vector<std::string>& known = known_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::find(known.begin(), known.end(), names[i]) == known.end()) {
      return ColumnError{i, fmt::format("unknown name '{}'{}: {}", names[i],
                                        did_you_mean(names[i], known), expected_names)};
    }
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
        names.begin() + static_cast<std::ptrdiff_t>(i)) {
      return ColumnError{i, fmt::format("'{}' appears twice", names[i])};
    }
  }
  names_.assign(names.begin(), names.end());
  const auto has = [&](std::size_t name) {
    return std::find(names.begin(), names.end(), known[name]) != names.end();
  };
  decides_ = has(first_contact) || has(first_contact + 1);
  for (std::size_t name = 0; name < (decides_ ? known.size() : needed); ++name) {
    if (!has(name)) {
      return ColumnError{names.size(),
                         fmt::format("'{}' is missing: {}", known[name], expected_names)};
    }
    column_[name] = static_cast<std::size_t>(std::find(names.begin(), names.end(), known[name]) -
                                             names.begin());
  }
  return std::nullopt;
}

std::optional<ColumnError> BeliefColumns::add(std::span<const double> values) {
  const double last = beliefs.time.empty() ? -HUGE_VAL : beliefs.time.back();
  for (std::size_t name = 0; name < (decides_ ? known_names().size() : needed); ++name) {
    const std::size_t column = column_[name];
    const std::string what = complaint(name, values[column], last);
    if (!what.empty()) return ColumnError{column, fmt::format("{}: {}", names_[column], what)};
  }
  beliefs.time.push_back(values[column_[time_name]]);
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    const double p = values[column_[first_p + wheel]];
    const bool contact = decides_ ? values[column_[first_contact + wheel]] != 0.0 : p >= 0.5;
    beliefs.p_contact[wheel].push_back(p);
    beliefs.contact[wheel].push_back(std::uint8_t{contact});
  }
  return std::nullopt;
}

}  // namespace touchdown::recordings
