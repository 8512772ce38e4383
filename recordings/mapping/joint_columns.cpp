#include "recordings/mapping/joint_columns.hpp"

#include <algorithm>

namespace touchdown::recordings {

namespace {

constexpr std::array<std::string_view, 3> joint_fields = {"position", "velocity", "effort"};

/// Whether this is how an index is written behind a list's name: [0], .0, /0, _0 or 0.
bool is_index(std::string_view text) {
  if (text.starts_with('[') && text.ends_with(']')) {
    text = text.substr(1, text.size() - 2);
  } else if (text.starts_with('.') || text.starts_with('/') || text.starts_with('_')) {
    text.remove_prefix(1);
  }
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

std::optional<JointColumns> JointColumns::among(std::span<const std::string> columns) {
  JointColumns found;
  constexpr std::string_view list = "name";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string& column = columns[i];
    const std::size_t at = column.rfind(list);
    if (at == std::string::npos || !is_index(std::string_view(column).substr(at + list.size()))) {
      continue;
    }
    const bool begins_word = at == 0 || column[at - 1] == '.' || column[at - 1] == '/';
    if (!begins_word) continue;
    Joint joint{.name_column = i, .numbers = {}, .name = {}};
    for (std::size_t f = 0; f < joint_fields.size(); ++f) {
      std::string number = column;
      number.replace(at, list.size(), joint_fields.at(f));
      const auto of_number = std::find(columns.begin(), columns.end(), number);
      if (of_number == columns.end()) continue;
      joint.numbers.at(f) = static_cast<std::size_t>(of_number - columns.begin());
    }
    const bool has_numbers = std::any_of(joint.numbers.begin(), joint.numbers.end(),
                                         [](const auto& number) { return number.has_value(); });
    if (has_numbers) found.joints_.push_back(std::move(joint));
  }
  return found.joints_.empty() ? std::nullopt : std::optional(std::move(found));
}

bool JointColumns::is_name(std::size_t column) const {
  return std::any_of(joints_.begin(), joints_.end(),
                     [&](const Joint& joint) { return joint.name_column == column; });
}

bool JointColumns::is_number(std::size_t column) const {
  return std::any_of(joints_.begin(), joints_.end(), [&](const Joint& joint) {
    return std::find(joint.numbers.begin(), joint.numbers.end(), column) != joint.numbers.end();
  });
}

void JointColumns::set_name(std::size_t column, std::string_view name) {
  for (Joint& joint : joints_) {
    if (joint.name_column == column) joint.name = name;
  }
}

std::vector<std::string> JointColumns::names() const {
  std::vector<std::string> names;
  for (const Joint& joint : joints_) {
    for (std::size_t f = 0; f < joint_fields.size(); ++f) {
      if (joint.name.empty() || !joint.numbers.at(f)) continue;
      names.push_back(joint.name + '/' + std::string(joint_fields.at(f)));
    }
  }
  return names;
}

std::optional<std::size_t> JointColumns::column_of(std::string_view joint_column) const {
  for (const Joint& joint : joints_) {
    const std::size_t size = joint.name.size();
    if (size == 0 || joint_column.size() <= size || !joint_column.starts_with(joint.name) ||
        joint_column[size] != '/') {
      continue;
    }
    const auto* const field =
        std::find(joint_fields.begin(), joint_fields.end(), joint_column.substr(size + 1));
    if (field != joint_fields.end())
      return joint.numbers.at(static_cast<std::size_t>(field - joint_fields.begin()));
  }
  return std::nullopt;
}

}  // namespace touchdown::recordings
