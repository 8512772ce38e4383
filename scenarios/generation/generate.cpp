#include "scenarios/generation/generate.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "core/error.hpp"
#include "core/fields.hpp"
#include "scenarios/generation/rules.hpp"

namespace touchdown::scenarios {

namespace {

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

void describe(Fields& fields, Generation& generation) {
  fields("seed", generation.seed).doc("Seed of the draws.");
  fields("count", generation.count, 1, 100'000).doc("Number of scenarios.");
  std::vector<std::string> all = family_names();
  if (generation.families.empty()) generation.families = all;
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
