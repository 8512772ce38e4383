#include "experiments/tuning/folds.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

RunSignals run_of(const std::string& scene, std::int64_t number) {
  RunSignals run;
  run.info.scenario = scene;
  run.info.run = number;
  return run;
}

bool holds(const RunPointers& runs, const RunSignals& draw) {
  return std::any_of(runs.begin(), runs.end(), [&](const RunSignals* run) {
    return run->info.scenario == draw.info.scenario && run->info.run == draw.info.run;
  });
}

TEST(Folds, HoldOutEveryWholeRunOnceWithItsSegments) {
  const std::vector<RunSignals> whole = {run_of("stairs", 0), run_of("stairs", 1),
                                         run_of("kerb", 2), run_of("kerb", 3)};
  // The second and the third are segments of draws that are also whole runs.
  const std::vector<RunSignals> segments = {run_of("stairs", 7), run_of("stairs", 1),
                                            run_of("kerb", 2), run_of("kerb", 0)};
  for (const std::size_t count : {2U, 3U, 4U}) {
    const std::vector<Fold> folds =
        folds_of(pointers_to(whole), pointers_to(segments), count, true);
    ASSERT_EQ(folds.size(), count);
    std::size_t held_out = 0;
    std::size_t fitted_segments = 0;
    for (const Fold& fold : folds) {
      held_out += fold.held_out.size();
      fitted_segments += fold.segments.size();
      EXPECT_FALSE(fold.held_out.empty());
      EXPECT_EQ(fold.held_out.size() + fold.fitted.size(), whole.size());
      for (const RunSignals* run : fold.held_out) {
        EXPECT_FALSE(holds(fold.fitted, *run));
        EXPECT_FALSE(holds(fold.segments, *run));
      }
    }
    EXPECT_EQ(held_out, whole.size());
    // Each segment is training data in all folds but its own.
    EXPECT_EQ(fitted_segments, segments.size() * (count - 1));
  }
}

TEST(Folds, SpreadEachScene) {
  const std::vector<RunSignals> whole = {run_of("stairs", 0), run_of("stairs", 1),
                                         run_of("kerb", 2), run_of("kerb", 3)};
  for (const Fold& fold : folds_of(pointers_to(whole), {}, 2, true)) {
    ASSERT_EQ(fold.held_out.size(), 2U);
    EXPECT_NE(fold.held_out[0]->info.scenario, fold.held_out[1]->info.scenario);
  }
}

TEST(Folds, CountASceneWithoutPerturbationsAsOneRun) {
  const std::vector<RunSignals> whole = {run_of("stairs", 0), run_of("stairs", 1),
                                         run_of("kerb", 2), run_of("kerb", 3)};
  for (const Fold& fold : folds_of(pointers_to(whole), {}, 2, false)) {
    ASSERT_EQ(fold.held_out.size(), 2U);
    EXPECT_EQ(fold.held_out[0]->info.scenario, fold.held_out[1]->info.scenario);
  }
}

}  // namespace
}  // namespace touchdown::experiments
