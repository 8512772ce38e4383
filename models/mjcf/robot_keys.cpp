#include "models/mjcf/robot_keys.hpp"

#include <fmt/format.h>

#include "core/yaml.hpp"

namespace touchdown::models {

namespace {

bool is_number(std::string_view part) {
  return part.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

void RobotKeys::fail(std::string_view key, const std::string& message) const {
  const YamlDocument document = YamlDocument::load(file_);
  YAML::Node node = document.root();
  std::string shown;
  for (std::string_view rest = key; !rest.empty();) {
    const std::string part(rest.substr(0, rest.find('.')));
    rest.remove_prefix(std::min(rest.size(), part.size() + 1));
    const YAML::Node inner = is_number(part) ? node[std::stoul(part)] : node[part];
    if (!inner.IsDefined()) break;
    node.reset(inner);
    if (!is_number(part)) shown += (shown.empty() ? "" : ".") + part;
  }
  throw InputError(fmt::format("{}: {}: {}", document.place_of(node, key),
                               shown.empty() ? key : shown, message));
}

}  // namespace touchdown::models
