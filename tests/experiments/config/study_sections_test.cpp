#include "experiments/config/study_sections.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/config/experiment_yaml.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Experiment with_sections(const std::string& tail) {
  return experiment_from_yaml(
      YamlDocument::parse("name: study\nfit: {scenarios: [scenarios/stairs.yaml]}\n"
                          "test: {scenarios: [scenarios/stairs.yaml], runs: 3}\n" +
                              tail,
                          "study.yaml"));
}

TEST(StudySections, AreFoundByTypeAndCopiedWithTheirExperiment) {
  struct First {
    int runs = 1;
  };
  struct Second {};
  StudySections one;
  one.emplace<First>({2});
  ASSERT_TRUE(one.has<First>());
  EXPECT_EQ(one.find<Second>(), nullptr);
  EXPECT_THROW(one.at<Second>(), Error);
  StudySections other = one;
  other.emplace<First>({3});
  other.emplace<Second>();
  EXPECT_EQ(one.at<First>().runs, 2);
  EXPECT_EQ(other.at<First>().runs, 3);
  other.erase<First>();
  EXPECT_FALSE(other.has<First>());
  EXPECT_FALSE(one.has<Second>());
}

TEST(StudySections, AreWrittenInTheirPlacesAndReadBack) {
  const std::string text =
      to_yaml(with_sections("vary: {sensors.delay: [0.25]}\nodometry: {delay: [0.5]}\n"));
  const std::size_t vary = text.find("\nvary:\n  sensors.delay: [0.25]\n");
  const std::size_t odometry = text.find("\nodometry:\n  delay: [0.5]\n");
  ASSERT_NE(odometry, std::string::npos);
  EXPECT_LT(text.find("\ntest:"), vary);
  EXPECT_LT(vary, text.find("\nnoise:"));
  EXPECT_LT(text.find("\npaper_tables:"), odometry);
  EXPECT_EQ(to_yaml(experiment_from_yaml(YamlDocument::parse(text, "again.yaml"))), text);
}

TEST(StudySections, AddTheirFiles) {
  const Experiment benchmark = with_sections("benchmark: {robots: [r.yaml], sensors: [s.yaml]}\n");
  EXPECT_THAT(files_of(benchmark).robots, ElementsAre("", "r.yaml"));
  EXPECT_THAT(files_of(benchmark).sensors, ElementsAre("s.yaml"));
  EXPECT_THAT(
      files_of(with_sections("closed_loop: {scenes: [{scenario: c.yaml}]}\n")).scenarios.back(),
      "c.yaml");
  EXPECT_THAT(files_of(with_sections("vary: {sensors.delay: [0.25]}\n")).sensors, ElementsAre());
}

TEST(StudySections, OfSeveralStudiesStandInOneFile) {
  const std::string text =
      "name: study\nestimators: [robust]\nfit: {scenarios: [scenarios/stairs.yaml]}\n"
      "test: {scenarios: [scenarios/stairs.yaml], runs: 3}\n";
  for (const char* tail : {"cross_simulator: {}\nmoments: true\n",
                           "cross_simulator: {}\nodometry: {}\nbenchmark: {}\n",
                           "cross_simulator: {}\nvary: {sensors.delay: [0.001]}\n"}) {
    const std::string written =
        to_yaml(experiment_from_yaml(YamlDocument::parse(text + tail, "f")));
    EXPECT_EQ(to_yaml(experiment_from_yaml(YamlDocument::parse(written, "again.yaml"))), written);
    EXPECT_THAT(written, HasSubstr("\ncross_simulator:\n"));
  }
}

}  // namespace
}  // namespace touchdown::experiments
