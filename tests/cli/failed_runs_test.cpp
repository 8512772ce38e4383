#include <regex>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A scene in which no run of an engine stays upright.
struct FailingScene {
  const char* name;
  const char* keys;
  bool in_mujoco;
  bool in_bullet;
};

// A push, a slope that the robot tips over on, ground as soft as air in both engines or in one.
constexpr std::array failing_scenes = {
    FailingScene{"pushed_over", "forces: [{time: 0.3, duration: 0.5, force: [60, 0, 0]}]", true,
                 true},
    FailingScene{"tips", "forces: [{time: 0.2, duration: 0.4, force: [0, 90, 0]}]", true, true},
    FailingScene{"sinks",
                 "simulation: {contact: {solref_time_constant: 1, solref_damping_ratio: 10, "
                 "bullet_stiffness: 1, bullet_damping: 0}}",
                 true, true},
    FailingScene{"sinks_in_mujoco",
                 "simulation: {contact: {solref_time_constant: 1, solref_damping_ratio: 10}}", true,
                 false},
    FailingScene{"sinks_in_bullet",
                 "simulation: {contact: {bullet_stiffness: 1, bullet_damping: 0}}", false, true},
};

class FailedRuns : public InFolder {
 protected:
  FailedRuns() {
    folder_.write("good.yaml", R"(name: good
terrain: {pieces: [flat: {length: 3.0}, stairs: {count: 1, run: 3.0, rise: 0.25}]}
start: {x: 0.7}
velocity: [{time: 0.3, velocity: 0.5}]
end: {duration: 2.2}
perturbation: {yaw: 0.05}
)");
    for (const FailingScene& scene : failing_scenes) {
      folder_.write(
          fmt::format("{}.yaml", scene.name),
          fmt::format("name: {}\nterrain: {{pieces: [flat: {{length: 9.0}}]}}\nstart: {{x: 0.7}}\n"
                      "{}\nend: {{duration: 1.5}}\nperturbation: {{yaw: 0.05}}\n",
                      scene.name, scene.keys));
    }
  }

  Ended run_experiment(const std::string& fit, const std::string& test,
                       const std::string& more = "") const {
    folder_.write(
        "x.yaml",
        fmt::format("name: x\nestimators: [measurement_only, free_fall]\nfit: {{scenarios: "
                    "[{}.yaml]}}\ntest: {{scenarios: [{}], runs: 2}}\nnoise: {{torque: [0.0], "
                    "accelerometer: [0.0]}}\nintervals: {{resamples: 50}}\nvideo: {{enabled: "
                    "false}}\n{}\n",
                    fit, test, more));
    return folder_.run("run x.yaml --out out --no-pictures --overwrite");
  }
};

/// "fell after 0.675 s: pitch beyond 1 rad".
constexpr const char* reason = R"((fell|left the terrain|diverged) after [0-9.]+ s: [a-z])";

TEST_F(FailedRuns, AreNamedWithReasonAndTimeAndAreInNoScore) {
  for (const FailingScene& scene : failing_scenes) {
    SCOPED_TRACE(scene.name);
    const Ended ended = run_experiment("good", fmt::format("good.yaml, {}.yaml", scene.name));
    ASSERT_EQ(ended.exit_code, 0) << ended.errors;
    for (const auto& [engine, fails] :
         {std::pair("mujoco", scene.in_mujoco), std::pair("bullet", scene.in_bullet)}) {
      EXPECT_THAT(ended.output, HasSubstr(fmt::format("{}: {} × 1 noise seed", engine,
                                                      fails ? "2 of 4 test runs" : "4 test runs")));
      const std::regex named(
          fmt::format("Not used: {}_{}_test_00[0-9].mpack .{}", engine, scene.name, reason));
      const auto count =
          std::distance(std::sregex_iterator(ended.output.begin(), ended.output.end(), named),
                        std::sregex_iterator());
      EXPECT_EQ(count, fails ? 2 : 0) << ended.output;
    }
  }
}

// gnuplot refuses a figure without a point.
TEST_F(FailedRuns, OfAWholeEngineLeaveTablesReportAndFiguresOfTheOther) {
  for (const std::string scene : {"sinks_in_bullet", "sinks_in_mujoco"}) {
    const bool is_bullet = scene == "sinks_in_bullet";
    const Ended tables =
        run_experiment("good", scene + ".yaml", "benchmark: {refits: 0, clips: false}");
    if (is_bullet) {
      EXPECT_THAT(tables.output,
                  AllOf(HasSubstr("mujoco: 2 test runs"),
                        HasSubstr("bullet: no test run stayed upright: nothing is scored"),
                        Not(HasSubstr("nan")), Not(HasSubstr("bullet: 0"))));
    }
    folder_.output_of("run x.yaml --out out --no-video --overwrite --set noise.torque=[0.0,1.0]");
    EXPECT_TRUE(folder_.has("out/report.html"));
    for (const char* figure : {"reliability", "error"}) {
      for (const char* engine : {"bullet", "mujoco"}) {
        const bool fails = is_bullet == (std::string(engine) == "bullet");
        EXPECT_EQ(folder_.has(fmt::format("out/figures/{}_{}.png", figure, engine)), !fails)
            << scene << ": " << figure << ", " << engine;
      }
    }
    EXPECT_FALSE(folder_.has("out/figures/latency_mujoco.png")) << "the scene has no event";
  }
}

TEST_F(FailedRuns, OfEverySceneEndTheRunWithTheFirstReason) {
  for (const char* scene : {"pushed_over", "tips", "sinks"}) {
    const Ended ended = run_experiment("good", fmt::format("{}.yaml", scene));
    EXPECT_EQ(ended.exit_code, 1);
    const std::regex line(
        fmt::format("[^\n]*no test run stayed upright: there is nothing to score: "
                    "bullet_{}_test_000.mpack {}.*, and 3 others\n",
                    scene, reason));
    const std::string last = ended.errors.substr(ended.errors.rfind("touchdown: "));
    EXPECT_TRUE(std::regex_match(last, line)) << ended.errors;
  }
}

TEST_F(FailedRuns, OfAFitEndTheRunWithTheFirstReason) {
  for (const FailingScene& scene : failing_scenes) {
    SCOPED_TRACE(scene.name);
    const Ended ended = run_experiment(scene.name, "good.yaml");
    EXPECT_EQ(ended.exit_code, 2);
    const bool is_bullets = !scene.in_mujoco;
    const std::regex line(
        fmt::format("[^\n]*fit on {}: measurement_only: no run of fit.scenarios stayed upright: "
                    "{}_{}_fit_[0-9]+.mpack {}[^\n]*\n",
                    is_bullets ? "bullet" : "(mujoco|bullet)",
                    is_bullets ? "bullet" : "(mujoco|bullet)", scene.name, reason));
    const std::string last = ended.errors.substr(ended.errors.rfind("touchdown: "));
    // A fit on the engine in which the robot stands lacks steps without contact.
    if (scene.in_mujoco && scene.in_bullet) {
      EXPECT_TRUE(std::regex_match(last, line)) << ended.errors;
    } else {
      EXPECT_THAT(last, ::testing::AnyOf(HasSubstr("stayed upright"),
                                         HasSubstr("contain no step without contact")));
    }
  }
}

TEST_F(FailedRuns, AreRowsOfTheBenchmarkWithoutNumbersAndItsMeanReportsThem) {
  const Ended ended = run_experiment("good", "good.yaml, pushed_over.yaml, sinks_in_bullet.yaml",
                                     "benchmark: {refits: 0, clips: false}");
  ASSERT_EQ(ended.exit_code, 0) << ended.errors;
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("(3 of 6: the others have no scored run)"),
                    HasSubstr("Failed runs, not scored: 2 of 2 in pushed_over\n"),
                    HasSubstr("2 of 2 in pushed_over, 2 of 2 in sinks_in_bullet"),
                    HasSubstr("Without a scored run, not in mean and worst: pushed_over")));
  const std::string rows = folder_.text("out/tables/benchmark.csv");
  EXPECT_THAT(rows,
              AllOf(HasSubstr("mujoco,upkie,ideal,pushed_over,unseen,free_fall,nan,nan"),
                    HasSubstr("bullet,upkie,ideal,sinks_in_bullet,unseen,free_fall,nan,nan"),
                    Not(HasSubstr("mujoco,upkie,ideal,sinks_in_bullet,unseen,free_fall,nan,nan"))));
}

TEST_F(FailedRuns, AreNamedWhenTheirLogIsEstimated) {
  for (const char* scene : {"pushed_over", "sinks", "good"}) {
    folder_.output_of(fmt::format("simulate {}.yaml -o a.mpack", scene));
    const std::string output = folder_.output_of("estimate a.mpack");
    const std::regex line("\nrun          fell after [0-9.]+ s: studies do not score such runs\n");
    EXPECT_EQ(std::regex_search(output, line), std::string(scene) != "good") << output;
  }
}

}  // namespace
}  // namespace touchdown::cli
