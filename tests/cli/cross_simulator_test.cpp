#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "program.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// One engine's fit cannot gain 1 over always contact. With a `smallest_gain` of 1 the
/// verdict must fail, with -1 and a `largest_loss` of 1 it must hold.
Ended check(const ScratchFolder& folder, double largest_loss, double smallest_gain,
            const std::string& demanded) {
  write_tiny_experiment(folder);
  folder.write("check.yaml",
               "name: check\n"
               "estimators: [robust]\n"
               "fit: {scenarios: [step.yaml]}\n"
               "test: {scenarios: [step.yaml], runs: 2}\n"
               "noise: {torque: [0.25], accelerometer: [0.23]}\n"
               "video: {enabled: false}\n"
               "cross_simulator:\n"
               "  verdict: {largest_loss: " +
                   std::to_string(largest_loss) + ", smallest_gain: " +
                   std::to_string(smallest_gain) + ", demanded: [" + demanded + "]}\n");
  return touchdown_program("run check.yaml --out out --overwrite --no-pictures", folder.path());
}

TEST(CrossSimulator, ExitsWithOneWhenADemandedVerdictFailsAndKeepsItsTables) {
  const ScratchFolder folder;
  const Ended ended = check(folder, 1.0, 1.0, "robust");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_EQ(ended.errors.substr(ended.errors.rfind("touchdown:")),
            "touchdown: demanded verdicts fail: robust\n");
  EXPECT_THAT(read_file(folder / "out/tables/verdicts.csv"), HasSubstr("robust"));
  EXPECT_THAT(ended.output, AllOf(HasSubstr("robust"), HasSubstr("tables")));
}

TEST(CrossSimulator, ExitsWithZeroWhenWhatFailsWasNotDemandedOrNothingFails) {
  const ScratchFolder folder;
  EXPECT_EQ(check(folder, 1.0, 1.0, "").exit_code, 0);
  const Ended holds = check(folder, 1.0, -1.0, "robust");
  EXPECT_EQ(holds.exit_code, 0) << holds.errors;
}

}  // namespace
}  // namespace touchdown::cli
