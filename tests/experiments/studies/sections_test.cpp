#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/experiments/studies/study_test.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// An experiment with this section, or these keys, on line 6.
Experiment with_section(const std::string& section) {
  return experiment_from_yaml(
      YamlDocument::parse("name: small\nsimulators: [mujoco]\nestimators: [paper, hmm, robust]\n"
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
       {Section{"ablation: {}", "from: paper"}, Section{"ablation: {from: hmm}", "to: robust"},
        Section{"learning_curve: {sizes: [1, 4], draws: 3}", "draws: 3"},
        Section{"moments: true", "moments: true"},
        Section{"odometry: {delay: [0.25, 0.5]}", "delay: [0.25, 0.5]"},
        Section{"operating_points: {leave_below: [0.25, 0.5]}", "leave_below: [0.25, 0.5]"},
        Section{"sweep: {dropout: [0.25]}", "dropout: [0.25]"}}) {
    EXPECT_THAT(reread_yaml(with_section(section.text)), HasSubstr(section.written));
    const std::string key(section.text, std::string_view(section.text).find(':') + 1);
    EXPECT_THAT(to_yaml(with_section("")), Not(HasSubstr(key)));
  }
}

TEST(SectionsOfStudies, AreRefusedAtTheirPlaceWithWhatWasExpected) {
  struct Refusal {
    const char* text;
    int column;
    const char* expected;
  };
  for (const Refusal& refusal : {
           Refusal{"ablation: {from: phase}", 18, "ablation.from"},
           Refusal{"ablation: {from: robust, to: paper}", 30, "after the first one of the row"},
           Refusal{"ablation: {to: paper}", 16, "after the first one of the row"},
           Refusal{"ablation: {form: paper}", 12, "did you mean 'from'"},
           Refusal{"learning_curve: {sizes: [2, 2]}", 25, "expected increasing numbers from 1 on"},
           Refusal{"learning_curve: {sizes: [0, 2]}", 25, "expected increasing numbers from 1 on"},
           Refusal{"learning_curve: {sizes: []}", 25, "expected at least one number"},
           Refusal{"learning_curve: {sizes: [1.5]}", 25, "each item a whole number"},
           Refusal{"learning_curve: {sizes: [1, 5]}", 25,
                   "expected at most the number of segments or fitted runs, 4"},
           Refusal{"learning_curve: {}", 17, "sizes"},
           Refusal{"learning_curve: {sizes: [1], draws: 0}", 37, "learning_curve.draws"},
           Refusal{"learning_curve: {sises: [1]}", 18, "did you mean 'sizes'"},
           Refusal{"moments: often", 10, "expected true or false"},
           Refusal{"moment: true", 1, "did you mean 'moments'?"},
           Refusal{"odometry: {delay: [-0.1]}", 19, "expected times between 0 and 1 s"},
           Refusal{"odometry: {delay: [0.1, 0.1]}", 19, "appears twice"},
           Refusal{"odometry: {dela: [0.1]}", 12, "did you mean"},
           Refusal{"operating_points: {leave_below: [0.5, 0.2]}", 33,
                   "expected increasing probabilities"},
           Refusal{"operating_points: {return_above: [0.5, 1]}", 34, "none of them 0 or 1"},
           Refusal{"operating_points: {leave_below: []}", 33, "expected at least one probability"},
           Refusal{"operating_points: {leave_below: [0.9], return_above: [0.5]}", 54,
                   "at least the lowest leave_below"},
           Refusal{"operating_points: {leave_bellow: [0.5]}", 20, "did you mean"},
           Refusal{"sweep: {dropot: [0.1]}", 17,
                   "sweep.dropot: 'dropot' is not one of scale, low_pass, degrees_of_freedom, "
                   "rate, delay, dropout (did you mean 'dropout'?)"},
           Refusal{"sweep: {dropout: [2]}", 18, "expected a number from 0 to 1"},
           Refusal{"sweep: {dropout: []}", 18, "expected at least one number"},
       }) {
    const std::string complaint = complaint_of([&] { (void)with_section(refusal.text); });
    EXPECT_THAT(complaint, HasSubstr(fmt::format("small.yaml:6:{}: ", refusal.column)))
        << refusal.text;
    EXPECT_THAT(complaint, HasSubstr(refusal.expected)) << refusal.text;
  }
}

}  // namespace
}  // namespace touchdown::experiments
