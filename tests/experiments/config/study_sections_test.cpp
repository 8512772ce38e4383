#include "experiments/config/study_sections.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/studies/experiment_file.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

struct FirstSection {
  int runs = 1;
};
void describe(Fields& fields, FirstSection& section, const Experiment& experiment) {
  fields("runs", section.runs, 1, experiment.test.runs).doc("Runs.");
}

struct SecondSection {
  std::string name = "none";
};
void describe(Fields& fields, SecondSection& section, const Experiment& /*experiment*/) {
  fields("name", section.name).doc("Name.");
}

/// The second section is written earlier than the first.
std::vector<StudySection> sections() {
  std::vector<StudySection> all = {optional_section<FirstSection>("first", "A section."),
                                   optional_section<SecondSection>("second", "Another one.")};
  all[0].files = [](const Experiment& experiment) -> StudyFiles {
    if (!experiment.studies.has<FirstSection>()) return {};
    return {.scenarios = {"first.yaml"}, .robots = {"robot.xml"}, .sensors = {"sensors.yaml"}};
  };
  all[1].before = "noise";
  return all;
}

Experiment with_sections(const std::string& tail) {
  const std::string common =
      "name: study\nfit: {scenarios: [scenarios/stairs.yaml]}\n"
      "test: {scenarios: [scenarios/stairs.yaml], runs: 3}\n";
  return experiment_from_yaml(YamlDocument::parse(common + tail, "study.yaml"), sections(), {});
}

TEST(StudySections, AreFoundByTypeAndCopiedWithTheirExperiment) {
  const Experiment one = with_sections("first: {runs: 2}\n");
  ASSERT_TRUE(one.studies.has<FirstSection>());
  EXPECT_EQ(one.studies.find<SecondSection>(), nullptr);
  EXPECT_THROW(one.studies.at<SecondSection>(), Error);
  Experiment other = one;
  other.studies.emplace<FirstSection>({3});
  other.studies.emplace<SecondSection>();
  EXPECT_EQ(one.studies.at<FirstSection>().runs, 2);
  EXPECT_EQ(other.studies.at<FirstSection>().runs, 3);
  other.studies.erase<FirstSection>();
  EXPECT_FALSE(other.studies.has<FirstSection>());
  EXPECT_FALSE(one.studies.has<SecondSection>());
}

TEST(StudySections, AreWrittenInTheirPlacesAndReadBack) {
  const std::string text = to_yaml(with_sections("second: {name: two}\nfirst: {}\n"));
  const std::size_t first = text.find("\nfirst:\n  runs: 1\n");
  const std::size_t second = text.find("\nsecond:\n  name: two\n");
  ASSERT_NE(first, std::string::npos);
  EXPECT_LT(text.find("\ntest:"), second);
  EXPECT_LT(second, text.find("\nnoise:"));
  EXPECT_LT(text.find("\npaper_tables:"), first);
  EXPECT_EQ(to_yaml(experiment_from_yaml(YamlDocument::parse(text, "again.yaml"), sections(), {})),
            text);
}

TEST(StudySections, AddTheirFiles) {
  EXPECT_THAT(scenario_files(with_sections("first: {}\n")).back(), "first.yaml");
  EXPECT_THAT(robot_files(with_sections("first: {}\n")), ElementsAre("", "robot.xml"));
  EXPECT_THAT(sensor_files(with_sections("first: {}\n")), ElementsAre("sensors.yaml"));
  EXPECT_THAT(sensor_files(with_sections("second: {}\n")), ElementsAre());
}

TEST(StudySections, ComplainOnTheLineWithTheNearestKey) {
  const auto complaint = [](const std::string& tail, const char* place, const char* expected) {
    EXPECT_THAT([&] { with_sections(tail); },
                ThrowsMessage<InputError>(AllOf(HasSubstr(place), HasSubstr(expected))))
        << tail;
  };
  complaint("firstt: {}\n", "study.yaml:4:1", "did you mean 'first'?");
  complaint("secon: {}\nfirst: {}\n", "study.yaml:4:1", "did you mean 'second'?");
  complaint("first: {run: 1}\n", "study.yaml:4:", "did you mean 'runs'?");
  complaint("first: {runs: 4}\n", "study.yaml:4:", "from 1 to 3");  // another section's value
  complaint("second: two\n", "study.yaml:4:", "expected a mapping");
  complaint("moments: true\n", "study.yaml:4:1", "moments");  // no section of this list
}

TEST(StudySections, OfSeveralStudiesStandInOneFile) {
  const std::string text =
      "name: study\nestimators: [robust]\nfit: {scenarios: [scenarios/stairs.yaml]}\n"
      "test: {scenarios: [scenarios/stairs.yaml], runs: 3}\n";
  for (const char* tail :
       {"cross_simulator: {}\nmoments: true\n",
        "cross_simulator: {}\nodometry: {}\nbenchmark: {}\n",
        "operating_points: {}\ncross_simulator: {}\nsweep: {delay: [0.001]}\n"}) {
    const std::string written =
        to_yaml(experiment_from_yaml(YamlDocument::parse(text + tail, "f")));
    EXPECT_EQ(to_yaml(experiment_from_yaml(YamlDocument::parse(written, "again.yaml"))), written);
    EXPECT_THAT(written, HasSubstr("\ncross_simulator:\n"));
  }
}

}  // namespace
}  // namespace touchdown::experiments
