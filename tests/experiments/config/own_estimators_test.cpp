#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/studies/experiment_file.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// A file with a list of estimators under each key that has one. Its line is the fifth.
std::string with_list(const std::string& key, const std::string& list) {
  const std::string fit =
      key == "fit.tuning.fixed"
          ? ", runs: 4, perturbed: true,\n tuning: {trials: 2, fixed: " + list + "}"
          : "";
  const std::string section = key.substr(0, key.find('.'));
  const std::string name = key.substr(key.find('.') + 1);
  return "name: a\nestimators: [robust, hmm]\ntest: {scenarios: [a.yaml]}\n"
         "fit: {scenarios: [a.yaml]" +
         fit + "}\n" + (section == "fit" ? "" : section + ": {" + name + ": " + list + "}\n");
}

const std::vector<std::string> keys = {"fit.tuning.fixed", "benchmark.table", "video.estimators",
                                       "detail.estimators"};

TEST(OwnEstimators, ListsHaveNamesOfTheExperimentOnce) {
  for (const std::string& key : keys) {
    const auto read = [&key](const std::string& list) {
      return [text = with_list(key, list)] {
        (void)experiment_from_yaml(YamlDocument::parse(text, "a.yaml"));
      };
    };
    EXPECT_NO_THROW(read("[hmm, robust]")()) << key;
    for (const auto& [list, message] : {std::pair{"[robust, hm]", "did you mean 'hmm'"},
                                        {"[rbust]", "did you mean 'robust'"},
                                        {"[robust, robustt]", "did you mean 'robust'"},
                                        {"[free_fall]", "'free_fall' is not one of robust, hmm"},
                                        {"[hmm, robust, hmm]", "'hmm' appears twice"},
                                        {"[]", "expected at least one name"}}) {
      EXPECT_THAT(read(list),
                  ThrowsMessage<InputError>(AllOf(HasSubstr("a.yaml:5:"), HasSubstr(message))))
          << key << ": " << list;
    }
  }
}

TEST(OwnEstimators, ListsAreOptional) {
  const Experiment experiment = experiment_from_yaml(YamlDocument::parse(
      "name: a\nestimators: [robust, hmm]\ntest: {scenarios: [a.yaml]}\nfit: {scenarios: [a.yaml], "
      "runs: 4, perturbed: true, tuning: {trials: 2}}\nbenchmark: {}\nvideo: {}\ndetail: {}\n",
      "a.yaml"));
  EXPECT_TRUE(experiment.tuning->fixed.empty());
  EXPECT_EQ(experiment.video.estimators, experiment.estimators);
  EXPECT_EQ(experiment.detail->estimators, experiment.estimators);
  const std::string written = to_yaml(experiment);
  EXPECT_EQ(to_yaml(experiment_from_yaml(YamlDocument::parse(written, "b.yaml"))), written);
}

}  // namespace
}  // namespace touchdown::experiments
