#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/experiments/studies/study_test.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// An experiment with this section, or these keys.
Experiment with_section(const std::string& section) {
  return experiment_from_yaml(YamlDocument::parse(
      "name: small\nsimulators: [mujoco]\nestimators: [paper, load_filter, robust]\n"
      "fit: {scenarios: [scenarios/stairs.yaml], runs: 4}\n"
      "test: {scenarios: [scenarios/stairs.yaml], runs: 2}\n" +
          section + "\n",
      "small.yaml"));
}

TEST(SectionsOfStudies, AreWrittenAsTheyAreReadAndOnlyIfSet) {
  struct Section {
    const char* text;
    const char* written;
  };
  for (const Section& section :
       {Section{"ablation: {}", "from: paper"},
        Section{"ablation: {from: load_filter}", "to: robust"},
        Section{"moments: true", "moments: true"},
        Section{"odometry: {delay: [0.25, 0.5]}", "delay: [0.25, 0.5]"},
        Section{"vary: {sensors.dropout: [0.25]}", "sensors.dropout: [0.25]"}}) {
    EXPECT_THAT(reread_yaml(with_section(section.text)), HasSubstr(section.written));
    const std::string key(section.text, std::string_view(section.text).find(':') + 1);
    EXPECT_THAT(to_yaml(with_section("")), Not(HasSubstr(key)));
  }
}

}  // namespace
}  // namespace touchdown::experiments
