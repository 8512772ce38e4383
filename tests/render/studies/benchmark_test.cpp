#include "render/studies/benchmark.hpp"

#include <cmath>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "render/report/report.hpp"
#include "render/studies/registry.hpp"
#include "tests/render/report/score_files.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const char* const study_config = R"(name: study
simulators: [mujoco]
estimators: [robust]
fit: {scenarios: [scenarios/stairs.yaml]}
test: {scenarios: [scenarios/stairs.yaml]}
benchmark: {}
)";

/// Four estimators in two scenes. Of the first three, neighbouring ranks do not differ
/// significantly, but the first and the third do.
class BenchmarkPage : public ::testing::Test {
 protected:
  BenchmarkPage() {
    folder_.write("config.yaml", study_config);
    folder_.write("manifest.json", "{}");
    write_score_files(folder_);
    folder_.write(
        "tables/benchmark.csv",
        "simulator,robot,sensors,scene,split,estimator,balanced_accuracy,balanced_accuracy_low,"
        "balanced_accuracy_high,no_contact_precision,no_contact_recall,torque_noise_nm,"
        "accelerometer_noise_mps2,fitted_on\n"
        "mujoco,upkie,harsh,stairs,test,robust,0.99,0.98,0.995,1,1,0,0,own\n"
        "mujoco,upkie,harsh,stairs,test,free_fall,0.5,0.4,0.6,nan,0,0,0,own\n"
        "mujoco,upkie,harsh,stairs,test,robust,0.1,0,0.2,1,1,0,0,bullet\n"  // a transfer
        "mujoco,upkie,harsh,<i>hop,unseen,robust,0.7,0.6,0.8,0.9,0.45,0,0,own\n"
        "mujoco,upkie,harsh,<i>hop,unseen,free_fall,nan,nan,nan,nan,nan,0,0,own\n"
        "mujoco,upkie,harsh,<i>hop\n");  // torn
    folder_.write("tables/benchmark_standings.csv",
                  "robot,sensors,torque_noise_nm,accelerometer_noise_mps2,estimator,"
                  "mean_balanced_accuracy,mean_balanced_accuracy_low,mean_balanced_accuracy_high,"
                  "worst_balanced_accuracy,worst_scene,worst_simulator,is_not_significantly_worse,"
                  "log_loss_bits\n"
                  "upkie,harsh,0,0,robust,0.845,0.83,0.85,0.7,<i>hop,mujoco,1,0.125\n"
                  "upkie,harsh,0,0,load_filter,0.84,0.83,0.85,0.7,<i>hop,mujoco,1\n"
                  "upkie,harsh,0,0,paper,0.83,0.82,0.84,0.7,<i>hop,mujoco,0\n"
                  "upkie,harsh,0,0,free_fall,0.5,0.4,0.6,0.5,stairs,mujoco,0\n");
    folder_.write("tables/benchmark_differences.csv",
                  "robot,sensors,torque_noise_nm,accelerometer_noise_mps2,scene,first,second,"
                  "difference,difference_low,difference_high\n"
                  "upkie,harsh,0,0,,robust,load_filter,0.005,-0.01,0.02\n"
                  "upkie,harsh,0,0,,robust,paper,0.015,0.001,0.03\n"
                  "upkie,harsh,0,0,,robust,free_fall,0.345,0.3,0.4\n"
                  "upkie,harsh,0,0,,load_filter,paper,0.01,-0.005,0.025\n"
                  "upkie,harsh,0,0,,load_filter,free_fall,0.34,0.3,0.4\n"
                  "upkie,harsh,0,0,,paper,free_fall,0.33,0.3,0.4\n"
                  "upkie,harsh,0,0,stairs,load_filter,paper,0.5,0.4,0.6\n");
  }
  std::string page() const { return read_file(write_benchmark_page(read_subject(folder_.path()))); }

  const ScratchFolder folder_;
};

TEST_F(BenchmarkPage, IsLinkedFromTheReportOfABenchmarkAlone) {
  const auto report = [&] {
    return read_file(make_report(read_subject(folder_.path()), {}, study_pictures()));
  };
  EXPECT_THAT(report(), HasSubstr("href=\"benchmark.html\""));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "benchmark.html"));
  const std::string text = study_config;
  folder_.write("config.yaml", text.substr(0, text.find("benchmark")));
  EXPECT_THAT(report(), Not(HasSubstr("benchmark.html")));
}

TEST_F(BenchmarkPage, ShowsEveryScenesBestAndWorst) {
  const std::string html = page();
  EXPECT_THAT(html, AllOf(HasSubstr("upkie, harsh sensors"),
                          HasSubstr("level-5 best\" data-value=\"0.99\""),
                          HasSubstr("level-0\" data-value=\"0.5\""), HasSubstr("F1 of events –; "),
                          HasSubstr("&lt;i&gt;hop *"),  // unlike the training scenes
                          HasSubstr("0.845</td>"),      // the mean of both scenes
                          Not(HasSubstr("<i>hop")), Not(HasSubstr("data-value=\"0.1\""))));
}

TEST_F(BenchmarkPage, ListsTheScenesAndErrorsOfEachFailure) {
  EXPECT_THAT(page(), AllOf(HasSubstr("<b>&lt;i&gt;hop</b> 0.700: misses 55 % of the time in the "
                                      "air; 10 % of the flight it reports is contact (MuJoCo"),
                            HasSubstr("<b>stairs</b> 0.500: misses 100 % of the time in the air "
                                      "and never reports flight"),
                            HasSubstr("Not significantly worse than the best in 1 of 1 settings")));
}

/// A single run per scene gives no intervals.
TEST_F(BenchmarkPage, DrawsMeansWithoutIntervalsToo) {
  BenchmarkTables tables = benchmark_tables(folder_.path());
  const auto points = [&](const char* name) {
    const Figure figure =
        draw_standings_figure(tables, "upkie, harsh sensors", 0.95, folder_ / name);
    const std::string svg = read_file(figure.svg);
    std::set<std::string> places;  // of dots: two dots at one position count once
    for (std::size_t at = svg.find("#gpPt6"); at != std::string::npos;
         at = svg.find("#gpPt6", at + 1)) {
      const std::size_t begin = svg.find("translate(", at);
      places.insert(svg.substr(begin, svg.find(')', begin) - begin));
    }
    return places.size();
  };
  EXPECT_EQ(points("with"), 2U * 4U);  // the mean and the worst scene of four
  for (std::vector<Cell>& cells : tables.standings.rows) cells[6] = cells[7] = NAN;
  EXPECT_EQ(points("without"), 2U * 4U);
}

TEST_F(BenchmarkPage, ShowsTheFilmOfTheWorstSegmentIfThereIsOne) {
  EXPECT_THAT(page(), Not(HasSubstr("<video")));
  folder_.write("videos/worst_robust.mp4", "film");
  EXPECT_THAT(page(), HasSubstr("The worst two seconds of Bayes filter (robust)"));
}

TEST_F(BenchmarkPage, JoinsEstimatorsThatDoNotDifferSignificantly) {
  draw_standings_figures(folder_.path(), 0.95);
  // Ranks from above: 3, 2, 1, 0. Bars join the first and second, and the second and third.
  EXPECT_THAT(read_file(folder_ / "figures/benchmark_upkie_harsh.dat"),
              HasSubstr("\n\n\n0\t1.7\t3.3\n1\t0.7\t2.3\n\n"));
  EXPECT_THAT(page(), AllOf(HasSubstr("src=\"data:image/svg+xml;base64,"),
                            HasSubstr("Bayes filter (robust) 0.845 (worst 0.700, &lt;i&gt;hop)")));
}

void expect_segment(const std::vector<std::vector<int>>& wrong, std::size_t length, std::size_t run,
                    std::size_t begin, std::int64_t count) {
  const WorstSegment segment = worst_segment(wrong, length);
  EXPECT_EQ(segment.run, run);
  EXPECT_EQ(segment.begin, begin);
  EXPECT_EQ(segment.wrong, count);
}

TEST(WorstSegment, HasTheMostWrongDecisions) {
  expect_segment({{0, 1, 0, 0, 2, 1, 0}, {1, 0, 0, 0, 0, 0, 1}}, 2, 0, 4, 3);
  expect_segment({{0, 1, 0, 0}, {0, 0, 2, 2}}, 2, 1, 2, 4);
}

TEST(WorstSegment, IsTheFirstOfEqualOnesAndTheBeginningWithoutErrors) {
  expect_segment({{0, 1, 1, 0, 1, 1}, {1, 1, 0, 0, 0, 0}}, 2, 0, 1, 2);
  expect_segment({{0, 0, 0}, {0, 0, 0}}, 2, 0, 0, 0);
}

TEST(WorstSegment, IsTheWholeOfAShorterRun) { expect_segment({{1, 0}, {2, 1, 1}}, 5, 1, 0, 4); }

}  // namespace
}  // namespace touchdown::render
