#include "scenarios/varied.hpp"

#include <charconv>
#include <limits>
#include <sstream>

#include <fmt/format.h>

#include "core/table.hpp"

namespace touchdown::scenarios {

double number_at(const Scenario& scenario, const std::string& key) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  YAML::Node node = YAML::Load(to_yaml(scenario));
  std::istringstream parts(key);
  for (std::string part; std::getline(parts, part, '.');) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
    if (node.IsSequence() && error == std::errc{} && index < node.size()) {
      node.reset(node[index]);
    } else if (node.IsMap() && node[part].IsDefined()) {
      node.reset(node[part]);
    } else {
      return none;
    }
  }
  return node.IsScalar() ? node.as<double>(none) : none;
}

Scenario varied(const Scenario& scenario, const std::string& key, double value,
                const std::string& name) {
  YamlDocument document = YamlDocument::parse(to_yaml(scenario), name);
  document.override_value(fmt::format("{}={}", key, exact(value)));
  return scenario_from_yaml(document);
}

}  // namespace touchdown::scenarios
