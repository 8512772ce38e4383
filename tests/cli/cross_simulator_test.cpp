#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// One engine's fit cannot gain 1 over always contact. With a `smallest_gain` of 1 the
/// verdict must fail, with -1 and a `largest_loss` of 1 it must hold.
struct CrossSimulator : InFolder {
  Ended check(const std::string& smallest_gain, const std::string& demanded) const {
    write_tiny_experiment(folder_);
    folder_.write("check.yaml",
                  "name: check\n"
                  "estimators: [robust]\n"
                  "fit: {scenarios: [step.yaml]}\n"
                  "test: {scenarios: [step.yaml], runs: 2}\n"
                  "noise: {torque: [0.25], accelerometer: [0.23]}\n"
                  "video: {enabled: false}\n"
                  "cross_simulator: {verdict: {largest_loss: 1, smallest_gain: " +
                      smallest_gain + ", demanded: [" + demanded + "]}}\n");
    return folder_.run("run check.yaml --out out --overwrite --no-pictures");
  }
};

TEST_F(CrossSimulator, ExitsWithOneWhenADemandedVerdictFailsAndKeepsItsTables) {
  const Ended ended = check("1", "robust");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_EQ(ended.errors.substr(ended.errors.rfind("touchdown:")),
            "touchdown: demanded verdicts fail: robust\n");
  EXPECT_THAT(folder_.text("out/tables/verdicts.csv"), HasSubstr("robust"));
  EXPECT_THAT(ended.output, AllOf(HasSubstr("robust"), HasSubstr("tables")));
  EXPECT_EQ(check("1", "").exit_code, 0) << "it was not demanded";
  EXPECT_EQ(check("-1", "robust").exit_code, 0) << "it holds";
}

}  // namespace
}  // namespace touchdown::cli
