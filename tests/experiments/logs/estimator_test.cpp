#include "experiments/logs/estimator.hpp"

#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/estimators/registry.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(LogEstimator, OfAShippedModelHasTheTitleOfItsEntryAndNamesItsFile) {
  std::set<std::string> titles;
  for (const std::string name : {"shipped", "shipped_quiet"}) {
    const std::string title = log_estimator({.name = name}).entry.title;
    EXPECT_EQ(title, estimator_entry(name).title + " (" + shipped_file(name) + ")");
    EXPECT_THAT(title, StartsWith(estimator_entry(name).title));
    titles.insert(title.substr(0, title.find(" (")));
  }
  EXPECT_EQ(titles.size(), 2U);
  EXPECT_EQ(log_estimator({}).entry.title, log_estimator({.name = "shipped"}).entry.title);
}

TEST(LogEstimator, OfAModelThatIsGivenAsAFileHasNoTitleOfAnExperimentsOwnFit) {
  for (const std::string name : {"shipped", "shipped_quiet"}) {
    const std::string file = shipped_file(name);
    const std::string title = log_estimator({.model = file}).entry.title;
    EXPECT_THAT(title, AllOf(StartsWith("Evidence curves"), HasSubstr(file)));
    EXPECT_THAT(title, Not(HasSubstr("own fit")));
  }
}

TEST(LogEstimator, RefusesAnUnknownShippedModel) {
  for (const std::string name : {"shipped_silent", "shippedquiet", "shipped "}) {
    EXPECT_THROW((void)log_estimator({.name = name}), InputError) << name;
  }
}

}  // namespace
}  // namespace touchdown::experiments
