#include <filesystem>
#include <set>

#include "tests/scenarios/runs.hpp"

namespace touchdown::scenarios {
namespace {

using ::testing::HasSubstr;

Scenario parse(const std::string& text) {
  return scenario_from_yaml(YamlDocument::parse(text, "scene.yaml"));
}

std::string complaint(const std::string& text) {
  try {
    (void)parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(ScenarioYaml, EveryScenarioOfTheProjectSurvivesTheRoundTrip) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(TOUCHDOWN_SOURCE_DIR "/scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    const Scenario scenario = load_scenario(entry.path());
    EXPECT_EQ(scenario.name, entry.path().stem());
    EXPECT_EQ(to_yaml(parse(to_yaml(scenario))), to_yaml(scenario)) << scenario.name;
    const Scenario varied = perturbed(scenario, 3, 4);
    EXPECT_EQ(to_yaml(parse(to_yaml(varied))), to_yaml(varied)) << scenario.name;
    names.insert(scenario.name);
  }
  EXPECT_GE(names.size(), 8U);
}

TEST(ScenarioYaml, OnlyTheNameIsRequired) {
  const Scenario scenario = parse("name: bare\n");
  EXPECT_EQ(scenario.name, "bare");
  EXPECT_EQ(scenario.end.duration, End{}.duration);
  EXPECT_THAT(complaint("{}"), HasSubstr("name: is missing"));
}

TEST(ScenarioYaml, ComplainsOnTheLineWithTheNearestKey) {
  EXPECT_THAT(complaint("name: x\nterain: {}\n"),
              HasSubstr("scene.yaml:2:1: terain: unknown key (did you mean 'terrain'?)"));
  EXPECT_THAT(complaint("name: x\nend:\n  durration: 3\n"),
              AllOf(HasSubstr("scene.yaml:3:3:"), HasSubstr("did you mean 'duration'?")));
  EXPECT_THAT(complaint("name: x\nperturbation: {yav: 3}\n"), HasSubstr("did you mean 'yaw'?"));
  EXPECT_THAT(complaint("name: x\nguides: [{stifness: 3}]\n"),
              HasSubstr("did you mean 'stiffness'?"));
  EXPECT_THAT(complaint("name: x\nmass_scale: heavy\n"),
              AllOf(HasSubstr("scene.yaml:2:13:"), HasSubstr("expected a number")));
  EXPECT_THAT(complaint("name: x\nend: {duration: -3}\n"), HasSubstr("duration: expected"));
  EXPECT_THAT(complaint("name: x\nend: {duration: .nan}\n"), HasSubstr("duration: expected"));
}

TEST(ScenarioYaml, AMissingFileIsOneLine) {
  try {
    (void)load_scenario("/nowhere/stairs.yaml");
    FAIL() << "no complaint";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/stairs.yaml"));
    EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("\n")));
  }
}

}  // namespace
}  // namespace touchdown::scenarios
