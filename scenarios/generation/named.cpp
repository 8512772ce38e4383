#include "scenarios/generation/named.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/resources.hpp"
#include "scenarios/scenario_file.hpp"

namespace touchdown::scenarios {

namespace {

constexpr std::string_view prefix = "drawn:";

/// Takes the whole number behind the last underscore off the end of `text`; false if there is none.
bool take_number(std::string_view& text, std::uint64_t& number) {
  const std::size_t underscore = text.rfind('_');
  if (underscore == std::string_view::npos) return false;
  const std::string_view digits = text.substr(underscore + 1);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  text = text.substr(0, underscore);
  return error == std::errc() && end == digits.data() + digits.size();
}

}  // namespace

bool is_drawn(std::string_view name) { return name.starts_with(prefix); }

std::string drawn_name(const GeneratedScenario& drawn) {
  return fmt::format("{}{}", prefix, drawn.name);
}

GeneratedScenario generate_named(const std::string& name) {
  std::string_view rest = std::string_view(name).substr(prefix.size());
  std::uint64_t seed = 0;
  std::uint64_t number = 0;
  if (!is_drawn(name) || !take_number(rest, number) || !take_number(rest, seed)) {
    throw InputError(
        fmt::format("{}: expected a drawn scenario's name, such as drawn:kerbs_7_000", name));
  }
  return generate(family_called(std::string(rest)), seed, number);
}

YamlDocument scenario_document(const std::string& name) {
  if (!is_drawn(name)) return YamlDocument::load(find_resource(name));
  return YamlDocument::parse(generate_named(name).text, name);
}

Scenario find_scenario(const std::string& name, const std::string& robot) {
  YamlDocument document = scenario_document(name);
  if (!robot.empty()) {
    (void)find_resource(robot);  // otherwise the error would name the scenario
    document.override_value("robot=" + robot);
  }
  return complete_scenario(document);
}

}  // namespace touchdown::scenarios
