#include "scenarios/generation/generate.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "core/error.hpp"
#include "core/fields.hpp"
#include "core/resources.hpp"
#include "scenarios/generation/families.hpp"
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

std::vector<std::string> family_names() {
  std::vector<std::string> names;
  for (const Family& family : families()) names.push_back(family.name);
  return names;
}

/// Six digits of a number, which are enough for what is drawn; other scalars as they are.
YAML::Node rounded(const YAML::Node& node) {
  double number = 0.0;
  if (node.IsScalar() && YAML::convert<double>::decode(node, number)) {
    return YAML::Node(fmt::format("{:.6g}", number));
  }
  if (!node.IsSequence() && !node.IsMap()) return node;
  YAML::Node copy(node.Type());
  copy.SetStyle(node.Style());
  for (const auto& item : node) {
    if (node.IsMap()) {
      copy[item.first.as<std::string>()] = rounded(item.second);
    } else {
      copy.push_back(rounded(item));
    }
  }
  return copy;
}

/// What of `node` differs from `defaults`; undefined if nothing does.
YAML::Node difference(const YAML::Node& node, const YAML::Node& defaults) {
  if (!node.IsMap() || !defaults.IsDefined() || !defaults.IsMap()) {
    const bool is_equal = defaults.IsDefined() && YAML::Dump(node) == YAML::Dump(defaults);
    return is_equal ? YAML::Node(YAML::NodeType::Undefined) : node;
  }
  YAML::Node kept(YAML::NodeType::Undefined);
  for (const auto& entry : node) {
    const auto key = entry.first.as<std::string>();
    const YAML::Node value = difference(entry.second, defaults[key]);
    if (value.IsDefined()) kept[key] = value;
  }
  return kept;
}

std::string text_of(const Scenario& scenario, const Family& family, std::uint64_t seed,
                    std::uint64_t number) {
  Scenario defaults;
  defaults.name = "";
  const YAML::Node node = difference(YAML::Load(to_yaml(scenario)), YAML::Load(to_yaml(defaults)));
  return fmt::format("# {} Number {} of the family `{}`, drawn with seed {}.\n{}\n", family.summary,
                     number, family.name, seed, YAML::Dump(rounded(node)));
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

void describe(Fields& fields, Generation& generation) {
  fields("seed", generation.seed).doc("Seed of the draws.");
  fields("count", generation.count, 1, 100'000).doc("Number of scenarios.");
  std::vector<std::string> all = family_names();
  if (generation.families.empty()) generation.families = all;
  all.push_back(random_scenes().name);
  fields.names("families", all, generation.families)
      .doc("Families that take turns (default: all).");
}

GeneratedScenario generate(const Family& family, std::uint64_t seed, std::uint64_t number) {
  constexpr std::uint64_t most_attempts = 100;
  GeneratedScenario generated;
  generated.family = family.name;
  generated.name = fmt::format("{}_{}_{:03}", family.name, seed, number);
  for (std::uint64_t attempt = 0; attempt < most_attempts; ++attempt) {
    Scenario scenario = family.draw(Draws(seed, family.name, number, attempt));
    scenario.name = generated.name;
    if (std::optional<std::string> objection = objection_to(scenario)) {
      generated.rejected.push_back(std::move(*objection));
      continue;
    }
    generated.text = text_of(scenario, family, seed, number);
    return generated;
  }
  throw Error(fmt::format("no valid scenario of the family '{}' among {} draws: {}", family.name,
                          most_attempts, generated.rejected.back()));
}

std::vector<GeneratedScenario> generate(const Generation& generation,
                                        const std::function<bool()>& should_continue) {
  std::vector<const Family*> chosen;
  for (const std::string& name : generation.families) chosen.push_back(&family_called(name));
  if (chosen.empty()) {
    for (const Family& family : families()) chosen.push_back(&family);
  }
  std::vector<GeneratedScenario> all;
  for (int i = 0; i < generation.count; ++i) {
    if (should_continue && !should_continue()) throw Stopped();
    const auto turn = static_cast<std::size_t>(i);
    all.push_back(generate(*chosen[turn % chosen.size()], generation.seed, turn / chosen.size()));
  }
  return all;
}

}  // namespace touchdown::scenarios
